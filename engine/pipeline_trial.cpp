// A helper program that makes a pipeline with functions of a scene before its parent does. It
// limits its own time and memory, so that the driver's compiler can't harm the parent.
#include <cstddef>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <variant>

#include "engine/commands.h"
#include "engine/device.h"
#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/system/child.h"
#include "engine/system/process.h"
#include "engine/transfer.h"

namespace engine {
namespace {

// Limits in addition to the device's own use.
constexpr unsigned kSeconds = 30;  // of CPU time
const system::ChildLimits kLimits{.seconds = kSeconds, .bytes = std::size_t{2} << 30};

constexpr const char* kOutOfTime = "needed more than 30 s of CPU time\n";
static_assert(kSeconds == 30);

// Returns null if there is no such device: then nothing is tried, and the parent continues.
std::unique_ptr<Device> deviceNamed(const std::string& name) {
    try {
        return std::make_unique<Device>(DeviceOptions{.wanted = name});
    } catch (const std::exception&) {
        return nullptr;
    }
}

void make(const Device& device, const TrialDescription& description) {
    if (const auto* const graphics = std::get_if<GraphicsDescription>(&description)) {
        GraphicsPipeline(device, *graphics);
        return;
    }
    const auto& compute = std::get<ComputeDescription>(description);
    const ComputePipeline pipeline(device, compute);
    // lavapipe compiles at the first dispatch, even at one of no work groups.
    if (compute.combined_images + compute.sampled_images + compute.storage_images +
            compute.texel_buffers ==
        0)
        runOnce(device, [&](Commands& commands) {
            commands.bind(pipeline);
            vkCmdDispatch(commands.get(), 0, 0, 0);
        });
}

void run(const std::string& name, const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string description{std::istreambuf_iterator<char>(stream), {}};
    const std::unique_ptr<Device> device = deviceNamed(name);
    if (!device) return;
    system::limitSelf(kLimits, kOutOfTime);
    make(*device, readTrial(*device, description));
}

}  // namespace
}  // namespace engine

// Arguments: the device's name, and a file with the description of the pipeline.
int main(int argc, char** argv) {
    engine::system::prepareStreams();
    try {
        if (argc != 3) throw engine::Error("expected two arguments: a device and a file");
        engine::run(argv[1], argv[2]);
        return 0;
    } catch (const std::bad_alloc&) {
        std::cerr << "needed more than 2048 MiB of memory\n";
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
    }
    return 1;
}
