#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/instance.h"

// Makes Vulkan calls fail, and counts the objects that they create, by replacing volk's function
// pointers. For a program with one device, and for calls from one thread.
namespace failing {

struct Plan {
    std::string call;  // "vkQueueSubmit2"; empty: none fails
    VkResult result = VK_SUCCESS;
    std::size_t after = 0;  // calls that succeed first
    std::size_t times = 1;  // calls that then fail
};

inline Plan plan;
inline std::size_t failures = 0;  // so far, by the plan

// A function of volk's.
struct Call {
    std::string name;
    std::vector<VkResult> results;  // errors that the specification allows
    void (*install)();  // replaces the driver's function; counts from here on
    const std::size_t* calls;
    // Number of created objects that are not destroyed; null if the function creates none.
    const long* alive = nullptr;
};

template <auto* kPlace, class Function = std::remove_pointer_t<decltype(kPlace)>>
struct Made;
template <auto* kPlace, class... Arguments>
struct Made<kPlace, VkResult(VKAPI_PTR*)(Arguments...)> {
    static inline std::string name;
    static inline VkResult(VKAPI_PTR* real)(Arguments...) = nullptr;
    static inline std::size_t calls = 0;
    static inline long alive = 0;

    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
        const std::size_t index = calls++;
        if (name == plan.call && index >= plan.after && index - plan.after < plan.times) {
            // A lost device executes nothing, so this one first finishes its submitted work.
            if (plan.result == VK_ERROR_DEVICE_LOST && name.starts_with("vkWait")) {
                const VkResult result = real(arguments...);
                if (result != VK_SUCCESS) {
                    calls = index;
                    return result;
                }
            }
            ++failures;
            return plan.result;
        }
        const VkResult result = real(arguments...);
        if (result == VK_SUCCESS) ++alive;
        return result;
    }
    static void install() {
        calls = 0;
        alive = 0;
        real = std::exchange(*kPlace, &call);
    }
};

template <auto* kMake, auto* kEnd, class Function = std::remove_pointer_t<decltype(kEnd)>>
struct Ended;
template <auto* kMake, auto* kEnd, class Owner, class Object>
struct Ended<kMake, kEnd, void(VKAPI_PTR*)(Owner, Object, const VkAllocationCallbacks*)> {
    static inline void(VKAPI_PTR* real)(Owner, Object, const VkAllocationCallbacks*) = nullptr;

    static VKAPI_ATTR void VKAPI_CALL
    call(Owner owner, Object object, const VkAllocationCallbacks* callbacks) {
        if (object) --Made<kMake>::alive;
        real(owner, object, callbacks);
    }
    static void install() {
        Made<kMake>::install();
        real = std::exchange(*kEnd, &call);
    }
};

template <auto* kPlace>
Call call(const char* name, std::vector<VkResult> results) {
    Made<kPlace>::name = name;
    return {name, std::move(results), &Made<kPlace>::install, &Made<kPlace>::calls};
}

template <auto* kMake, auto* kEnd>
Call maker(const char* name, std::vector<VkResult> results) {
    Made<kMake>::name = name;
    return {
        name, std::move(results), &Ended<kMake, kEnd>::install, &Made<kMake>::calls,
        &Made<kMake>::alive};
}

}  // namespace failing
