#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/physical_device.h"

namespace benchmarks {

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

}  // namespace benchmarks
