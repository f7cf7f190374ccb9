#pragma once

#include <cstdint>

#include "hair/groom/strand_set.h"

namespace hair {

// TressFX's follow hairs, which its files leave to the loader: after each strand `count` copies of
// it, moved within a disc of `radius` (file's unit) across its direction at the root. At the tip
// the displacement is `tip_separation` times as large, in between linearly. Root triangles go on
// joining the same strands. Throws engine::Error if that makes 2^32 points or more.
// After TressFX 4.1, TressFXAsset::GenerateFollowHairs, which takes the square round that disc and
// at vertex k of V a factor of 1 + separation * k / V.
StrandSet addFollowers(
    const StrandSet& strands, std::uint32_t count, float radius, float tip_separation,
    std::uint32_t seed);

}  // namespace hair
