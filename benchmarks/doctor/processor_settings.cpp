#include "benchmarks/doctor/processor_settings.h"

#include <fstream>
#include <set>

namespace benchmarks {

namespace {

namespace fs = std::filesystem;

// The first word; empty where there is no such file.
std::string wordIn(const fs::path& path) {
    std::string word;
    std::ifstream(path) >> word;
    return word;
}

// Folders of a folder; none where it is missing.
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
    // Version 1: a quota of -1 is none.
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
            // A scope of Device is a mouse's or keyboard's.
            battery = battery.value_or(false) || wordIn(supply / "status") == "Discharging";
        }
    }
    return battery;
}

}  // namespace benchmarks
