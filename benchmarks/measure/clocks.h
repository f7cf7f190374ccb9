#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/instance.h"

// Clocks and temperature of a device, as its driver tells them, and how they are locked.
namespace benchmarks::measure {

// What a device says of its clocks at one moment; what it does not say is absent.
struct ClockReading {
    std::optional<double> clock_mhz;  // of the shaders
    // What the shaders are meant to run at; absent where they are held at an administrator's choice
    // too: there is nothing then to hold a slow clock against.
    std::optional<double> base_clock_mhz;
    std::optional<double> memory_clock_mhz;
    std::optional<double> temperature;  // degrees Celsius
    std::optional<double> power_w;  // that the board draws
    std::optional<double> load;  // share of the time in which the device had work, 0 to 1
    std::optional<double> age;  // s since it was so; absent: now
    bool idle = false;  // nothing ran just then: its clocks say nothing of a measurement
    bool held = false;  // an administrator set the clocks
    std::vector<std::string> throttle_reasons;  // why the clocks are lower than they might be
};

// The throttle reason of a board that draws as much power as it may.
inline constexpr const char* kPowerCap = "power cap";

// A driver's way of telling clocks, and of locking them.
class ClockSource {
public:
    virtual ~ClockSource() = default;
    // Changes no setting.
    virtual ClockReading read() = 0;

    // Locks the shaders' clock at what the board sustains under load, until unlock() or the
    // source's end. Whether the driver did; where not, nothing has changed.
    virtual bool lock() { return false; }
    // Takes its own lock off; without one nothing happens.
    virtual void unlock() {}
    // The command by which an administrator does what lock() does.
    virtual std::string lockCommand() const { return {}; }
};

// Where a device is on the PCI bus.
struct PciAddress {
    std::uint32_t domain = 0;
    std::uint32_t bus = 0;
    std::uint32_t device = 0;
    std::uint32_t function = 0;
};

// "0000:65:00.0", as sysfs and NVML write it.
std::string addressText(const PciAddress& address);

// By VK_EXT_pci_bus_info; absent where the device is on no such bus or does not say.
std::optional<PciAddress> pciAddress(const engine::DeviceInfo& device);

// The Linux driver amdgpu's files in sysfs (Linux documentation, "GPU Power/Thermal Controls and
// Monitoring"): pp_dpm_sclk and pp_dpm_mclk list the levels of a clock, a '*' behind the present
// one; hwmon has the temperature and, on newer kernels, the shaders' measured clock. Null where the
// device has no pp_dpm_sclk. No file says what clock the board is rated for, so the base clock is
// the highest level's. It is locked as power_dpm_force_performance_level "profile_standard", and
// unlocked as what was there.
std::unique_ptr<ClockSource> openAmdgpu(
    const PciAddress& address, const std::filesystem::path& devices = "/sys/bus/pci/devices");

// The NVIDIA Management Library of the installed driver, found at run time: nothing of it is needed
// to build. Null where there is no such library, it cannot be used, or it does not know the device.
// The base clock is the applications clock: what the board is rated to run at under load, or what
// an administrator chose instead. Boards without one (GeForce) have their greatest clock there,
// as nvbench takes it. It is absent while the driver says that clocks are as they were set.
// Locked is at the clock of the board's design power (NVML_CLOCK_LIMIT_ID_TDP), as nvbench locks
// it; unlocking is a reset, which takes off an administrator's lock too.
std::unique_ptr<ClockSource>
openNvml(const PciAddress& address, const std::string& library = "libnvidia-ml.so.1");

}  // namespace benchmarks::measure
