#include "hair/groom/growth/surface_roots.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/error.h"
#include "hair/groom/growth/root_density.h"
#include "hair/groom/growth/root_samples.h"
#include "hair/groom/growth/spread.h"
#include "hair/groom/growth/surface_triangles.h"

namespace hair {
namespace {

constexpr std::uint32_t kCandidatesPerRoot = 10;
constexpr std::uint32_t kLeastProbes = 4096;
constexpr std::uint64_t kTriesPerRoot = 1000;

// For a mask so uneven that more would have to be spread for each that is kept, the rest of the
// roots is independent.
constexpr double kMostSpreadPerRoot = 4.0;

// A triangle is bald where the density is below this.
constexpr double kBlack = 0.01;

// Where roots may be: not in the way of a parting's rows, and not where the mask is black.
struct Ground {
    const Scalp& scalp;
    const RootOptions& options;
    const PartingRows* rows;
    RootDensity density;

    bool isFree(const SurfacePoint& point) const {
        return density(point) > 0.0 &&
               !(rows && options.parting->isNear(point.position, rows->reach()));
    }
    // Below 1 for the samples that the mask keeps. Of these, those that are smallest are as good a
    // choice as any.
    double chance(std::uint32_t number) const {
        return random01(options.seed, number, purpose::root_mask) /
               density(rootSample(scalp, options.seed, number));
    }
};

// Numbers of at most `count` samples.
std::vector<std::uint32_t>
spreadRoots(const Ground& ground, std::uint32_t count, const std::vector<glm::vec3>& fixed) {
    // Where some aren't kept, four standard deviations more than are on average.
    const double mean = ground.density.mean();
    const double needed = mean < 1.0 ? (count + 4.0 * std::sqrt(count) + 4.0) / mean : count;
    const auto total =
        static_cast<std::uint32_t>(std::min(std::ceil(needed), kMostSpreadPerRoot * count));
    const RootSamples candidates = takeSamples(
        ground.scalp, ground.options.seed, total * kCandidatesPerRoot, kTriesPerRoot * total,
        [&](std::uint32_t, const SurfacePoint& sample) { return ground.isFree(sample); });
    const auto most = std::min(total, static_cast<std::uint32_t>(candidates.numbers.size()));

    std::vector<std::pair<double, std::uint32_t>> kept;  // chance, number
    for (const std::uint32_t i : spread(candidates.positions, fixed, most, ground.density.area())) {
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

// Independent samples, none of them among `taken`.
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

}  // namespace

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

    roots.triangles = surfaceTriangles(scalp, roots.points);
    if (options.mask && options.guides > 2)
        eraseBald(roots.triangles, roots.points, ground, surface);
    return roots;
}

}  // namespace hair
