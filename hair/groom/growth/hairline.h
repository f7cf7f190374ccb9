#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hair/groom/growth/scalp.h"

namespace hair {

// The edge of a scalp that is a disc: one piece of surface with one boundary.
struct Hairline {
    std::vector<std::uint32_t> vertices;   // of the scalp, which is on their left
    std::vector<std::uint32_t> triangles;  // [edge], of the scalp; from a vertex to the next
    std::vector<double> arc;  // [edge], m, up to its start; the whole length at the end

    double length() const { return arc.back(); }
};

// Throws engine::Error if the scalp is no disc.
Hairline traceHairline(const Scalp& scalp);

// The point of the hairline after this length; one beyond its end goes on from its start.
SurfacePoint hairlinePoint(const Scalp& scalp, const Hairline& hairline, double length);

// The length at which the hairline is nearest to a point.
double nearestLength(const Scalp& scalp, const Hairline& hairline, const glm::dvec3& point);

}  // namespace hair
