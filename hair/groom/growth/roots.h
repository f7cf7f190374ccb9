#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/growth/parting.h"
#include "hair/groom/growth/root_density.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom_settings.h"
#include "hair/random.h"

namespace hair::groom {

struct RootOptions {
    std::uint32_t guides = 0;
    std::uint32_t seed = 0;
    RootPlacement placement = RootPlacement::poisson_disc;
    const Texture* mask = nullptr;           // null: everywhere alike
    const PartingLine* parting = nullptr;    // null: none
};

struct Roots {
    std::vector<SurfacePoint> points;  // the hairline's first, in its order
    std::uint32_t boundary_count = 0;
    // Counter-clockwise seen from outside. One root has {0, 0, 0}, two have {0, 1, 1}.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Puts `guides` >= 1 roots on the scalp. A disc without a mask gets poisson_disc roots as
// roots.h says, if it can be flattened; everything else as roots.h says. With a
// parting two rows of the roots run along it, and no triangle reaches over it; fewer guides than
// both rows and three more have none. Throws engine::Error if the mask leaves no place for them.
Roots placeRoots(const Scalp& scalp, const NearestSurface& surface, const RootOptions& options);

// How many of `guides` roots lie on the hairline. The thesis's 86 guides with 136 root triangles
// have 34 there (Euler: 2 * 86 - 2 - 34 = 136); the ratio of edge to area keeps it proportional to
// the square root.
std::uint32_t boundaryRootCount(std::uint32_t guides);

// Lengths along a hairline of `total` m at which `count` roots are evenly spaced, the first at 0;
// or with up to two cuts from `gap` after one to `gap` before the next, both with a root.
std::vector<double>
hairlineLengths(double total, std::uint32_t count, std::vector<double> cuts, double gap);

// Puts `guides` >= 3 roots on a scalp that is a disc, some evenly along the hairline, the rest
// spread over the inside, and spans them by triangles that are Delaunay on the sphere of
// directions. Throws engine::Error if the scalp is no disc or can't be flattened.
Roots discRoots(const Scalp& scalp, const RootOptions& options, const PartingRows* rows);

// Points picked at random, uniform in area, each known by its number.
struct RootSamples {
    std::vector<std::uint32_t> numbers;
    std::vector<glm::vec3> positions;  // m
};

inline SurfacePoint rootSample(const Scalp& scalp, std::uint32_t seed, std::uint32_t number) {
    return sampleSurface(
        scalp, {random01(seed, number, purpose::root_triangle),
                random01(seed, number, purpose::root_u), random01(seed, number, purpose::root_v)});
}

// The first `count` samples that are accepted, or fewer if `tries` run out.
template <class Accept>
RootSamples takeSamples(
    const Scalp& scalp, std::uint32_t seed, std::uint32_t count, std::uint64_t tries,
    Accept&& accept) {
    RootSamples samples;
    samples.numbers.reserve(count);
    samples.positions.reserve(count);
    for (std::uint32_t i = 0; i < tries && samples.numbers.size() < count; ++i) {
        const SurfacePoint sample = rootSample(scalp, seed, i);
        if (!accept(i, sample)) continue;
        samples.numbers.push_back(i);
        samples.positions.push_back(sample.position);
    }
    return samples;
}

}  // namespace hair::groom
