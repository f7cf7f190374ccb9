#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom_settings.h"

// Strokes of brushes over hair at rest: /groom/edits.
namespace hair::groom {

// Strokes that are replayed on strands, each as if it were alone. The result for a strand depends
// on its own points, the strokes in their order, and the mesh. With d the distance of a point from
// the path, w = (1 - d^2 / radius^2)^2 within the radius and 0 beyond it, and s the strength:
//
// comb      While the brush goes from a to b, in steps of an eighth of its radius at most, vertices
//           move with it by s w(distance from a) (b - a).
// cut       A strand that comes within the radius, not counting its root, ends where it is nearest
//           to the path if s = 1; otherwise it loses the fraction s of the part beyond.
// lengthen  A strand is extended straight beyond its tip by s w of its length, with d its least
//           distance.
// push      Vertices move by s w radius away from the mesh next to the nearest place of the path;
//           without a mesh, away from `middle`.
// clump     Vertices move to the nearest place of the path by s w times their fraction of the
//           strand's length.
//
// If vertices moved, segments get back their lengths one after the other, from the root on. Roots
// and numbers of points stay, and cut and lengthen keep the segments' proportions. After each
// stroke, the strands that it changed are kept clear of the mesh. Other strands keep every bit, and
// so do all strands for a strength of 0.
class Strokes {
public:
    // The hair grows on `mesh`, which may be null; it and the strokes must outlive this. Strands
    // are kept clear of it by `clearance` (m), at least 1 mm.
    Strokes(
        std::span<const StrokeSettings> strokes, const Mesh* mesh, double clearance,
        const glm::vec3& middle);

    // Replays all strokes on a strand, [vertex], root first. Points of cut strands get the widths
    // of their new places; `widths` may be empty. Returns whether the strand changed.
    bool replay(std::span<glm::vec3> points, std::span<float> widths) const;

private:
    // A stroke, prepared for all strands.
    struct Stroke {
        const StrokeSettings* settings = nullptr;
        std::vector<glm::dvec3> path;
        std::vector<glm::dvec3> outward;  // [place], unit length; of a push along a mesh
        glm::dvec3 low{0.0};  // box of everything that it can change
        glm::dvec3 high{0.0};
    };
    bool
    apply(const Stroke& stroke, std::vector<glm::dvec3>& points, std::span<float> widths) const;

    const Mesh* mesh_;
    std::optional<NearestSurface> surface_;  // of the mesh; only if there are strokes
    double clearance_;
    glm::dvec3 middle_;
    std::vector<Stroke> strokes_;
};

// Returns the middle of all roots, which is inside the head.
glm::vec3 middleOfRoots(const Groom& groom);

// Replays the strokes on every strand of a groom, on all processors.
Groom replay(Groom groom, const Strokes& strokes);

// Does the same for strands with differing numbers of points. `ends` is as in StrandSet.
void replay(
    std::span<const std::uint32_t> ends, std::span<glm::vec3> points, const Strokes& strokes);

}  // namespace hair::groom
