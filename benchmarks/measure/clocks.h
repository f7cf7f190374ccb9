#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/instance.h"
#include "engine/system/files.h"
#include "engine/system/machine.h"

// Clocks and temperature of a device as its driver reports them, and locking of the clocks.
namespace benchmarks::measure {

// The state of a device's clocks at one moment. Unknown values are absent.
struct ClockReading {
    std::optional<double> clock_mhz;  // of the shaders
    // The intended shader clock. Absent also if an administrator holds the clock at another value:
    // then nothing tells whether the clock is slow.
    std::optional<double> base_clock_mhz;
    std::optional<double> memory_clock_mhz;
    std::optional<double> temperature;  // degrees Celsius
    std::optional<double> power_w;  // power draw of the board
    std::optional<double> load;  // share of the time with work on the device, 0 to 1
    double load_lag = 0.0;  // s, by which the load may be late
    std::optional<double> age;  // age of the reading, s; absent: 0
    bool idle = false;  // the device was idle, so its clocks do not apply to a measurement
    bool held = false;  // an administrator set the clocks
    std::vector<std::string> throttle_reasons;  // reasons why the clocks are lower than possible
};

// A driver interface that reads clocks and locks them.
class ClockSource {
public:
    virtual ~ClockSource() = default;
    // Changes no setting.
    virtual ClockReading read() = 0;

    // Energy that the board has used since some moment, J. Absent without a counter. May be called
    // while another thread calls read().
    virtual std::optional<double> energy() { return std::nullopt; }

    // Limit of the board's power that is in force, W. Absent if it is unknown.
    virtual std::optional<double> powerLimit() { return std::nullopt; }

    // Locks the shaders' clock at the board's sustained clock under load, until unlock() or
    // destruction. Returns false if the driver refuses; then nothing has changed.
    virtual bool lock() { return false; }
    // Removes this object's lock, if there is one.
    virtual void unlock() {}
    // The command with which an administrator does the same as lock().
    virtual std::string lockCommand() const { return {}; }
};

// Address of a device on the PCI bus.
struct PciAddress {
    std::uint32_t domain = 0;
    std::uint32_t bus = 0;
    std::uint32_t device = 0;
    std::uint32_t function = 0;
};

// "0000:65:00.0", the form of sysfs and NVML.
std::string addressText(const PciAddress& address);

// Uses VK_EXT_pci_bus_info. Absent if the device is not on a PCI bus or does not report its
// address.
std::optional<PciAddress> pciAddress(const engine::DeviceInfo& device);

// Reads the sysfs files of the Linux driver amdgpu (Linux documentation, "GPU Power/Thermal
// Controls and Monitoring"). pp_dpm_sclk and pp_dpm_mclk list the levels of a clock, with a '*'
// after the current one. hwmon has the temperature and, on newer kernels, the shaders' measured
// clock. Returns null if the device has no pp_dpm_sclk. No file has the board's rated clock, so the
// base clock is that of the highest level. lock() sets power_dpm_force_performance_level to
// "profile_standard"; unlock() restores the previous value.
std::unique_ptr<ClockSource> openAmdgpu(
    const PciAddress& address, const std::filesystem::path& devices = engine::system::pciDevices());

// Reads the sysfs files of the Linux drivers i915 (gt/gt0 of the card, with rps_act_freq_mhz) and
// xe (tile0/gt0/freq0): Linux documentation, "Intel GPU sysfs", sysfs-driver-intel-i915-hwmon and
// sysfs-driver-intel-xe-hwmon. The clock is that of the first graphics unit; it is 0 while the unit
// sleeps. The base clock is RP0, the greatest that the hardware allows. Neither driver reports the
// load, nor power other than by an energy counter. Returns null for a device without these files.
// Locks nothing, because no file has the clock that a board sustains.
std::unique_ptr<ClockSource> openIntel(
    const PciAddress& address, const std::filesystem::path& devices = engine::system::pciDevices());

// Uses the NVIDIA Management Library of the installed driver, which is loaded at run time and not
// needed to build. Returns null if the library is missing or unusable, or does not know the device.
// The base clock is the applications clock: the board's rated clock under load, or an
// administrator's choice. Boards without one (GeForce) use their maximum clock, as nvbench does.
// The base clock is absent while the driver reports that clocks follow a setting. lock() locks the
// clock of the board's design power (NVML_CLOCK_LIMIT_ID_TDP), as nvbench does. unlock() is a
// reset, which also removes an administrator's lock.
std::unique_ptr<ClockSource>
openNvml(const PciAddress& address, const std::string& library = engine::system::kNvmlLibrary);

}  // namespace benchmarks::measure
