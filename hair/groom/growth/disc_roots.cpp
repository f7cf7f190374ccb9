#include "hair/groom/growth/disc_roots.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "hair/groom/growth/flatten.h"
#include "hair/groom/growth/hairline.h"
#include "hair/groom/growth/outline.h"
#include "hair/groom/growth/root_samples.h"
#include "hair/groom/growth/spread.h"
#include "hair/groom/growth/triangulate.h"

namespace hair {
namespace {

constexpr std::uint32_t kCandidatesPerRoot = 10;

glm::dvec3 middle(const std::array<SurfacePoint, 2>& pair) {
    return 0.5 * (glm::dvec3(pair[0].position) + glm::dvec3(pair[1].position));
}

// Rows that end at the hairline end with two of its roots: where it is cut for that.
std::vector<double> hairlineCuts(
    const Scalp& scalp, const Hairline& hairline, const PartingLine& parting,
    const PartingRows& rows) {
    std::vector<double> cuts;
    if (parting.endsAtBoundary()[0])
        cuts.push_back(nearestLength(scalp, hairline, middle(rows.pairs.front())));
    if (parting.endsAtBoundary()[1])
        cuts.push_back(nearestLength(scalp, hairline, middle(rows.pairs.back())));
    return cuts;
}

}  // namespace

std::uint32_t boundaryRootCount(std::uint32_t guides) {
    const double count = std::round(34.0 * std::sqrt(guides / 86.0));
    return std::min(guides, std::max(3u, static_cast<std::uint32_t>(count)));
}

std::vector<double>
hairlineLengths(double total, std::uint32_t count, std::vector<double> cuts, double gap) {
    std::vector<double> lengths;
    if (cuts.empty()) {
        for (std::uint32_t i = 0; i < count; ++i) lengths.push_back(total * i / count);
        return lengths;
    }
    std::ranges::sort(cuts);
    const double cut_away = 2.0 * gap * static_cast<double>(cuts.size());
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        const double from = cuts[i] + gap;
        const double to = (i + 1 < cuts.size() ? cuts[i + 1] : cuts[0] + total) - gap;
        const auto left = count - static_cast<std::uint32_t>(lengths.size());
        const double share = std::round(count * (to - from) / (total - cut_away));
        // The last part takes what is left; each has its two ends.
        const std::uint32_t here =
            i + 1 == cuts.size() ? left
                                 : std::clamp(static_cast<std::uint32_t>(share), 2u, left - 2);
        for (std::uint32_t k = 0; k < here; ++k)
            lengths.push_back(from + (to - from) * k / (here - 1));
    }
    return lengths;
}

Roots discRoots(const Scalp& scalp, const RootOptions& options, const PartingRows* rows) {
    const Hairline hairline = traceHairline(scalp);
    const Flattening flattening = flatten(scalp);
    std::vector<std::array<SurfacePoint, 2>> pairs;
    std::vector<double> cuts;
    if (rows) {
        pairs = rows->pairs;
        cuts = hairlineCuts(scalp, hairline, *options.parting, *rows);
        if (options.parting->endsAtBoundary()[0]) pairs.erase(pairs.begin());
        if (options.parting->endsAtBoundary()[1]) pairs.pop_back();
    }
    const auto in_rows = static_cast<std::uint32_t>(2 * pairs.size());
    const auto cut_roots = static_cast<std::uint32_t>(2 * cuts.size());
    Roots roots;
    roots.boundary_count = std::max(boundaryRootCount(options.guides - in_rows), cut_roots);
    for (const double length :
         hairlineLengths(hairline.length(), roots.boundary_count, cuts, rows ? rows->gap : 0.0))
        roots.points.push_back(hairlinePoint(scalp, hairline, length));
    std::vector<glm::dvec2> flat;
    for (const SurfacePoint& point : roots.points) flat.push_back(flattening(point.position));
    const Outline outline(flat);
    const auto add = [&](const SurfacePoint& point) {
        roots.points.push_back(point);
        flat.push_back(flattening(point.position));
    };
    for (const auto& pair : pairs) {
        if (!outline.contains(flattening(pair[0].position)) ||
            !outline.contains(flattening(pair[1].position)))
            continue;
        for (const SurfacePoint& root : pair) add(root);
    }

    // Between neighbouring roots the hairline is a straight line of the flattened scalp: candidates
    // beyond it don't count.
    const auto inside = options.guides - static_cast<std::uint32_t>(roots.points.size());
    const std::uint32_t wanted = inside * kCandidatesPerRoot;
    const auto isFree = [&](std::uint32_t, const SurfacePoint& sample) {
        return outline.contains(flattening(sample.position)) &&
               !(rows && options.parting->isNear(sample.position, rows->reach()));
    };
    const RootSamples candidates =
        takeSamples(scalp, options.seed, wanted, std::uint64_t{wanted} * 10, isFree);
    if (candidates.numbers.size() < wanted)
        throw engine::Error("too little of the scalp lies inside its hairline");
    std::vector<glm::vec3> fixed;
    for (const SurfacePoint& point : roots.points) fixed.push_back(point.position);
    for (const std::uint32_t i : spread(candidates.positions, fixed, inside, scalp.area()))
        add(rootSample(scalp, options.seed, candidates.numbers[i]));
    roots.triangles = triangulate(flat, roots.boundary_count);
    return roots;
}

}  // namespace hair
