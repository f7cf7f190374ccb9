#include "hair/groom/guides/drop_triangles.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

namespace hair {
namespace {

constexpr double kLongest = 3.0;   // spacings
constexpr double kLowest = 0.01;  // height / longest edge

using Triangle = std::array<std::uint32_t, 3>;

double lowerMedian(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// The roots at the other ends of each root's edges.
class Neighbours {
public:
    Neighbours(std::span<const Triangle> triangles, std::size_t roots) : starts_(roots + 1, 0) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // from, to
        edges.reserve(6 * triangles.size());
        for (const auto& [a, b, c] : triangles)
            edges.insert(edges.end(), {{a, b}, {b, a}, {b, c}, {c, b}, {c, a}, {a, c}});
        std::ranges::sort(edges);
        edges.erase(std::ranges::unique(edges).begin(), edges.end());
        for (const auto& [from, to] : edges) {
            ++starts_[from + 1];
            ends_.push_back(to);
        }
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    }

    std::span<const std::uint32_t> of(std::uint32_t root) const {
        return std::span(ends_).subspan(starts_[root], starts_[root + 1] - starts_[root]);
    }

private:
    std::vector<std::size_t> starts_;  // [root], and one more at the end
    std::vector<std::uint32_t> ends_;
};

// [root]; 0 for those without an edge.
std::vector<double>
spacings(std::span<const Triangle> triangles, std::span<const glm::vec3> roots) {
    const Neighbours neighbours(triangles, roots.size());
    std::vector<double> own(roots.size(), 0.0);
    std::vector<double> values;
    for (std::uint32_t root = 0; root < roots.size(); ++root) {
        values.clear();
        for (const std::uint32_t other : neighbours.of(root))
            values.push_back(glm::distance(glm::dvec3(roots[root]), glm::dvec3(roots[other])));
        if (!values.empty()) own[root] = lowerMedian(values);
    }
    std::vector<double> round(roots.size(), 0.0);
    for (std::uint32_t root = 0; root < roots.size(); ++root) {
        values.assign(1, own[root]);
        for (const std::uint32_t other : neighbours.of(root)) values.push_back(own[other]);
        round[root] = lowerMedian(values);
    }
    return round;
}

}  // namespace

std::vector<Triangle>
withoutLongTriangles(std::vector<Triangle> triangles, std::span<const glm::vec3> roots) {
    const std::vector<double> spacing = spacings(triangles, roots);
    const auto isLong = [&](const Triangle& triangle) {
        const glm::dvec3 a(roots[triangle[0]]);
        const glm::dvec3 b(roots[triangle[1]]);
        const glm::dvec3 c(roots[triangle[2]]);
        const double longest =
            std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        const double twice_area = glm::length(glm::cross(b - a, c - a));
        // The widest of the three: where roots get denser, the edges are as long as those of the
        // sparser side.
        const double limit =
            std::max({spacing[triangle[0]], spacing[triangle[1]], spacing[triangle[2]]});
        return longest > kLongest * limit || twice_area < kLowest * longest * longest;
    };
    std::vector<Triangle> kept;
    std::ranges::remove_copy_if(triangles, std::back_inserter(kept), isLong);
    return kept.empty() ? triangles : kept;
}

}  // namespace hair
