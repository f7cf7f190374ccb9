#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/frame_loop.h"
#include "engine/target.h"
#include "hair/rendering/strand_backend.h"

namespace hair {

// How many of a picture's fragments the lists have room for, and how many there were.
struct ListedFragments {
    std::uint64_t capacity = 0;
    std::uint64_t wanted = 0;

    std::uint64_t dropped() const { return wanted > capacity ? wanted - capacity : 0; }
};

// What becomes of strands' fragments: one kind of transparency.
class StrandBlend {
public:
    virtual ~StrandBlend() = default;

    // What a back end's pipeline writes, but for how strands are shaded.
    virtual StrandOutput output() const = 0;

    // The pass "strands", in which `draw` draws them, and "composite", where there is one.
    virtual void record(
        engine::Passes& passes, const engine::Target& target,
        const std::function<void(engine::Commands&)>& draw) const = 0;

    // PictureParameters::fragments.
    virtual std::uint64_t fragments() const { return 0; }

    // Memory that transparency takes beside the target.
    virtual std::uint64_t bytes() const { return 0; }

    // The last picture's; waits for the device. Absent where fragments are not listed.
    virtual std::optional<ListedFragments> listed() const { return std::nullopt; }
};

}  // namespace hair
