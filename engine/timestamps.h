#pragma once

#include <cstdint>
#include <vector>

#include "engine/commands.h"

namespace engine {

// A pool of GPU timestamps for one frame.
class Timestamps {
public:
    Timestamps(const Device& device, std::uint32_t capacity);

    // Makes all stamps unavailable again. The device must be done with the last frame that wrote
    // them.
    void reset();

    // Records a stamp that is taken when all earlier commands are done; returns its index. Throws
    // Error when all are taken.
    std::uint32_t write(Commands& commands);

    // ms since the first stamp, for each stamp written. The work must be complete; a stamp that the
    // device did not write is an Error.
    std::vector<double> read() const;

    std::uint32_t count() const { return count_; }

private:
    VkDevice device_;
    double period_;  // ms per tick
    std::uint64_t mask_;
    std::uint32_t capacity_;
    std::uint32_t count_ = 0;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

// `now - before` of a counter that wraps at `mask` + 1 (a power of two).
constexpr std::uint64_t ticksBetween(std::uint64_t before, std::uint64_t now, std::uint64_t mask) {
    return (now - before) & mask;
}

// Mask of the low `bits` bits, for timestampValidBits.
constexpr std::uint64_t validMask(std::uint32_t bits) {
    return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

}  // namespace engine
