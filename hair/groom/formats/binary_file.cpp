#include "hair/groom/formats/binary_file.h"

#include <algorithm>
#include <cmath>

namespace hair::groom {
namespace {

constexpr std::size_t kBlock = 4096;

// Whether all numbers are finite: only infinities and NaNs have all bits of the exponent set. It
// has no branch, so that the compiler makes vector instructions of it.
bool allFinite(std::span<const float> numbers) {
    constexpr std::uint32_t kExponent = 0x7f800000;
    std::uint32_t wrong = 0;
    for (const float number : numbers)
        wrong |= (std::bit_cast<std::uint32_t>(number) & kExponent) == kExponent ? 1u : 0u;
    return wrong == 0;
}

}  // namespace

std::optional<std::size_t> firstNotFinite(std::span<const float> numbers) {
    for (std::size_t start = 0; start < numbers.size(); start += kBlock) {
        const auto block = numbers.subspan(start, std::min(kBlock, numbers.size() - start));
        if (allFinite(block)) continue;
        const auto at = std::ranges::find_if_not(block, [](float x) { return std::isfinite(x); });
        return start + static_cast<std::size_t>(at - block.begin());
    }
    return {};
}

bool isNegative(float width) { return width < 0.0f && std::isfinite(width); }

// Like allFinite(), it has no branch within a block. Minus infinity may make it look twice.
bool anyNegative(std::span<const float> widths) {
    for (std::size_t start = 0; start < widths.size(); start += kBlock) {
        const auto block = widths.subspan(start, std::min(kBlock, widths.size() - start));
        std::uint32_t less = 0;
        for (const float width : block) less |= width < 0.0f ? 1u : 0u;
        if (less != 0 && std::ranges::any_of(block, isNegative)) return true;
    }
    return false;
}

}  // namespace hair::groom
