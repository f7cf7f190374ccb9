#include "benchmarks/machine/pci_address.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

namespace benchmarks {

namespace {

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

}  // namespace benchmarks
