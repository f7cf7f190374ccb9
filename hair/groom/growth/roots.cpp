#include "hair/groom/growth/roots.h"

#include <cmath>
#include <optional>

#include "engine/error.h"
#include "hair/groom/growth/disc_roots.h"
#include "hair/groom/growth/surface_roots.h"

namespace hair {
namespace {

// Mean distance to the nearest neighbour of roots that are spread, as a part of the root of their
// share of the area: the best there is, a hexagonal packing, has 1.07.
constexpr double kSpacing = 0.8;

Roots placedRoots(
    const Scalp& scalp, const NearestSurface& surface, const RootOptions& options,
    const PartingRows* rows) {
    const bool has_hairline =
        !options.mask && options.guides >= 3 && options.placement == RootPlacement::poisson_disc;
    if (!has_hairline) return surfaceRoots(scalp, surface, options, rows);
    try {
        return discRoots(scalp, options, rows);
    } catch (const engine::Error&) {  // no disc, or one that isn't flat enough
        return surfaceRoots(scalp, surface, options, rows);
    }
}

}  // namespace

Roots placeRoots(const Scalp& scalp, const NearestSurface& surface, const RootOptions& options) {
    std::optional<PartingRows> rows;
    if (options.parting) {
        const double spacing = kSpacing * std::sqrt(scalp.area() / options.guides);
        rows = partingRows(*options.parting, scalp, surface, spacing);
        if (2 * rows->pairs.size() + 3 > options.guides) rows.reset();
    }
    Roots roots = placedRoots(scalp, surface, options, rows ? &*rows : nullptr);
    if (rows) {
        std::vector<glm::dvec3> positions;
        for (const SurfacePoint& root : roots.points) positions.emplace_back(root.position);
        eraseCrossing(roots.triangles, positions, *options.parting, rows->gap);
    }
    return roots;
}

}  // namespace hair
