#pragma once

#include <filesystem>
#include <memory>

#include "benchmarks/machine/clock_source.h"
#include "benchmarks/machine/pci_address.h"

namespace benchmarks {

// The Linux driver amdgpu's files in sysfs (Linux documentation, "GPU Power/Thermal Controls and
// Monitoring"): pp_dpm_sclk and pp_dpm_mclk list the levels of a clock, a '*' behind the present
// one; hwmon has the temperature and, on newer kernels, the shaders' measured clock. Null where the
// device has no pp_dpm_sclk. No file says what clock the board is rated for, so the base clock is
// the highest level's.
std::unique_ptr<ClockSource> openAmdgpu(
    const PciAddress& address, const std::filesystem::path& devices = "/sys/bus/pci/devices");

}  // namespace benchmarks
