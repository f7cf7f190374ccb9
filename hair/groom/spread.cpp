#include "hair/groom/spread.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>

#include <glm/geometric.hpp>

#include "hair/random.h"

namespace hair {
namespace {

// Points sorted into cubes as wide as the radius, the cubes into buckets. A point is known by its
// slot, its place in that order: what is near is near in memory.
class PointGrid {
public:
    PointGrid(std::span<const glm::vec3> points, double radius)
        : radius_(radius), starts_(std::bit_ceil(points.size() / 4 + 1) + 1, 0) {
        for (const glm::vec3& point : points) ++starts_[bucket(cube(point)) + 1];
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        points_.resize(points.size());
        sources_.resize(points.size());
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const std::uint32_t slot = next[bucket(cube(points[i]))]++;
            points_[slot] = points[i];
            sources_[slot] = i;
        }
    }

    std::uint32_t source(std::uint32_t slot) const { return sources_[slot]; }

    // Calls visit(slot, distance) for every other point that is closer than the radius.
    template <class Visit>
    void forEachNear(std::uint32_t slot, Visit&& visit) const {
        const glm::vec3 point = points_[slot];
        const Cube centre = cube(point);
        for (int neighbour = 0; neighbour < 27; ++neighbour) {
            const Cube at{
                centre.x + neighbour % 3 - 1, centre.y + neighbour / 3 % 3 - 1,
                centre.z + neighbour / 9 - 1};
            const std::size_t home = bucket(at);
            for (std::uint32_t i = starts_[home]; i < starts_[home + 1]; ++i) {
                const double distance = glm::distance(points_[i], point);
                // Cubes can share a bucket: each finds only its own points.
                if (distance < radius_ && i != slot && cube(points_[i]) == at) visit(i, distance);
            }
        }
    }

private:
    struct Cube {
        int x, y, z;
        friend bool operator==(const Cube&, const Cube&) = default;
    };

    Cube cube(const glm::vec3& point) const {
        static constexpr double limit = 1e9;  // what lies further out shares the last cube
        const auto along = [this](float coordinate) {
            return static_cast<int>(std::clamp(std::floor(coordinate / radius_), -limit, limit));
        };
        return {along(point.x), along(point.y), along(point.z)};
    }

    std::size_t bucket(const Cube& cube) const {
        return hash(
                   static_cast<std::uint32_t>(cube.x), static_cast<std::uint32_t>(cube.y),
                   static_cast<std::uint32_t>(cube.z)) &
               (starts_.size() - 2);
    }

    double radius_;
    std::vector<std::uint32_t> starts_;   // [bucket], first slot; one more at the end
    std::vector<glm::vec3> points_;       // [slot]
    std::vector<std::uint32_t> sources_;  // [slot], index of the point as given
};

struct Crowded {
    double weight;
    std::uint32_t slot;
    auto operator<=>(const Crowded&) const = default;
};

}  // namespace

std::vector<std::uint32_t> spread(
    std::span<const glm::vec3> candidates, std::span<const glm::vec3> fixed, std::uint32_t count,
    double area) {
    assert(count <= candidates.size());
    if (count == 0) return {};
    // Yuksel's r_max: no set of so many points has all of them further apart than 2 r_max. A point
    // on the boundary has half of its disc on the surface.
    const double discs = count + 0.5 * static_cast<double>(fixed.size());
    const double reach = 2.0 * std::sqrt(area / (2.0 * std::numbers::sqrt3 * discs));
    std::vector<glm::vec3> points(candidates.begin(), candidates.end());
    points.insert(points.end(), fixed.begin(), fixed.end());
    const PointGrid grid(points, reach);
    const auto weigh = [reach](double distance) {
        const double near = 1.0 - distance / reach;
        const double near4 = near * near * near * near;
        return near4 * near4;
    };

    // Takes away the most crowded candidate until `count` are left. Weights only fall, so an entry
    // whose weight is out of date can wait until it comes up.
    const auto slots = static_cast<std::uint32_t>(points.size());
    std::vector<double> weights(slots, 0.0);
    std::vector<bool> present(slots, false);
    std::vector<Crowded> entries;
    for (std::uint32_t slot = 0; slot < slots; ++slot) {
        present[slot] = grid.source(slot) < candidates.size();
        if (!present[slot]) continue;
        grid.forEachNear(
            slot, [&](std::uint32_t, double distance) { weights[slot] += weigh(distance); });
        entries.push_back({weights[slot], slot});
    }
    std::priority_queue queue(std::less<Crowded>{}, std::move(entries));
    for (std::size_t left = candidates.size(); left > count;) {
        const auto [weight, slot] = queue.top();
        queue.pop();
        if (weight != weights[slot]) {
            queue.push({weights[slot], slot});
            continue;
        }
        present[slot] = false;
        --left;
        grid.forEachNear(slot, [&](std::uint32_t near, double distance) {
            if (present[near]) weights[near] -= weigh(distance);
        });
    }
    std::vector<std::uint32_t> kept;
    for (std::uint32_t slot = 0; slot < slots; ++slot) {
        if (present[slot]) kept.push_back(grid.source(slot));
    }
    std::ranges::sort(kept);
    return kept;
}

}  // namespace hair
