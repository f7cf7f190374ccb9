#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/report/change.h"
#include "benchmarks/scene/schema.h"
#include "benchmarks/scene/sweep.h"

namespace benchmarks::commands {

int validateScenes(const std::vector<std::filesystem::path>& scenes) {
    int status = report::kOk;
    for (const std::filesystem::path& path : scenes) {
        if (path.string().ends_with(".schema.json")) continue;  // scenes/*.json names it too
        try {
            std::size_t count = 0;
            std::vector<std::string> warnings;
            for (scene::Scene& scene : scene::loadScenes(path))
                count += scene::selectCases(scene, {.scene = path}, nullptr, &warnings).size();
            for (const std::string& warning : warnings) std::cout << "warning: " << warning << '\n';
            std::cout << path.string() << ": ok, " << count
                      << (count == 1 ? " case\n" : " cases\n");
        } catch (const engine::Error& error) {
            std::cerr << error.what() << '\n';
            status = report::kUsageError;
        }
    }
    return status;
}

int printSchema() {
    std::cout << scene::sceneSchema();
    return report::kOk;
}

namespace {

// What the device lacks of what only some cases need.
void printLacking(const engine::DeviceInfo& device) {
    std::string lacking;
    for (const engine::Feature feature : engine::allFeatures())
        if (!device.features.contains(feature))
            lacking += "\n     " + std::string(engine::featureName(feature));
    if (!lacking.empty())
        std::cout << "   but for cases that need what it has not:" << lacking << '\n';
}

}  // namespace

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
            printLacking(device);
        } else {
            std::cout << "   can't run hairbench; it lacks";
            for (const std::string& missing : device.missing) std::cout << "\n     " << missing;
            std::cout << '\n';
        }
    }
    if (devices.empty()) throw engine::NoDevice("no Vulkan device");
    return report::kOk;
}

}  // namespace benchmarks::commands
