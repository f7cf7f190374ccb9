#include "engine/system/machine.h"

#include <array>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

#include <dlfcn.h>
#include <link.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace engine::system {

namespace fs = std::filesystem;

// ---- Names and sizes ----------------------------------------------------------------------------

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

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(':');
        if (line.starts_with("model name") && colon + 2 < line.size())
            return line.substr(colon + 2);
    }
    return {};
}

std::optional<std::uint64_t> memoryBytes() {
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_size = sysconf(_SC_PAGE_SIZE);
    if (pages <= 0 || page_size <= 0) return std::nullopt;
    return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size);
}

std::tm localTime(std::time_t time) {
    std::tm local{};
    localtime_r(&time, &local);
    return local;
}

// ---- Load and energy ----------------------------------------------------------------------------

std::optional<ProcessorTicks> readProcessorTicks(const fs::path& path) {
    std::ifstream file(path.empty() ? "/proc/stat" : path);
    std::string line;
    if (!std::getline(file, line)) return std::nullopt;
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (name != "cpu") return std::nullopt;
    enum { user, nice, system, idle, waiting, interrupts, soft_interrupts, steal, fields };
    std::array<std::uint64_t, fields> ticks{};
    for (std::uint64_t& each : ticks)
        if (!(words >> each)) return std::nullopt;
    // The guest time that follows is already part of user and nice.
    const std::uint64_t busy =
        ticks[user] + ticks[nice] + ticks[system] + ticks[interrupts] + ticks[soft_interrupts];
    return ProcessorTicks{
        .busy = busy,
        .steal = ticks[steal],
        .total = busy + ticks[idle] + ticks[waiting] + ticks[steal]};
}

double ticksPerSecond() { return static_cast<double>(sysconf(_SC_CLK_TCK)); }

std::vector<EnergyCounter> readEnergyCounters(const fs::path& folder) {
    const auto read = [](const std::filesystem::path& path) {
        std::ifstream file(path);
        std::uint64_t number = 0;
        return file >> number ? std::optional(number) : std::nullopt;
    };
    std::vector<EnergyCounter> counters;
    // Packages only: a second number, as in intel-rapl:0:1, denotes a part of a package.
    for (int package = 0;; ++package) {
        const std::filesystem::path place = (folder.empty() ? "/sys/class/powercap" : folder) /
                                            ("intel-rapl:" + std::to_string(package));
        const auto now = read(place / "energy_uj");
        const auto range = read(place / "max_energy_range_uj");
        if (!now || !range) return counters;
        counters.push_back({*now, *range});
    }
}

namespace {

// ---- How the system runs the processors ---------------------------------------------------------

// Returns the first word; empty if there is no such file.
std::string wordIn(const fs::path& path) {
    std::string word;
    std::ifstream(path) >> word;
    return word;
}

// Returns the entries of a folder; empty if the folder is missing.
std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(folder, missing))
        entries.push_back(entry.path());
    return entries;
}

std::optional<double> ratio(double quota, double period) {
    if (quota <= 0.0 || period <= 0.0) return std::nullopt;
    return quota / period;
}

}  // namespace

std::vector<std::string> scalingGovernors(const fs::path& root) {
    std::set<std::string> governors;
    for (const fs::path& processor : entriesOf(root / "sys/devices/system/cpu")) {
        const std::string governor = wordIn(processor / "cpufreq/scaling_governor");
        if (!governor.empty()) governors.insert(governor);
    }
    return {governors.begin(), governors.end()};
}

std::optional<double> processorQuota(const fs::path& root) {
    // Version 2: "max 100000" or "150000 100000", both in microseconds.
    const fs::path groups = root / "sys/fs/cgroup";
    double quota = 0.0, period = 0.0;
    if (std::ifstream file(groups / "cpu.max"); file >> quota >> period)
        return ratio(quota, period);
    // Version 1: a quota of -1 means no quota.
    std::ifstream(groups / "cpu/cpu.cfs_quota_us") >> quota;
    std::ifstream(groups / "cpu/cpu.cfs_period_us") >> period;
    return ratio(quota, period);
}

std::optional<bool> onBattery(const fs::path& root) {
    std::optional<bool> battery;
    for (const fs::path& supply : entriesOf(root / "sys/class/power_supply")) {
        const std::string type = wordIn(supply / "type");
        if (type == "Mains" || type.starts_with("USB")) {
            if (wordIn(supply / "online") == "1") return false;
        } else if (type == "Battery" && wordIn(supply / "scope") != "Device") {
            // A scope of Device is the battery of a mouse or keyboard.
            battery = battery.value_or(false) || wordIn(supply / "status") == "Discharging";
        }
    }
    return battery;
}

// ---- Libraries ----------------------------------------------------------------------------------

std::vector<std::string> loadedLibraries() {
    std::vector<std::string> libraries;
    dl_iterate_phdr(
        [](dl_phdr_info* library, std::size_t, void* data) {
            static_cast<std::vector<std::string>*>(data)->emplace_back(library->dlpi_name);
            return 0;
        },
        &libraries);
    return libraries;
}

Library::Library(const std::string& name) : handle_(dlopen(name.c_str(), RTLD_NOW)) {}

Library::~Library() {
    if (handle_) dlclose(handle_);
}

void* Library::address(const char* name) const { return handle_ ? dlsym(handle_, name) : nullptr; }

const char* const kNvmlLibrary = "libnvidia-ml.so.1";

}  // namespace engine::system
