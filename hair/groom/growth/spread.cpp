#include "hair/groom/growth/spread.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "hair/groom/growth/falling_queue.h"
#include "hair/groom/growth/point_grid.h"

namespace hair {
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
    PointGrid grid(points, reach);
    const auto weigh = [reach](double distance) {
        const double near = 1.0 - distance / reach;
        const double near4 = near * near * near * near;
        return near4 * near4;
    };

    // Takes away the most crowded candidate until `count` are left.
    std::vector<double> weights(grid.size(), 0.0);  // [place]
    std::vector<FallingQueue::Entry> entries;
    for (std::uint32_t place = 0; place < grid.size(); ++place) {
        if (grid.source(place) >= candidates.size()) continue;
        grid.forEachNear(
            place, [&](std::uint32_t, double distance) { weights[place] += weigh(distance); });
        entries.push_back({weights[place], grid.rank(place), place});
    }
    std::vector<bool> present(candidates.size(), true);
    FallingQueue queue(std::move(entries));
    for (std::size_t left = candidates.size(); left > count; --left) {
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

}  // namespace hair
