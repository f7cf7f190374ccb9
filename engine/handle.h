#pragma once

#include <utility>

#include "engine/vulkan.h"

namespace engine {

// Owns one Vulkan object that a device made. `Destroy` is the address of volk's function pointer,
// e.g. Handle<VkSampler, &vkDestroySampler>.
template <class Object, auto Destroy>
class Handle {
public:
    Handle() = default;
    Handle(VkDevice device, Object object) : device_(device), object_(object) {}
    Handle(Handle&& other) noexcept
        : device_(other.device_), object_(std::exchange(other.object_, Object{})) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() {
        if (object_) (*Destroy)(device_, object_, nullptr);
    }

    Object get() const { return object_; }

private:
    VkDevice device_{};
    Object object_{};
};

}  // namespace engine
