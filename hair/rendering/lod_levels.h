#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hair/groom/groom.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// What LodMode::distance makes of a head of hair, seen from /camera/position.
struct DistanceLod {
    double mean_level = 0.0;  // over root triangles, or over the strands of a groom
    std::optional<std::uint64_t> strands;  // drawn; absent where the device orders them
};

// The level at this distance from the camera, m: 0 up to near_distance, then growing with its
// logarithm to maximum_level at far_distance.
double levelAtDistance(const LodSettings& lod, double distance);

// `guides` are where they are now, [guide][vertex], m; `view` is theirs.
DistanceLod distanceLod(
    const Groom& groom, std::span<const glm::vec3> guides, const StrandView& view,
    const Settings& settings);

}  // namespace hair
