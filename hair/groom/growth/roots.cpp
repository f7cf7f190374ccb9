#include "hair/groom/growth/roots.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/growth/triangulate.h"
#include "hair/groom/parallel.h"
#include "hair/random.h"

namespace hair::groom {
namespace {

constexpr int kCellBits = 10;
constexpr std::uint32_t kCellMask = (1u << kCellBits) - 1;

// Moves bits to every third place from the lowest.
std::uint32_t spreadBits(std::uint32_t value) {
    std::uint32_t eliminateSamples = 0;
    for (int bit = 0; bit < kCellBits; ++bit) eliminateSamples |= (value >> bit & 1) << 3 * bit;
    return eliminateSamples;
}

// The number of a key; in its order, buckets of near cells follow each other. Morton 1966, A
// computer oriented geodetic data base.
std::uint32_t mortonCode(std::uint32_t key) {
    return spreadBits(key & kCellMask) | spreadBits(key >> kCellBits & kCellMask) << 1 |
           spreadBits(key >> 2 * kCellBits) << 2;
}

void prefetch([[maybe_unused]] const void* address) {
#ifdef __GNUC__
    __builtin_prefetch(address);
#endif
}

}  // namespace

// ---- Points in cells ----------------------------------------------------------------------------

HashGrid::HashGrid(std::span<const glm::vec3> points, double radius)
    : radius_(radius), square_limit_(static_cast<float>(radius * radius * 1.0001)),
      buckets_(std::bit_ceil(points.size() / 4 + 1)) {
    std::vector<std::uint32_t> homes;  // [source], number of its bucket
    std::vector<std::uint32_t> keys;  // [bucket], of a cell in it
    keys.resize(buckets_.size());
    for (const glm::vec3& point : points) {
        const Cell home = cell(point);
        homes.push_back(static_cast<std::uint32_t>(number(home)));
        keys[homes.back()] = key(home);
        ++buckets_[homes.back()].end;
    }
    struct Entry {
        std::uint32_t code;
        std::uint32_t bucket;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> order;
    std::vector<std::uint32_t> ranks(buckets_.size());  // [bucket], of its next point
    std::uint32_t rank = 0;
    for (std::uint32_t i = 0; i < buckets_.size(); ++i) {
        ranks[i] = rank;
        rank += buckets_[i].end;
        if (buckets_[i].end > 0) order.push_back({mortonCode(keys[i]), i});
    }
    std::ranges::sort(order);
    std::uint32_t next = 0;
    for (const Entry& entry : order) {
        Bucket& bucket = buckets_[entry.bucket];
        const std::uint32_t count = std::exchange(bucket.end, next);
        bucket.first = next;
        next += count;
    }
    points_.resize(points.size());
    positions_.resize(points.size());
    ranks_.resize(points.size());
    sources_.resize(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const std::uint32_t place = buckets_[homes[i]].end++;
        points_[place] = {points[i], place, key(cell(points[i]))};
        positions_[place] = points[i];
        ranks_[place] = ranks[homes[i]]++;
        sources_[place] = i;
    }
    where_.resize(points.size());
    std::iota(where_.begin(), where_.end(), 0u);
}

void HashGrid::erase(std::uint32_t place) {
    const std::uint32_t last = --buckets_[number(cell(positions_[place]))].end;
    const std::uint32_t at = where_[place];
    std::swap(points_[at], points_[last]);
    where_[points_[at].place] = at;
    where_[place] = last;
}

HashGrid::Cell HashGrid::cell(const glm::vec3& point) const {
    static constexpr double limit = 1e9;  // points farther out share the last cell
    const auto along = [this](float coordinate) {
        return static_cast<int>(std::clamp(std::floor(coordinate / radius_), -limit, limit));
    };
    return {along(point.x), along(point.y), along(point.z)};
}

std::size_t HashGrid::number(const Cell& cell) const {
    return hash(
               static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
               static_cast<std::uint32_t>(cell.z)) &
           (buckets_.size() - 1);
}

// A key that differs between cells that are less than 2^10 apart.
std::uint32_t HashGrid::key(const Cell& cell) {
    const auto along = [](int coordinate) {
        return static_cast<std::uint32_t>(coordinate) & kCellMask;
    };
    return along(cell.x) | along(cell.y) << kCellBits | along(cell.z) << 2 * kCellBits;
}

// Prefetches all buckets before the first is needed, and then the points, because most of the time
// goes into reading memory.
std::size_t HashGrid::findNear(const glm::vec3& point, Neighbours& neighbours) const {
    const Cell centre = cell(point);
    std::array<const Bucket*, 27> buckets;
    for (int i = 0; i < 27; ++i) {
        const Cell at{centre.x + i % 3 - 1, centre.y + i / 3 % 3 - 1, centre.z + i / 9 - 1};
        const auto index = static_cast<std::size_t>(i);
        buckets[index] = &buckets_[number(at)];
        prefetch(buckets[index]);
        neighbours[index].key = key(at);
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < 27; ++i) {
        const Bucket bucket = *buckets[i];
        neighbours[count] = {bucket, neighbours[i].key};
        if (bucket.first == bucket.end) continue;
        prefetch(&points_[bucket.first]);
        prefetch(&points_[bucket.end - 1]);
        ++count;
    }
    return count;
}

// ---- Sample elimination -------------------------------------------------------------------------

std::vector<std::uint32_t> eliminateSamples(
    std::span<const glm::vec3> candidates, std::span<const glm::vec3> fixed, std::uint32_t count,
    double area) {
    assert(count <= candidates.size());
    if (count == 0) return {};
    // Yuksel's r_max: in no set of so many points are all of them farther apart than 2 r_max. A
    // point on the boundary has half of its disc on the surface.
    const double discs = count + 0.5 * static_cast<double>(fixed.size());
    const double reach = 2.0 * std::sqrt(area / (2.0 * std::numbers::sqrt3 * discs));
    std::vector<glm::vec3> points(candidates.begin(), candidates.end());
    points.insert(points.end(), fixed.begin(), fixed.end());
    HashGrid grid(points, reach);
    const auto weigh = [reach](double distance) {
        const double near = 1.0 - distance / reach;
        const double near4 = near * near * near * near;
        return near4 * near4;
    };

    // Removes the most crowded candidate until `count` are left.
    std::vector<double> weights(grid.size(), 0.0);  // [place]
    std::vector<BucketQueue::Entry> entries;
    inParallel("weighs roots", grid.size(), [&](std::uint32_t place) {
        if (grid.source(place) >= candidates.size()) return;
        grid.forEachNear(
            place, [&](std::uint32_t, double distance) { weights[place] += weigh(distance); });
    });
    for (std::uint32_t place = 0; place < grid.size(); ++place)
        if (grid.source(place) < candidates.size())
            entries.push_back({weights[place], grid.rank(place), place});
    std::vector<bool> present(candidates.size(), true);
    BucketQueue queue(std::move(entries));
    engine::Step step("spreads roots", candidates.size() - count);
    for (std::size_t left = candidates.size(); left > count; --left) {
        step.advance();
        const std::uint32_t place = queue.pop([&](std::uint32_t item) { return weights[item]; });
        present[grid.source(place)] = false;
        grid.erase(place);
        grid.forEachNear(
            place, [&](std::uint32_t near, double distance) { weights[near] -= weigh(distance); });
    }
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < candidates.size(); ++i) {
        if (present[i]) kept.push_back(i);
    }
    return kept;
}

// ---- Random roots -------------------------------------------------------------------------------

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
