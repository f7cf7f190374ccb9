#include "hair/groom/style/style.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hair/groom/style/along_strand.h"

namespace hair {
namespace {

constexpr double kLeast = 1e-3;  // part of a strand that is always left

// Arc length at which the strand first passes the plane; infinite if it never does.
double
arcAtPlane(std::span<const glm::vec3> points, const AlongStrand& along, const CutSettings& plane) {
    const auto beyond = [&](std::size_t i) {
        return glm::dot(glm::dvec3(points[i]) - glm::dvec3(plane.point), glm::dvec3(plane.normal));
    };
    if (beyond(0) > 0.0) return 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double before = beyond(i - 1);
        const double after = beyond(i);
        if (after > 0.0)
            return std::lerp(along.arc(i - 1), along.arc(i), before / (before - after));
    }
    return std::numeric_limits<double>::infinity();
}

double arcLeft(std::span<const glm::vec3> points, const AlongStrand& along, const CutSettings& s) {
    double left = s.length > 0.0f ? s.length : std::numeric_limits<double>::infinity();
    if (s.normal != glm::vec3(0.0f)) left = std::min(left, arcAtPlane(points, along, s));
    return std::max(left, kLeast * along.length());
}

// The points of the groom that a strand's new points lie between, the greater one's share.
struct Between {
    std::size_t point;
    double share;
};

// Even spacing over the first `length` of a strand, which is less than all of it and not 0.
std::vector<Between> evenly(const AlongStrand& along, std::uint32_t vertices, double length) {
    std::vector<Between> places(vertices);
    std::size_t segment = 0;
    for (std::uint32_t i = 1; i < vertices; ++i) {
        const double arc = length * i / (vertices - 1);
        while (along.arc(segment + 1) < arc) ++segment;
        const double start = along.arc(segment);
        places[i] = {segment, (arc - start) / (along.arc(segment + 1) - start)};
    }
    return places;
}

template <class Value, class Wide>
void moveTo(std::span<Value> values, const std::vector<Between>& places, Wide&& widen) {
    const std::vector<Value> old(values.begin(), values.end());
    for (std::size_t i = 1; i < values.size(); ++i) {
        const auto [point, share] = places[i];
        values[i] = static_cast<Value>(glm::mix(widen(old[point]), widen(old[point + 1]), share));
    }
}

}  // namespace

Groom cut(Groom groom, const CutSettings& settings) {
    if (settings.length == 0.0f && settings.normal == glm::vec3(0.0f)) return groom;
    const std::uint32_t vertices = groom.vertices_per_strand;
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const AlongStrand along(groom.strand(strand));
        const double left = arcLeft(groom.strand(strand), along, settings);
        if (left >= along.length()) continue;
        const std::vector<Between> places = evenly(along, vertices, left);
        const std::size_t first = std::size_t{strand} * vertices;
        moveTo(std::span(groom.points).subspan(first, vertices), places, [](const glm::vec3& v) {
            return glm::dvec3(v);
        });
        if (!groom.widths.empty())
            moveTo(std::span(groom.widths).subspan(first, vertices), places, [](float w) {
                return double{w};
            });
    }
    return groom;
}

}  // namespace hair
