#include "benchmarks/frame_range.h"

#include <charconv>
#include <string>
#include <vector>

#include "engine/error.h"

namespace benchmarks {

FrameRange parseFrameRange(std::string_view text) {
    const auto refuse = [&](const char* reason) {
        throw engine::Error("--frames " + std::string(text), reason);
    };
    constexpr std::uint32_t kMost = 1'000'000;  // that a frame's number may be
    std::vector<std::uint32_t> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        std::uint32_t number = 0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || number > kMost)
            refuse("is not A:B or A:B:STEP, of numbers up to a million");
        numbers.push_back(number);
        if (after == end) break;
        if (*after != ':' || numbers.size() == 3)
            refuse("is not A:B or A:B:STEP, of numbers up to a million");
        at = after + 1;
    }
    if (numbers.size() < 2) refuse("is one frame: --frame draws it");
    const FrameRange range{numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 1};
    if (range.step == 0) refuse("has a step of 0");
    if (range.first >= range.end) refuse("holds no frame: B is not drawn");
    return range;
}

}  // namespace benchmarks
