#include "benchmarks/measure/clocks.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "benchmarks/report/verdict.h"

namespace benchmarks::measure {
namespace {

// ---- Address on the PCI bus ---------------------------------------------------------------------

bool tellsAddress(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    if (vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr) != VK_SUCCESS)
        return false;
    std::vector<VkExtensionProperties> extensions(count);
    if (vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()) !=
        VK_SUCCESS)
        return false;
    return std::ranges::any_of(extensions, [](const VkExtensionProperties& each) {
        return std::strcmp(each.extensionName, VK_EXT_PCI_BUS_INFO_EXTENSION_NAME) == 0;
    });
}

}  // namespace

std::string addressText(const PciAddress& address) {
    char text[48];
    std::snprintf(
        text, sizeof text, "%04x:%02x:%02x.%x", address.domain, address.bus, address.device,
        address.function);
    return text;
}

std::optional<PciAddress> pciAddress(const engine::DeviceInfo& device) {
    if (!tellsAddress(device.handle)) return std::nullopt;
    VkPhysicalDevicePCIBusInfoPropertiesEXT place{};
    place.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PCI_BUS_INFO_PROPERTIES_EXT;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &place;
    vkGetPhysicalDeviceProperties2(device.handle, &properties);
    return PciAddress{place.pciDomain, place.pciBus, place.pciDevice, place.pciFunction};
}

namespace {

// ---- Files of sysfs -----------------------------------------------------------------------------

// Reads one number; absent if the file does not exist or holds none.
std::optional<double> readNumber(const std::filesystem::path& path) {
    std::ifstream file(path);
    double number = 0.0;
    if (!(file >> number)) return std::nullopt;
    return number;
}

// Reads a number in units of `unit`; absent also for 0.
std::optional<double> readPositive(const std::filesystem::path& path, double unit = 1.0) {
    const std::optional<double> number = readNumber(path);
    if (!number || *number <= 0.0) return std::nullopt;
    return *number * unit;
}

// Returns the last entry of a folder with this file or folder in it; empty if there is none.
std::filesystem::path findIn(const std::filesystem::path& folder, const char* name) {
    std::filesystem::path found;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
        if (std::filesystem::exists(entry.path() / name, none)) found = entry.path();
    return found;
}

// ---- AMD: sysfs of amdgpu -----------------------------------------------------------------------

struct ClockLevels {
    std::optional<double> present;  // MHz
    std::optional<double> greatest;  // MHz
};

// Parses lines of the form "1: 1500Mhz *".
ClockLevels readLevels(const std::filesystem::path& path) {
    ClockLevels levels;
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

// Reads the reasons for a lowered clock from the metrics table that the firmware writes (Linux,
// amdgpu's gpu_metrics; struct gpu_metrics_v1_3 of kgd_pp_interface.h, discrete boards). 64 bits
// from byte 112 on: 0 to 15 are power limits, 16 to 31 current limits and 32 to 55 temperatures.
// Returns nothing for other versions of the table.
std::vector<std::string> readThrottling(const std::filesystem::path& path) {
    constexpr std::size_t kSize = 120, kStatus = 112;
    std::ifstream file(path, std::ios::binary);
    char table[kSize];
    if (!file.read(table, sizeof table)) return {};
    std::uint16_t size = 0;
    std::memcpy(&size, table, sizeof size);
    if (size != kSize || table[2] != 1 || table[3] != 3) return {};
    std::uint64_t status = 0;
    std::memcpy(&status, table + kStatus, sizeof status);
    std::vector<std::string> reasons;
    if (status & 0xffffull) reasons.emplace_back(report::kPowerCap);
    if (status & 0xffff0000ull) reasons.emplace_back(report::kCurrentLimit);
    if (status & 0xffffff00000000ull) reasons.emplace_back("thermal limit");
    return reasons;
}

class Amdgpu : public ClockSource {
public:
    explicit Amdgpu(std::filesystem::path device) : device_(std::move(device)) {}

    ~Amdgpu() override { unlock(); }

    bool lock() override {
        std::string before;
        std::ifstream(level_) >> before;
        if (before.empty() || !write(kLocked)) return false;
        if (!found_) found_ = before;
        return true;
    }

    void unlock() override {
        if (found_) write(*found_);
        found_.reset();
    }

    std::string lockCommand() const override {
        return std::string("echo ") + kLocked + " > " + level_.string();
    }

    std::optional<double> powerLimit() override {
        return readPositive(monitor_ / "power1_cap", 1e-6);
    }

    ClockReading read() override {
        ClockReading reading;
        const ClockLevels shaders = readLevels(device_ / "pp_dpm_sclk");
        reading.clock_mhz = shaders.present;
        reading.base_clock_mhz = shaders.greatest;
        reading.memory_clock_mhz = readLevels(device_ / "pp_dpm_mclk").present;
        if (const auto hertz = readNumber(monitor_ / "freq1_input"); hertz && *hertz > 0.0)
            reading.clock_mhz = *hertz / 1e6;
        if (const auto millidegrees = readNumber(monitor_ / "temp1_input"))
            reading.temperature = *millidegrees / 1e3;
        auto microwatts = readNumber(monitor_ / "power1_average");
        if (!microwatts) microwatts = readNumber(monitor_ / "power1_input");
        if (microwatts) reading.power_w = *microwatts / 1e6;
        if (const auto percent = readNumber(device_ / "gpu_busy_percent"))
            reading.load = *percent / 100.0;
        reading.throttle_reasons = readThrottling(device_ / "gpu_metrics");
        std::string level;
        std::ifstream(level_) >> level;
        if (!level.empty() && level != "auto") {
            reading.held = true;
            reading.base_clock_mhz.reset();
        }
        return reading;
    }

private:
    static constexpr const char* kLocked = "profile_standard";

    // Drivers refuse unsupported levels when the text is flushed.
    bool write(const std::string& level) const {
        std::ofstream file(level_);
        file << level << std::flush;
        return file.good();
    }

    std::filesystem::path device_;
    std::filesystem::path level_ = device_ / "power_dpm_force_performance_level";
    std::filesystem::path monitor_ = findIn(device_ / "hwmon", "");  // hwmon0, or another number
    std::optional<std::string> found_;  // the level before lock()
};

}  // namespace

std::unique_ptr<ClockSource>
openAmdgpu(const PciAddress& address, const std::filesystem::path& devices) {
    const std::filesystem::path device = devices / addressText(address);
    if (!readLevels(device / "pp_dpm_sclk").greatest) return nullptr;
    return std::make_unique<Amdgpu>(device);
}

namespace {

// ---- Intel: sysfs of i915 and xe ----------------------------------------------------------------

// The files of a driver, relative to its folder for a graphics unit.
struct IntelNames {
    const char* actual;
    const char* least;  // limits that an administrator can set
    const char* most;
    const char* rated;
    const char* reason;  // beginning of the names of throttle reasons
};
constexpr IntelNames kI915{
    "rps_act_freq_mhz", "rps_min_freq_mhz", "rps_max_freq_mhz", "rps_RP0_freq_mhz",
    "throttle_reason_"};
constexpr IntelNames kXe{"act_freq", "min_freq", "max_freq", "rp0_freq", "throttle/reason_"};

struct IntelReason {
    const char* file;
    const char* name;
};
constexpr IntelReason kIntelReasons[] = {
    {"pl1", report::kPowerCap},         {"pl2", report::kPowerCap},
    {"pl4", report::kCurrentLimit},  // the peak, also called iccmax
    {"vr_tdc", report::kCurrentLimit},  // of the voltage regulator
    {"thermal", "thermal limit"},       {"prochot", "thermal limit"},
    {"ratl", "thermal limit"},  // a running average
    {"vr_thermalert", "thermal limit"},
};

class Intel : public ClockSource {
public:
    Intel(const std::filesystem::path& device, std::filesystem::path unit, const IntelNames& names)
        : monitor_(findIn(device / "hwmon", "")), unit_(std::move(unit)), names_(names) {}

    std::optional<double> energy() override {
        return readPositive(monitor_ / "energy1_input", 1e-6);
    }
    std::optional<double> powerLimit() override {
        return readPositive(monitor_ / "power1_max", 1e-6);
    }
    std::string lockCommand() const override {
        return "echo MHZ | tee " + (unit_ / names_.most).string() + ' ' +
               (unit_ / names_.least).string();
    }

    ClockReading read() override {
        ClockReading reading;
        reading.clock_mhz = readPositive(unit_ / names_.actual);
        reading.idle = !reading.clock_mhz;
        const auto rated = readPositive(unit_ / names_.rated);
        const auto most = readPositive(unit_ / names_.most);
        reading.held =
            most && ((rated && *most < *rated) || readPositive(unit_ / names_.least) == most);
        if (!reading.held) reading.base_clock_mhz = rated;
        for (const char* file : {"temp1_input", "temp2_input"})
            if (!reading.temperature) reading.temperature = readPositive(monitor_ / file, 1e-3);
        for (const auto& [file, name] : kIntelReasons)
            if (readPositive(unit_ / (std::string(names_.reason) + file)) &&
                std::ranges::find(reading.throttle_reasons, name) == reading.throttle_reasons.end())
                reading.throttle_reasons.emplace_back(name);
        return reading;
    }

private:
    std::filesystem::path monitor_;
    std::filesystem::path unit_;
    const IntelNames& names_;
};

}  // namespace

std::unique_ptr<ClockSource>
openIntel(const PciAddress& address, const std::filesystem::path& devices) {
    const std::filesystem::path device = devices / addressText(address);
    const std::filesystem::path card = findIn(device / "drm", "gt/gt0/rps_act_freq_mhz");
    if (!card.empty()) return std::make_unique<Intel>(device, card / "gt/gt0", kI915);
    const std::filesystem::path unit = device / "tile0/gt0/freq0";
    if (!readNumber(unit / kXe.actual)) return nullptr;
    return std::make_unique<Intel>(device, unit, kXe);
}

namespace {

// ---- NVIDIA: NVML -------------------------------------------------------------------------------

// The part of NVML's C interface that is used here, after the NVML API Reference. Results and enums
// are ints; a device is an opaque pointer.
constexpr int kSuccess = 0;  // NVML_SUCCESS
constexpr int kShaderClock = 1;  // NVML_CLOCK_SM
constexpr int kMemoryClock = 2;  // NVML_CLOCK_MEM
constexpr int kChipTemperature = 0;  // NVML_TEMPERATURE_GPU
using Device = void*;
using Init = int (*)();
using Shutdown = int (*)();
using HandleByAddress = int (*)(const char* address, Device* device);
using ClockQuery = int (*)(Device device, int clock, unsigned int* megahertz);
using Temperature = int (*)(Device device, int sensor, unsigned int* degrees);
using Reasons = int (*)(Device device, unsigned long long* bits);
// The mean of a second on Ampere and later, except for GA100.
using Power = int (*)(Device device, unsigned int* milliwatts);
// Since the driver was loaded; Volta and later.
using Energy = int (*)(Device device, unsigned long long* millijoules);
struct Utilization {
    unsigned int shaders;  // percent of the last period, which is between 1/6 and 1 s
    unsigned int memory;
};
constexpr double kLoadLag = 1.0;  // s, the longest of these periods
using Load = int (*)(Device device, Utilization* utilization);
using Lock = int (*)(Device device, unsigned int least_megahertz, unsigned int most_megahertz);
using Unlock = int (*)(Device device);
constexpr unsigned int kDesignPowerClock = 0xffffff01;  // NVML_CLOCK_LIMIT_ID_TDP

struct Reason {
    unsigned long long bit;
    const char* name;
};

constexpr unsigned long long kIdle = 0x1;
constexpr unsigned long long kHeld = 0x2;  // the applications clocks setting
constexpr Reason kReasons[] = {
    {0x4, report::kPowerCap},
    {0x8, "hardware slowdown"},
    {0x10, "sync boost"},
    {0x20, "software thermal slowdown"},
    {0x40, "hardware thermal slowdown"},
    {0x80, "power brake"},
    {0x100, "display clock setting"},
};

class Nvml : public ClockSource {
public:
    Nvml(const PciAddress& address, const std::string& library)
        : library_(library), address_(addressText(address)) {
        const auto init = library_.find<Init>("nvmlInit_v2");
        shutdown_ = library_.find<Shutdown>("nvmlShutdown");
        if (!init || !shutdown_ || init() != kSuccess) return;
        started_ = true;
        const auto handle = library_.find<HandleByAddress>("nvmlDeviceGetHandleByPciBusId_v2");
        if (!handle || handle(address_.c_str(), &device_) != kSuccess) return;
        found_ = true;
        clock_ = library_.find<ClockQuery>("nvmlDeviceGetClockInfo");
        applications_clock_ = library_.find<ClockQuery>("nvmlDeviceGetApplicationsClock");
        greatest_clock_ = library_.find<ClockQuery>("nvmlDeviceGetMaxClockInfo");
        temperature_ = library_.find<Temperature>("nvmlDeviceGetTemperature");
        power_ = library_.find<Power>("nvmlDeviceGetPowerUsage");
        power_limit_ = library_.find<Power>(
            "nvmlDeviceGetEnforcedPowerLimit", "nvmlDeviceGetPowerManagementLimit");
        energy_ = library_.find<Energy>("nvmlDeviceGetTotalEnergyConsumption");
        load_ = library_.find<Load>("nvmlDeviceGetUtilizationRates");
        lock_ = library_.find<Lock>("nvmlDeviceSetGpuLockedClocks");
        unlock_ = library_.find<Unlock>("nvmlDeviceResetGpuLockedClocks");
        reasons_ = library_.find<Reasons>(
            "nvmlDeviceGetCurrentClocksEventReasons", "nvmlDeviceGetCurrentClocksThrottleReasons");
    }
    Nvml(const Nvml&) = delete;
    Nvml& operator=(const Nvml&) = delete;
    ~Nvml() override {
        unlock();
        if (started_) shutdown_();
    }

    bool lock() override {
        if (!lock_ || !unlock_ || lock_(device_, kDesignPowerClock, kDesignPowerClock) != kSuccess)
            return false;
        locked_ = true;
        return true;
    }

    void unlock() override {
        if (locked_) unlock_(device_);
        locked_ = false;
    }

    std::string lockCommand() const override {
        return "nvidia-smi --id=" + address_ + " --lock-gpu-clocks=MHZ";
    }

    bool found() const { return found_; }

    ClockReading read() override {
        ClockReading reading;
        unsigned long long bits = 0;
        if (reasons_ && reasons_(device_, &bits) == kSuccess) {
            reading.idle = (bits & kIdle) != 0;
            reading.held = (bits & kHeld) != 0;
            for (const Reason& reason : kReasons)
                if (bits & reason.bit) reading.throttle_reasons.emplace_back(reason.name);
        }
        reading.clock_mhz = value(clock_, kShaderClock);
        reading.memory_clock_mhz = value(clock_, kMemoryClock);
        reading.temperature = value(temperature_, kChipTemperature);
        if (unsigned int milliwatts = 0; power_ && power_(device_, &milliwatts) == kSuccess)
            reading.power_w = milliwatts * 1e-3;
        if (Utilization use{}; load_ && load_(device_, &use) == kSuccess) {
            reading.load = use.shaders * 1e-2;
            reading.load_lag = kLoadLag;
        }
        if (!reading.held) {
            reading.base_clock_mhz = value(applications_clock_, kShaderClock);
            if (!reading.base_clock_mhz)
                reading.base_clock_mhz = value(greatest_clock_, kShaderClock);
        }
        return reading;
    }

    std::optional<double> powerLimit() override {
        unsigned int milliwatts = 0;
        if (!power_limit_ || power_limit_(device_, &milliwatts) != kSuccess) return std::nullopt;
        return milliwatts * 1e-3;
    }

    std::optional<double> energy() override {
        unsigned long long millijoules = 0;
        if (!energy_ || energy_(device_, &millijoules) != kSuccess) return std::nullopt;
        return static_cast<double>(millijoules) * 1e-3;
    }

private:
    // Returns the result of an NVML function; absent if the function is missing, fails or returns
    // 0.
    template <class Function>
    std::optional<double> value(Function function, int what) const {
        unsigned int number = 0;
        if (!function || function(device_, what, &number) != kSuccess || number == 0)
            return std::nullopt;
        return number;
    }

    engine::system::Library library_;
    std::string address_;
    Shutdown shutdown_ = nullptr;
    bool started_ = false;
    bool found_ = false;
    Device device_ = nullptr;
    ClockQuery clock_ = nullptr;
    ClockQuery applications_clock_ = nullptr;
    ClockQuery greatest_clock_ = nullptr;
    Temperature temperature_ = nullptr;
    Reasons reasons_ = nullptr;
    Power power_ = nullptr;
    Power power_limit_ = nullptr;
    Energy energy_ = nullptr;
    Load load_ = nullptr;
    Lock lock_ = nullptr;
    Unlock unlock_ = nullptr;
    bool locked_ = false;
};

}  // namespace

std::unique_ptr<ClockSource> openNvml(const PciAddress& address, const std::string& library) {
    auto nvml = std::make_unique<Nvml>(address, library);
    if (!nvml->found()) return nullptr;
    return nvml;
}

}  // namespace benchmarks::measure
