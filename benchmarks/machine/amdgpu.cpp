#include "benchmarks/machine/amdgpu.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace benchmarks {

namespace {

struct Levels {
    std::optional<double> present;   // MHz
    std::optional<double> greatest;  // MHz
};

// Lines such as "1: 1500Mhz *".
Levels readLevels(const std::filesystem::path& path) {
    Levels levels;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos) continue;
        char* rest = nullptr;
        const char* const start = line.c_str() + colon + 1;
        const double clock = std::strtod(start, &rest);
        if (rest == start || clock <= 0.0) continue;
        if (line.find('*') != std::string::npos) levels.present = clock;
        levels.greatest = std::max(levels.greatest.value_or(0.0), clock);
    }
    return levels;
}

// One number; absent where the file is not there or holds none.
std::optional<double> readNumber(const std::filesystem::path& path) {
    std::ifstream file(path);
    double number = 0.0;
    if (!(file >> number)) return std::nullopt;
    return number;
}

class Amdgpu : public ClockSource {
public:
    explicit Amdgpu(std::filesystem::path device) : device_(std::move(device)) {
        std::error_code none;
        // One folder, hwmon0 or with another number.
        for (const auto& entry : std::filesystem::directory_iterator(device_ / "hwmon", none))
            monitor_ = entry.path();
    }

    ClockReading read() override {
        ClockReading reading;
        const Levels shaders = readLevels(device_ / "pp_dpm_sclk");
        reading.clock_mhz = shaders.present;
        reading.base_clock_mhz = shaders.greatest;
        reading.memory_clock_mhz = readLevels(device_ / "pp_dpm_mclk").present;
        if (const auto hertz = readNumber(monitor_ / "freq1_input"); hertz && *hertz > 0.0)
            reading.clock_mhz = *hertz / 1e6;
        if (const auto millidegrees = readNumber(monitor_ / "temp1_input"))
            reading.temperature = *millidegrees / 1e3;
        std::string level;
        std::ifstream(device_ / "power_dpm_force_performance_level") >> level;
        if (!level.empty() && level != "auto") {
            reading.held = true;
            reading.base_clock_mhz.reset();
        }
        return reading;
    }

private:
    std::filesystem::path device_;
    std::filesystem::path monitor_;
};

}  // namespace

std::unique_ptr<ClockSource>
openAmdgpu(const PciAddress& address, const std::filesystem::path& devices) {
    const std::filesystem::path device = devices / addressText(address);
    if (!readLevels(device / "pp_dpm_sclk").greatest) return nullptr;
    return std::make_unique<Amdgpu>(device);
}

}  // namespace benchmarks
