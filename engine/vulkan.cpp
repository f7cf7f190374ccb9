#include "engine/vulkan.h"

#include <array>
#include <utility>

#include "engine/device_lost.h"

namespace engine {

namespace {

constexpr std::array kResultNames{
    std::pair{VK_NOT_READY, "VK_NOT_READY"},
    std::pair{VK_TIMEOUT, "VK_TIMEOUT"},
    std::pair{VK_INCOMPLETE, "VK_INCOMPLETE"},
    std::pair{VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY"},
    std::pair{VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
    std::pair{VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED"},
    std::pair{VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST"},
    std::pair{VK_ERROR_MEMORY_MAP_FAILED, "VK_ERROR_MEMORY_MAP_FAILED"},
    std::pair{VK_ERROR_LAYER_NOT_PRESENT, "VK_ERROR_LAYER_NOT_PRESENT"},
    std::pair{VK_ERROR_EXTENSION_NOT_PRESENT, "VK_ERROR_EXTENSION_NOT_PRESENT"},
    std::pair{VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT"},
    std::pair{VK_ERROR_INCOMPATIBLE_DRIVER, "VK_ERROR_INCOMPATIBLE_DRIVER"},
    std::pair{VK_ERROR_TOO_MANY_OBJECTS, "VK_ERROR_TOO_MANY_OBJECTS"},
    std::pair{VK_ERROR_FORMAT_NOT_SUPPORTED, "VK_ERROR_FORMAT_NOT_SUPPORTED"},
    std::pair{VK_ERROR_UNKNOWN, "VK_ERROR_UNKNOWN"},
};

}  // namespace

std::string resultName(VkResult result) {
    for (const auto& [value, name] : kResultNames) {
        if (value == result) return name;
    }
    return "VkResult " + std::to_string(static_cast<int>(result));
}

void check(VkResult result, const char* what) {
    if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost(what, resultName(result));
    if (result < VK_SUCCESS) throw Error(what, resultName(result));
}

}  // namespace engine
