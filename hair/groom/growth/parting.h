#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/growth/scalp.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom_settings.h"

// The hairline of a scalp, and the parting of the hair on it.
namespace hair::groom {

// The edge of a scalp that is a disc: one piece of surface with one boundary.
struct Hairline {
    std::vector<std::uint32_t> vertices;   // of the scalp, which is on their left
    std::vector<std::uint32_t> triangles;  // [edge], of the scalp; from a vertex to the next
    std::vector<double> arc;  // [edge], m, up to its start; the whole length at the end

    double length() const { return arc.back(); }
};

// Throws engine::Error if the scalp is no disc.
Hairline traceHairline(const Scalp& scalp);

// Returns the point of the hairline after this length. Lengths beyond its end continue from its
// start.
SurfacePoint hairlinePoint(const Scalp& scalp, const Hairline& hairline, double length);

// Returns the length at which the hairline is nearest to a point.
double nearestLength(const Scalp& scalp, const Hairline& hairline, const glm::dvec3& point);

// The line on a scalp from which hair is combed away: the straight line between the ends,
// projected to the scalp in the plane at right angles to it, up to the scalp's boundary.
class PartingLine {
public:
    // Throws engine::Error if no line is left on the scalp.
    PartingLine(const Scalp& scalp, const NearestSurface& surface, const PartingSettings& settings);

    // The place of a point relative to the nearest point of the line.
    struct Place {
        double along = 0.0;     // m, of that point from the line's start
        double distance = 0.0;  // m
        double across = 0.0;    // m, positive on the line's left seen from outside
        double beyond = 0.0;    // m, past the line's end along its direction; 0 beside the line
        glm::dvec3 away{0.0};   // m, the way to the point without its part beyond
    };
    Place place(const glm::dvec3& point) const;

    // Whether a point is nearer than this to the line.
    bool isNear(const glm::dvec3& point, double distance) const;

    double length() const { return arc_.back(); }
    glm::dvec3 position(double along) const;
    glm::dvec3 left(double along) const;  // unit length, in the surface, at right angles

    // Whether the line ends at the scalp's boundary: at its start, at its end.
    std::array<bool, 2> endsAtBoundary() const { return ends_at_boundary_; }

private:
    std::vector<glm::dvec3> points_;  // m
    std::vector<glm::dvec3> left_;    // [point], unit length
    std::vector<double> arc_;         // [point], m, length up to it
    glm::dvec3 low_{0.0};       // of the box round the points
    glm::dvec3 high_{0.0};
    std::array<bool, 2> ends_at_boundary_{};
};

// Pairs of roots along the line, one on its left and one on its right, from end to end.
struct PartingRows {
    std::vector<std::array<SurfacePoint, 2>> pairs;
    double spacing = 0.0;  // m, along the line, at most the requested one
    double gap = 0.0;      // m, from a root to the line

    // m, the distance of other roots from the line. With it, the circle through neighbours of a row
    // is empty, so that they have an edge.
    double reach() const { return gap + 0.5 * spacing; }
};

PartingRows partingRows(
    const PartingLine& line, const Scalp& scalp, const NearestSurface& surface, double spacing);

// Removes the triangles with an edge that crosses the line, or passes its ends within `margin`.
void eraseCrossing(
    std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<glm::dvec3>& positions,
    const PartingLine& line, double margin);

}  // namespace hair::groom
