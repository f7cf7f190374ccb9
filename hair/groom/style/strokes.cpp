#include "hair/groom/style/strokes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hair/groom/style/displace.h"
#include "hair/groom/style/clearance.h"
#include "hair/groom/parallel.h"
#include "hair/groom/style/style.h"

namespace hair::groom {
namespace {

using Points = std::vector<glm::dvec3>;

constexpr double kLeastClearance = 1e-3;  // m, so that rounded points are still outside
constexpr double kLeastUncut = 1e-3;  // fraction of a strand that every cut leaves
constexpr double kStepsOfRadius = 8.0;  // steps of a comb per radius

// ---- Distances ----------------------------------------------------------------------------------

// The place of a path that is nearest to a point.
struct OnPath {
    glm::dvec3 position{0.0};
    std::size_t segment = 0;
    double share = 0.0;  // of the segment
    double distance = std::numeric_limits<double>::infinity();
};

// The fraction of the way from a to b that is nearest to a point.
double nearestShare(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& point) {
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    return square > 0.0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
}

OnPath nearestOnPath(const Points& path, const glm::dvec3& point) {
    OnPath best;
    const std::size_t segments = std::max<std::size_t>(path.size(), 2) - 1;
    for (std::size_t i = 0; i < segments; ++i) {
        const glm::dvec3& b = path[std::min(i + 1, path.size() - 1)];
        const double share = nearestShare(path[i], b, point);
        const glm::dvec3 position = glm::mix(path[i], b, share);
        const double distance = glm::distance(position, point);
        if (distance < best.distance) best = {position, i, share, distance};
    }
    return best;
}

// The place where a strand is nearest to a path, and the distance there.
struct OnStrand {
    std::size_t segment = 0;
    double share = 0.0;
    double distance = std::numeric_limits<double>::infinity();
};

// Returns the least distance of two segments, and the share of the first at which it is reached.
// Ericson 2005, Real-Time Collision Detection, 5.1.9.
double nearestOfSegments(
    const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
    double& share) {
    const glm::dvec3 u = b - a, v = d - c, between = a - c;
    const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
    const double denominator = uu * vv - uv * uv;
    share = 0.0;
    if (denominator > 1e-12 * uu * vv)
        share = std::clamp(
            (uv * glm::dot(v, between) - vv * glm::dot(u, between)) / denominator, 0.0, 1.0);
    const glm::dvec3 other = glm::mix(c, d, nearestShare(c, d, glm::mix(a, b, share)));
    share = nearestShare(a, b, other);
    return glm::distance(glm::mix(a, b, share), other);
}

OnStrand nearestOnStrand(const Points& path, const Points& strand) {
    OnStrand best;
    const std::size_t segments = std::max<std::size_t>(path.size(), 2) - 1;
    for (std::size_t i = 0; i + 1 < strand.size(); ++i)
        for (std::size_t k = 0; k < segments; ++k) {
            double share = 0.0;
            const double distance = nearestOfSegments(
                strand[i], strand[i + 1], path[k], path[std::min(k + 1, path.size() - 1)], share);
            if (distance < best.distance) best = {i, share, distance};
        }
    return best;
}

double falloff(double distance, double radius) {
    if (distance >= radius) return 0.0;
    const double inside = 1.0 - distance * distance / (radius * radius);
    return inside * inside;
}

// ---- Lengths ------------------------------------------------------------------------------------

std::vector<double> segmentLengths(const Points& points) {
    std::vector<double> lengths(points.size(), 0.0);  // of the segment that ends in the vertex
    for (std::size_t i = 1; i < points.size(); ++i)
        lengths[i] = glm::distance(points[i - 1], points[i]);
    return lengths;
}

// Gives segments their old lengths from the root on, and keeps their directions.
void restoreLengths(Points& points, const std::vector<double>& lengths) {
    glm::dvec3 direction(0.0, 1.0, 0.0);  // of the segment above, for a segment without length
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 edge = points[i] - points[i - 1];
        const double length = glm::length(edge);
        if (length > 0.0) direction = edge / length;
        points[i] = points[i - 1] + lengths[i] * direction;
    }
}

// Gives a strand this length: shorter, or extended straight beyond its tip. Vertices keep their
// places as fractions of the length.
void setLength(Points& points, std::span<float> widths, double length) {
    const Points old = points;
    const std::vector<float> old_widths(widths.begin(), widths.end());
    const std::vector<double> lengths = segmentLengths(old);
    double whole = 0.0;
    for (const double part : lengths) whole += part;
    const double ratio = length / whole;
    std::size_t segment = 0;
    double start = 0.0;  // arc length at the segment's first vertex
    double arc = 0.0;  // wanted
    for (std::size_t i = 1; i < points.size(); ++i) {
        arc += ratio * lengths[i];
        while (segment + 2 < old.size() &&
               (start + lengths[segment + 1] < arc || lengths[segment + 1] == 0.0)) {
            start += lengths[segment + 1];
            ++segment;
        }
        // The last segment may have no length; then the one before it is extended.
        std::size_t along = segment;
        double from = start;
        while (along > 0 && lengths[along + 1] == 0.0) {
            --along;
            from -= lengths[along + 1];
        }
        const double share = (arc - from) / lengths[along + 1];
        points[i] = old[along] + share * (old[along + 1] - old[along]);
        if (!widths.empty() && ratio < 1.0)
            widths[i] = static_cast<float>(std::lerp(
                double{old_widths[along]}, double{old_widths[along + 1]}, std::min(share, 1.0)));
    }
    // Segments between the vertices cut corners of the strand.
    std::vector<double> wanted = lengths;
    for (double& part : wanted) part *= ratio;
    restoreLengths(points, wanted);
}

// ---- Tools --------------------------------------------------------------------------------------

// Each tool returns whether the strand changed.

bool comb(const Points& path, double radius, double strength, Points& points) {
    const std::vector<double> lengths = segmentLengths(points);
    bool changed = false;
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        const glm::dvec3 way = path[k + 1] - path[k];
        const double steps = std::max(std::ceil(kStepsOfRadius * glm::length(way) / radius), 1.0);
        const glm::dvec3 step = way / steps;
        for (double i = 0.0; i < steps; ++i) {
            const glm::dvec3 brush = path[k] + i * step;
            bool moved = false;
            for (std::size_t v = 1; v < points.size(); ++v) {
                const double weight = falloff(glm::distance(points[v], brush), radius);
                if (weight == 0.0) continue;
                points[v] += strength * weight * step;
                moved = true;
            }
            if (moved) restoreLengths(points, lengths);
            changed |= moved;
        }
    }
    return changed;
}

bool cutStrand(
    const Points& path, double radius, double strength, Points& points, std::span<float> widths) {
    const OnStrand nearest = nearestOnStrand(path, points);
    if (nearest.distance >= radius || (nearest.segment == 0 && nearest.share == 0.0)) return false;
    const std::vector<double> lengths = segmentLengths(points);
    double whole = 0.0;
    double before = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        whole += lengths[i];
        if (i <= nearest.segment) before += lengths[i];
    }
    before += nearest.share * lengths[nearest.segment + 1];
    const double left = std::max(whole - strength * (whole - before), kLeastUncut * whole);
    if (left >= whole) return false;
    setLength(points, widths, left);
    return true;
}

bool lengthen(const Points& path, double radius, double strength, Points& points) {
    const double weight = falloff(nearestOnStrand(path, points).distance, radius);
    double whole = 0.0;
    for (const double part : segmentLengths(points)) whole += part;
    if (weight == 0.0 || whole == 0.0) return false;
    setLength(points, {}, (1.0 + strength * weight) * whole);
    return true;
}

template <class Move>
bool moveVertices(const Points& path, double radius, Points& points, Move&& move) {
    const std::vector<double> lengths = segmentLengths(points);
    bool moved = false;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const OnPath nearest = nearestOnPath(path, points[i]);
        const double weight = falloff(nearest.distance, radius);
        if (weight == 0.0) continue;
        points[i] += weight * move(i, nearest);
        moved = true;
    }
    if (moved) restoreLengths(points, lengths);
    return moved;
}

}  // namespace

// ---- Strokes ------------------------------------------------------------------------------------

Strokes::Strokes(
    std::span<const StrokeSettings> strokes, const Mesh* mesh, double clearance,
    const glm::vec3& middle)
    : mesh_(mesh), clearance_(std::max(clearance, kLeastClearance)), middle_(middle) {
    for (const StrokeSettings& settings : strokes) {
        if (settings.strength == 0.0f || settings.path.empty()) continue;
        if (mesh && !mesh->triangles.empty() && !surface_)
            surface_.emplace(mesh->positions, mesh->triangles);
        Stroke stroke{.settings = &settings};
        for (const StrokePoint& point : settings.path) stroke.path.emplace_back(point.position);
        stroke.low = stroke.high = stroke.path.front();
        for (const glm::dvec3& point : stroke.path) {
            stroke.low = glm::min(stroke.low, point - double{settings.radius});
            stroke.high = glm::max(stroke.high, point + double{settings.radius});
            if (settings.tool == BrushTool::push && surface_)
                stroke.outward.push_back(outwardOf(*mesh, *surface_, point));
        }
        strokes_.push_back(std::move(stroke));
    }
}

bool Strokes::apply(
    const Stroke& stroke, std::vector<glm::dvec3>& points, std::span<float> widths) const {
    const double radius = stroke.settings->radius;
    const double strength = stroke.settings->strength;
    glm::dvec3 low(points.front()), high(points.front());
    for (const glm::dvec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    for (int axis = 0; axis < 3; ++axis)
        if (low[axis] > stroke.high[axis] || high[axis] < stroke.low[axis]) return false;
    switch (stroke.settings->tool) {
    case BrushTool::comb:
        return comb(stroke.path, radius, strength, points);
    case BrushTool::cut:
        return cutStrand(stroke.path, radius, strength, points, widths);
    case BrushTool::lengthen:
        return lengthen(stroke.path, radius, strength, points);
    case BrushTool::push:
        return moveVertices(stroke.path, radius, points, [&](std::size_t i, const OnPath& nearest) {
            glm::dvec3 outward = points[i] - middle_;
            if (!stroke.outward.empty()) {
                const std::size_t next = std::min(nearest.segment + 1, stroke.outward.size() - 1);
                outward =
                    glm::mix(stroke.outward[nearest.segment], stroke.outward[next], nearest.share);
            }
            const double length = glm::length(outward);
            return length > 0.0 ? strength * radius / length * outward : glm::dvec3(0.0);
        });
    case BrushTool::clump: {
        std::vector<double> parts = segmentLengths(points);
        for (std::size_t i = 1; i < parts.size(); ++i) parts[i] += parts[i - 1];
        if (parts.back() == 0.0) return false;
        return moveVertices(stroke.path, radius, points, [&](std::size_t i, const OnPath& nearest) {
            return strength * parts[i] / parts.back() * (nearest.position - points[i]);
        });
    }
    }
    return false;
}

bool Strokes::replay(std::span<glm::vec3> points, std::span<float> widths) const {
    if (points.size() < 2) return false;
    bool changed = false;
    for (const Stroke& stroke : strokes_) {
        // The next stroke starts from floats, as from a groom that ends with this stroke.
        Points moved(points.begin(), points.end());
        if (!apply(stroke, moved, widths)) continue;
        if (surface_) keepClear(moved, *mesh_, *surface_, clearance_);
        std::ranges::copy(moved, points.begin());
        changed = true;
    }
    return changed;
}

glm::vec3 middleOfRoots(const Groom& groom) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) sum += groom.strand(i).front();
    return groom.strand_count == 0 ? glm::vec3(0.0f) : glm::vec3(sum / double(groom.strand_count));
}

Groom replay(Groom groom, const Strokes& strokes) {
    const std::size_t vertices = groom.vertices_per_strand;
    inParallel("brushes strands", groom.strand_count, [&](std::uint32_t strand) {
        const auto part = [&](auto& values) {
            return values.empty() ? std::span(values)
                                  : std::span(values).subspan(strand * vertices, vertices);
        };
        strokes.replay(part(groom.points), part(groom.widths));
    });
    return groom;
}

void replay(
    std::span<const std::uint32_t> ends, std::span<glm::vec3> points, const Strokes& strokes) {
    inParallel(
        "brushes strands as drawn", static_cast<std::uint32_t>(ends.size()),
        [&](std::uint32_t strand) {
            const std::uint32_t first = strand == 0 ? 0 : ends[strand - 1];
            strokes.replay(points.subspan(first, ends[strand] - first), {});
        });
}

}  // namespace hair::groom
