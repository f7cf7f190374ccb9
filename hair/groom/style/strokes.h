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

// Strokes that are replayed on strands, each as if it were alone: what becomes of a strand depends
// on its own points, the strokes in their order, and what it is kept out of. With d the distance
// of a point from the path, w = (1 - d^2 / radius^2)^2 within the radius and 0 beyond it, and s the
// strength:
//
// comb      While the brush goes from a to b, in steps of an eighth of its radius at most, vertices
//           go along by s w(distance from a) (b - a).
// cut       A strand that comes within the radius, but for its root, ends where it is nearest to
//           the path, with s = 1; otherwise it loses the part s of what is beyond.
// lengthen  A strand goes on straight beyond its tip by s w of its length, d being its least.
// push      Vertices go by s w radius away from the mesh next to the nearest place of the path;
//           where there is no mesh, away from `middle`.
// clump     Vertices go by s w times their part of the strand's length to the nearest place of the
//           path.
//
// Where vertices went, segments get back their lengths one after the other from the root on. Roots
// and numbers of points stay, and cut and lengthen keep the segments' proportions. After each
// stroke strands that it changed are kept clear of the mesh. Other strands, and all for a strength
// of 0, keep every bit.
class Strokes {
public:
    // `mesh` is what the hair grows on, or null; it and the strokes outlive this. Strands are kept
    // clear of it by `clearance` (m), and 1 mm at least.
    Strokes(
        std::span<const StrokeSettings> strokes, const Mesh* mesh, double clearance,
        const glm::vec3& middle);

    // Replays all strokes on a strand, [vertex], root first. Cut strands have the widths that they
    // had there; `widths` may be empty. Returns whether the strand changed.
    bool replay(std::span<glm::vec3> points, std::span<float> widths) const;

private:
    // A stroke, prepared for all strands.
    struct Stroke {
        const StrokeSettings* settings = nullptr;
        std::vector<glm::dvec3> path;
        std::vector<glm::dvec3> outward;  // [place], unit length; of a push along a mesh
        glm::dvec3 low{0.0};  // box that contains all that it can change
        glm::dvec3 high{0.0};
    };
    bool
    apply(const Stroke& stroke, std::vector<glm::dvec3>& points, std::span<float> widths) const;

    const Mesh* mesh_;
    std::optional<NearestSurface> surface_;  // of the mesh, where there are strokes
    double clearance_;
    glm::dvec3 middle_;
    std::vector<Stroke> strokes_;
};

// The middle of all roots: inside of a head.
glm::vec3 middleOfRoots(const Groom& groom);

// Replays the strokes on every strand of a groom, on all processors.
Groom replay(Groom groom, const Strokes& strokes);

// The same for strands with numbers of points of their own; `ends` as in StrandSet.
void replay(
    std::span<const std::uint32_t> ends, std::span<glm::vec3> points, const Strokes& strokes);

}  // namespace hair::groom
