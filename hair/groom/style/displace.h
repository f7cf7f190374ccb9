#pragma once

#include <utility>

#include "hair/groom/groom.h"
#include "hair/groom/style/along_strand.h"

namespace hair {

// Moves the points of every strand but its root. `offsets(groom, strand, along)` gives a function
// from a point's index to its displacement, which grows from 0 at the root to all of it at the
// fraction `start` of the strand's length.
template <class Offsets>
Groom displace(Groom groom, double start, Offsets&& offsets) {
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const AlongStrand along(groom.strand(strand));
        const auto offset = offsets(std::as_const(groom), strand, along);
        glm::vec3* const points =
            groom.points.data() + std::size_t{strand} * groom.vertices_per_strand;
        for (std::uint32_t i = 1; i < groom.vertices_per_strand; ++i) {
            const double share = ease(0.0, start, along.fraction(i));
            points[i] = glm::vec3(glm::dvec3(points[i]) + share * offset(i));
        }
    }
    return groom;
}

// The normal of the scalp at the root of a strand, if it is known.
inline const glm::vec3* rootNormalOf(const Groom& groom, std::uint32_t strand) {
    return groom.root_normals.empty() ? nullptr : &groom.root_normals[strand];
}

}  // namespace hair
