#include "hair/groom/growth/sample_elimination.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/process.h"
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

}  // namespace hair::groom
