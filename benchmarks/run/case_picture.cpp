#include "benchmarks/run/case_picture.h"

#include <algorithm>
#include <vector>

#include "engine/image_file.h"

namespace benchmarks {

namespace {

constexpr std::uint32_t kWidest = 480;  // px

// The mean over squares of `factor` x `factor` pixels; what is left over at the edges is cut off.
std::vector<std::uint8_t> shrunk(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    std::uint32_t factor) {
    std::vector<std::uint8_t> small;
    small.reserve(pixels.size() / factor / factor);
    for (std::uint32_t y = 0; y + factor <= height; y += factor)
        for (std::uint32_t x = 0; x + factor <= width; x += factor)
            for (std::uint32_t channel = 0; channel < 4; ++channel) {
                std::uint32_t sum = 0;
                for (std::uint32_t v = 0; v < factor; ++v)
                    for (std::uint32_t u = 0; u < factor; ++u)
                        sum += pixels[(std::size_t{y + v} * width + x + u) * 4 + channel];
                const std::uint32_t area = factor * factor;
                small.push_back(static_cast<std::uint8_t>((sum + area / 2) / area));
            }
    return small;
}

}  // namespace

std::string writeCasePicture(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    const std::filesystem::path& report, std::size_t index) {
    const std::uint32_t factor =
        std::min((width + kWidest - 1) / kWidest, std::max(height, std::uint32_t{1}));
    const std::filesystem::path file = std::filesystem::path(report.stem().string() + ".pictures") /
                                       (std::to_string(index) + ".png");
    engine::writePng(
        report.parent_path() / file, width / factor, height / factor,
        shrunk(pixels, width, height, factor));
    return file.generic_string();
}

}  // namespace benchmarks
