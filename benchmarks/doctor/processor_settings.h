#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// What Linux tells of how processors are run. `root` is where its file systems are.
namespace benchmarks {

// Governors of frequency scaling of all processors, each once, sorted; empty where there is none,
// as in most virtual machines.
std::vector<std::string> scalingGovernors(const std::filesystem::path& root = "/");

// How many processors' worth of time the control group may use; absent where there is no limit.
std::optional<double> processorQuota(const std::filesystem::path& root = "/");

// Whether the machine runs on its battery; absent where no power supply tells.
std::optional<bool> onBattery(const std::filesystem::path& root = "/");

}  // namespace benchmarks
