#include <iostream>

#include "benchmarks/case.h"
#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/schema.h"
#include "benchmarks/suite.h"

namespace benchmarks {

int validateScenes(const std::vector<std::filesystem::path>& scenes) {
    int status = kOk;
    for (const std::filesystem::path& path : scenes) {
        if (path.string().ends_with(".schema.json")) continue;  // scenes/*.json names it too
        try {
            std::size_t count = 0;
            for (Scene& scene : loadScenes(path))
                count += selectCases(scene, {.scene = path}).size();
            std::cout << path.string() << ": ok, " << count
                      << (count == 1 ? " case\n" : " cases\n");
        } catch (const engine::Error& error) {
            std::cerr << error.what() << '\n';
            status = kUsageError;
        }
    }
    return status;
}

int printSchema() {
    std::cout << sceneSchema();
    return kOk;
}

int printDevices() {
    const engine::Instance instance(engine::Validation::off);
    const std::vector<engine::DeviceInfo> devices = engine::listDevices(instance);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const engine::DeviceInfo& device = devices[i];
        std::cout << i << ": " << device.name << "\n   " << device.type << ", Vulkan "
                  << device.api_version << ", " << device.driver << ' ' << device.driver_version
                  << "\n   timestamps: " << device.timestamp_valid_bits << " bits of "
                  << device.limits.timestampPeriod << " ns\n";
        if (device.missing.empty()) {
            std::cout << "   runs hairbench\n";
        } else {
            std::cout << "   can't run hairbench; it lacks";
            for (const std::string& missing : device.missing) std::cout << "\n     " << missing;
            std::cout << '\n';
        }
    }
    if (devices.empty()) throw engine::NoDevice("no Vulkan device");
    return kOk;
}

}  // namespace benchmarks
