#include "hair/rendering/lod_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>

namespace hair {

namespace {

// Over strands, m.
double meanWidth(const Groom& groom, const StrandSettings& settings) {
    if (settings.width == WidthSource::groom) {
        const double sum = std::accumulate(groom.widths.begin(), groom.widths.end(), 0.0);
        return sum / static_cast<double>(groom.widths.size());
    }
    const double tapered = 0.5 * (double{settings.root_width} + double{settings.tip_width});
    return std::lerp(tapered, double{settings.root_width}, double{settings.taper_start});
}

// Root of the mean square distance of guide points from their mean, m: the radius of a sphere with
// the points on it.
double radius(const Groom& groom) {
    glm::dvec3 sum(0.0);
    double squares = 0.0;
    for (const glm::vec3& point : groom.points) {
        sum += glm::dvec3(point);
        squares += glm::dot(glm::dvec3(point), glm::dvec3(point));
    }
    const auto count = static_cast<double>(groom.points.size());
    const glm::dvec3 mean = sum / count;
    return std::sqrt(std::max(squares / count - glm::dot(mean, mean), 0.0));
}

}  // namespace

float greatestWidthScale(const Groom& groom, const StrandSettings& settings) {
    const double width = groom.points.empty() ? 0.0 : meanWidth(groom, settings);
    if (width == 0.0) return std::numeric_limits<float>::infinity();
    return static_cast<float>(1.0 + double{kOutlineGrowth} * radius(groom) / width);
}

}  // namespace hair
