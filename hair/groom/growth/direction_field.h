#pragma once

#include <glm/vec3.hpp>

#include "hair/groom/growth/parting.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/mesh/nearest_surface.h"
#include "hair/groom_settings.h"

namespace hair {

// The direction in which hair leaves the scalp:
//     normalize(normal + comb + whorl + parting),     the normal alone where they cancel it.
// whorl    along the surface, round the point c of the scalp that is nearest to its position, at
//          the distance r from it: strength (r / radius) exp((1 - (r / radius)^2) / 2), which is
//          `strength` at the radius and less everywhere else.
// parting  along the surface, away from the line at the distance d: strength exp(-d / reach); past
//          an end, times the cosine between the way from there and the way across the line.
// With a whorl or a parting, no direction is nearer to the surface than asin 0.05.
class DirectionField {
public:
    // Borrows all of them; `parting` may be null.
    DirectionField(
        const GrowSettings& settings, const NearestSurface& surface, const PartingLine* parting);

    glm::dvec3 operator()(const SurfacePoint& root) const;

private:
    const GrowSettings& settings_;
    const PartingLine* parting_;
    glm::dvec3 whorl_centre_{0.0};
};

}  // namespace hair
