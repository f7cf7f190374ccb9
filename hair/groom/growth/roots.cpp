#include "hair/groom/growth/roots.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/growth/sample_elimination.h"
#include "hair/groom/growth/triangulate.h"

namespace hair::groom {
namespace {

// Random points, uniform in area, each known by its number.
struct RootSamples {
    std::vector<std::uint32_t> numbers;
    std::vector<glm::vec3> positions;  // m
};

// The first `count` samples that are accepted, or fewer if `tries` run out.
template <class Accept>
RootSamples takeSamples(
    const Scalp& scalp, std::uint32_t seed, std::uint32_t count, std::uint64_t tries,
    Accept&& accept) {
    RootSamples samples;
    samples.numbers.reserve(count);
    samples.positions.reserve(count);
    engine::Step step("places roots");
    for (std::uint32_t i = 0; i < tries && samples.numbers.size() < count; ++i) {
        step.advance();
        const SurfacePoint sample = rootSample(scalp, seed, i);
        if (!accept(i, sample)) continue;
        samples.numbers.push_back(i);
        samples.positions.push_back(sample.position);
    }
    return samples;
}

// ---- Roots on a scalp of any shape --------------------------------------------------------------

constexpr std::uint32_t kCandidatesPerRoot = 10;
constexpr std::uint32_t kLeastProbes = 4096;
constexpr std::uint64_t kTriesPerRoot = 1000;

// Most roots that are spread for each root that the mask keeps. If the mask is so uneven that more
// would be needed, the rest of the roots is independent.
constexpr double kMostSpreadPerRoot = 4.0;

// A triangle is bald where the density is below this.
constexpr double kBlack = 0.01;

// The places where roots may be: not near a parting's rows, and not where the mask is black.
struct Ground {
    const Scalp& scalp;
    const RootOptions& options;
    const PartingRows* rows;
    RootDensity density;

    bool isFree(const SurfacePoint& point) const {
        return density(point) > 0.0 &&
               !(rows && options.parting->isNear(point.position, rows->reach()));
    }
    // Below 1 for the samples that the mask keeps. If there are too many, those with the smallest
    // values are as good a choice as any.
    double chance(std::uint32_t number) const {
        return random01(options.seed, number, purpose::root_mask) /
               density(rootSample(scalp, options.seed, number));
    }
};

// Returns the numbers of at most `count` samples.
std::vector<std::uint32_t>
spreadRoots(const Ground& ground, std::uint32_t count, const std::vector<glm::vec3>& fixed) {
    // If the mask doesn't keep all, it takes four standard deviations more than are needed on
    // average.
    const double mean = ground.density.mean();
    const double needed = mean < 1.0 ? (count + 4.0 * std::sqrt(count) + 4.0) / mean : count;
    const auto total =
        static_cast<std::uint32_t>(std::min(std::ceil(needed), kMostSpreadPerRoot * count));
    const RootSamples candidates = takeSamples(
        ground.scalp, ground.options.seed, total * kCandidatesPerRoot, kTriesPerRoot * total,
        [&](std::uint32_t, const SurfacePoint& sample) { return ground.isFree(sample); });
    const auto most = std::min(total, static_cast<std::uint32_t>(candidates.numbers.size()));

    std::vector<std::pair<double, std::uint32_t>> kept;  // chance, number
    for (const std::uint32_t i :
         eliminateSamples(candidates.positions, fixed, most, ground.density.area())) {
        const double chance = ground.chance(candidates.numbers[i]);
        if (chance < 1.0) kept.emplace_back(chance, candidates.numbers[i]);
    }
    std::ranges::sort(kept);
    std::vector<std::uint32_t> numbers;
    for (const auto& [chance, number] : kept) {
        if (numbers.size() < count) numbers.push_back(number);
    }
    std::ranges::sort(numbers);
    return numbers;
}

// Returns independent samples, none of them among `taken`.
std::vector<std::uint32_t> independentRoots(
    const Ground& ground, std::uint32_t count, const std::vector<std::uint32_t>& taken) {
    const RootSamples samples = takeSamples(
        ground.scalp, ground.options.seed, count, kTriesPerRoot * count,
        [&](std::uint32_t number, const SurfacePoint& sample) {
            return ground.isFree(sample) && ground.chance(number) < 1.0 &&
                   !std::ranges::binary_search(taken, number);
        });
    if (samples.numbers.size() < count)
        throw engine::Error("the scalp has too little room for the roots");
    return samples.numbers;
}

void eraseBald(
    std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<SurfacePoint>& points,
    const Ground& ground, const NearestSurface& surface) {
    const auto isBald = [&](const glm::dvec3& at) {
        const MeshPoint point = surface(at);
        return ground.density(surfacePoint(ground.scalp, point.triangle, point.weights)) < kBlack;
    };
    std::erase_if(triangles, [&](const std::array<std::uint32_t, 3>& triangle) {
        const glm::dvec3 a(points[triangle[0]].position);
        const glm::dvec3 b(points[triangle[1]].position);
        const glm::dvec3 c(points[triangle[2]].position);
        return isBald((a + b + c) / 3.0) || isBald(0.5 * (a + b)) || isBald(0.5 * (b + c)) ||
               isBald(0.5 * (c + a));
    });
}

// Puts roots on a scalp of any shape, with the triangles of surfaceTriangles(). The number of roots
// in an area is in proportion to the mask. `random` roots are independent of each other.
// `poisson_disc` roots are spread over the part that isn't black, then each is kept with the mask's
// probability. No triangle reaches over a black part. Throws engine::Error if the scalp has no room
// for the roots or the mask can't be used.
Roots surfaceRoots(
    const Scalp& scalp, const NearestSurface& surface, const RootOptions& options,
    const PartingRows* rows) {
    const std::uint32_t probes = std::max(kLeastProbes, options.guides);
    const Ground ground{
        scalp, options, rows, RootDensity(scalp, options.mask, probes, options.seed)};
    Roots roots;
    std::vector<glm::vec3> fixed;
    if (rows) {
        for (const auto& pair : rows->pairs) {
            if (ground.density(pair[0]) < kBlack || ground.density(pair[1]) < kBlack) continue;
            for (const SurfacePoint& root : pair) roots.points.push_back(root);
            for (const SurfacePoint& root : pair) fixed.push_back(root.position);
        }
    }
    const auto count = options.guides - static_cast<std::uint32_t>(roots.points.size());
    std::vector<std::uint32_t> numbers;
    if (options.placement == RootPlacement::poisson_disc)
        numbers = spreadRoots(ground, count, fixed);
    const auto missing = count - static_cast<std::uint32_t>(numbers.size());
    std::ranges::copy(independentRoots(ground, missing, numbers), std::back_inserter(numbers));
    for (const std::uint32_t number : numbers)
        roots.points.push_back(rootSample(scalp, options.seed, number));

    if (options.dense) return roots;
    roots.triangles = surfaceTriangles(scalp, roots.points);
    if (options.mask && options.guides > 2)
        eraseBald(roots.triangles, roots.points, ground, surface);
    return roots;
}

// ---- Roots on a disc ----------------------------------------------------------------------------

glm::dvec3 middle(const std::array<SurfacePoint, 2>& pair) {
    return 0.5 * (glm::dvec3(pair[0].position) + glm::dvec3(pair[1].position));
}

// Returns the places where the hairline is cut for rows that end at it: the last two roots of such
// a row are roots of the hairline.
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

// Puts `guides` >= 3 roots on a scalp that is a disc: some evenly along the hairline, the rest
// spread over the inside. Their triangles are Delaunay on the sphere of directions. Throws
// engine::Error if the scalp is no disc or can't be flattened.
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
    for (const std::uint32_t i :
         eliminateSamples(candidates.positions, fixed, inside, scalp.area()))
        add(rootSample(scalp, options.seed, candidates.numbers[i]));
    roots.triangles = triangulate(flat, roots.boundary_count);
    return roots;
}

// ---- Roots of either kind -----------------------------------------------------------------------

// Mean distance of spread roots to the nearest neighbour, relative to the square root of the area
// for each root. The optimum, a hexagonal packing, has 1.07.
constexpr double kSpacing = 0.8;

Roots placedRoots(
    const Scalp& scalp, const NearestSurface& surface, const RootOptions& options,
    const PartingRows* rows) {
    const bool has_hairline = !options.mask && !options.dense && options.guides >= 3 &&
                              options.placement == RootPlacement::poisson_disc;
    if (!has_hairline) return surfaceRoots(scalp, surface, options, rows);
    try {
        return discRoots(scalp, options, rows);
    } catch (const engine::Error&) {  // no disc, or one that isn't flat enough
        return surfaceRoots(scalp, surface, options, rows);
    }
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
        // The last part takes the rest; each part has its two ends.
        const std::uint32_t here =
            i + 1 == cuts.size() ? left
                                 : std::clamp(static_cast<std::uint32_t>(share), 2u, left - 2);
        for (std::uint32_t k = 0; k < here; ++k)
            lengths.push_back(from + (to - from) * k / (here - 1));
    }
    return lengths;
}

Roots placeRoots(const Scalp& scalp, const NearestSurface& surface, const RootOptions& options) {
    std::optional<PartingRows> rows;
    if (options.parting && !options.dense) {
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

}  // namespace hair::groom
