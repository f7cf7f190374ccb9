#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/vulkan.h"

namespace engine {

enum class Validation {
    off,
    on,  // the Khronos layer with synchronisation validation; an Error if it is not installed
};

// Warnings and errors of the validation layer, in the order they came. Thread-safe.
class MessageLog {
public:
    void add(std::string message);
    std::vector<std::string> take();

private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

// The Vulkan loader and instance. Throws NoDevice where no loader or no Vulkan 1.3 instance exists.
class Instance {
public:
    // `extensions`: those that windows need.
    explicit Instance(
        Validation validation, const std::vector<std::string>& window_extensions = {});
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance get() const { return instance_; }
    MessageLog& messages() const { return *messages_; }
    std::vector<VkPhysicalDevice> physicalDevices() const;

private:
    std::unique_ptr<MessageLog> messages_;
    VkInstance instance_{};
    VkDebugUtilsMessengerEXT messenger_{};
};

// No Vulkan, or no device that can run hairbench.
class NoDevice : public Error {
public:
    using Error::Error;
};

}  // namespace engine
