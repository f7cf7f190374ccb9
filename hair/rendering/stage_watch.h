#pragma once

#include <cstdint>

#include "engine/buffer.h"
#include "engine/device.h"

namespace hair {

// Where watched stages leave a trace: a condition on what an invocation made decides whether it is
// added up. Drivers can't know it, so that they must do the work of all.
class StageWatch {
public:
    // Sees next to none. Throws engine::Unsupported where stages before the rasteriser can't store.
    explicit StageWatch(const engine::Device& device);

    std::uint64_t address() const { return buffer_.address(); }

    // From the next frame on; the device must be done with the last one. Every invocation: adding
    // them up costs much. Or next to none, one of 2^32 for outputs without order: that is a
    // comparison.
    void seeAll();
    void seeNone();

    struct Seen {
        std::uint32_t invocations = 0;
        std::uint32_t sum = 0;  // of the bits of what they made, modulo 2^32
    };
    // Since the last call of these two. Waits for the device.
    Seen seen() const;

private:
    void see(std::uint32_t mask, std::uint32_t wanted);

    const engine::Device& device_;
    engine::Buffer buffer_;
};

}  // namespace hair
