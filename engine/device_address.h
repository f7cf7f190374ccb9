#pragma once

#include <cstdint>

namespace engine {

// A device address in structs that shaders read. It is GLSL's uvec2, aligned to 4 bytes in scalar
// layout, because not every device has 64-bit integers. 0: null.
class DeviceAddress {
public:
    constexpr DeviceAddress() = default;
    constexpr DeviceAddress(std::uint64_t address)
        : low_(static_cast<std::uint32_t>(address)),
          high_(static_cast<std::uint32_t>(address >> 32)) {}

    constexpr operator std::uint64_t() const { return std::uint64_t{high_} << 32 | low_; }

private:
    std::uint32_t low_ = 0;
    std::uint32_t high_ = 0;
};

static_assert(sizeof(DeviceAddress) == 8 && alignof(DeviceAddress) == 4);

}  // namespace engine
