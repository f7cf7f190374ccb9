// Traces a scene of `hairbench export SCENE --mitsuba DIR` with our own path tracer. Prints the
// picture's mean radiance, linear RGB, and its standard error. The script mitsuba_means.py beside
// this file does the same for Mitsuba.
//
// usage: trace_folder DIR SAMPLES [OUT.exr] [SEED]
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include "engine/float_pictures.h"
#include "hair/reference/path_tracer.h"
#include "tests/path_tracer/mitsuba_folder.h"

namespace {

void traceFolder(const std::vector<std::string>& arguments) {
    const TracedFolder folder = readMitsubaFolder(arguments.at(0));
    const auto samples = static_cast<std::uint32_t>(std::stoul(arguments.at(1)));
    const std::uint64_t seed = arguments.size() > 3 ? std::stoull(arguments[3]) : 0;
    const hair::reference::PathTracer tracer(folder.scene);
    const hair::reference::TracedPicture picture = tracer.trace(folder.camera, samples, seed);
    const auto show = [](const glm::dvec3& color) {
        std::cout << ' ' << color.r << ' ' << color.g << ' ' << color.b;
    };
    std::cout << std::fixed << std::setprecision(6) << arguments[0] << ": mean";
    show(picture.mean());
    std::cout << ", standard error";
    show(picture.standardError());
    std::cout << '\n';
    if (arguments.size() < 3 || arguments[2].empty()) return;
    std::vector<float> rgb;
    for (const glm::dvec3& radiance : picture.radiances)
        for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<float>(radiance[c]));
    engine::writeExr(arguments[2], folder.camera.width, folder.camera.height, rgb);
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 3) {
        std::cerr << "trace_folder DIR SAMPLES [OUT.exr] [SEED]\n";
        return EXIT_FAILURE;
    }
    try {
        traceFolder({arguments + 1, arguments + count});
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
