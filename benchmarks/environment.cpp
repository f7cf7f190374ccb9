#include "benchmarks/environment.h"

#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>
#include <utility>

#include <sys/utsname.h>
#include <unistd.h>

#include "benchmarks/device_record.h"
#include "build_info.h"

namespace benchmarks {

namespace {

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(':');
        if (line.starts_with("model name") && colon + 2 < line.size())
            return line.substr(colon + 2);
    }
    return {};
}

std::string systemName() {
    std::string name;
    std::ifstream file("/etc/os-release");
    for (std::string line; std::getline(file, line);) {
        constexpr std::string_view kKey = "PRETTY_NAME=\"";
        if (line.starts_with(kKey)) name = line.substr(kKey.size(), line.size() - kKey.size() - 1);
    }
    utsname system{};
    if (uname(&system) == 0) {
        const std::string kernel = std::string(system.sysname) + " " + system.release;
        name += name.empty() ? kernel : ", " + kernel;
    }
    return name;
}

std::string utcNow() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

HostRecord describeHost() {
    HostRecord host{
        .system = systemName(),
        .processor = processorName(),
        .processor_count = std::thread::hardware_concurrency(),
        .memory_bytes = std::nullopt};
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_size = sysconf(_SC_PAGE_SIZE);
    if (pages > 0 && page_size > 0) {
        host.memory_bytes =
            static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size);
    }
    return host;
}

}  // namespace

BuildRecord describeBuild() {
    BuildRecord build{
        .version = kBuildVersion,
        .commit = kBuildCommit,
        .compiler = kBuildCompiler,
        .type = kBuildType,
        .flags = kBuildFlags,
        .dirty = std::nullopt};
    if (!build.commit.empty()) build.dirty = kBuildDirty;
    return build;
}

std::string versionText() {
    const std::string commit = kBuildCommit;
    return "hairbench " + std::string(kBuildVersion) + (commit.empty() ? "" : " (" + commit + ")");
}

Environment describeEnvironment(
    const engine::Device& device, std::vector<std::string> command, std::uint64_t seed,
    engine::Validation validation) {
    return {
        .device = describeDevice(device),
        .host = describeHost(),
        .build = describeBuild(),
        .command = std::move(command),
        .started = utcNow(),
        .seed = seed,
        .validation = validation == engine::Validation::on};
}

}  // namespace benchmarks
