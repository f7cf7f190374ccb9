#pragma once

#include <cstdint>
#include <string_view>

namespace benchmarks {

// Frames `first`, `first` + `step` ... that are below `end`.
struct FrameRange {
    std::uint32_t first = 0;
    std::uint32_t end = 1;
    std::uint32_t step = 1;

    std::uint32_t count() const { return (end - first + step - 1) / step; }
    bool holds(std::uint32_t frame) const {
        return frame >= first && frame < end && (frame - first) % step == 0;
    }
};

// Of "A:B" or "A:B:STEP". Throws engine::Error for anything else, and where there is no frame.
FrameRange parseFrameRange(std::string_view text);

}  // namespace benchmarks
