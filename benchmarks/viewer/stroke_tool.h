#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// The grooming tool: brushes that comb, cut, lengthen, push and clump hair.
namespace benchmarks::viewer {

// Maps points from hair in its current state to hair at rest, on which brushes act. A point `now`
// maps to `toRest(now)`: it is turned back with the head, and moved back by the movement of the
// guide vertex nearest to `hit`.
class RestPlace {
public:
    // Needs Shown::has_guides.
    RestPlace(const Shown& shown, const glm::vec3& hit);

    glm::vec3 toRest(const glm::vec3& now) const;

private:
    hair::simulation::RigidMotion head_;
    glm::vec3 moved_{0.0f};  // from rest, without the head's motion
};

// Writes strokes to /groom/edits, one per press of the button.
class StrokeTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // Options in one line: brushes, radius and strength, and a button that removes all strokes.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        RestPlace rest;
        glm::vec3 place;  // of the brush, on the current hair
        glm::vec2 at;  // px, position of the mouse for that place
        std::size_t stroke;  // the entry being written
        // The guides at rest after the stroke, [guide][vertex]; empty: unknown.
        std::vector<glm::vec3> guides;
    };
    Edit press(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    void predict(const hair::Settings& settings, const Shown& played);
    void draw(const Pointer& pointer, Handles& handles, const Shown& played);
    void resize();

    hair::BrushTool brush_ = hair::BrushTool::comb;
    float radius_ = hair::StrokeSettings{}.radius;  // m
    float strength_ = hair::StrokeSettings{}.strength;
    std::optional<Drag> drag_;
    std::optional<glm::vec3> under_;  // last point of hair under the mouse
};

}  // namespace benchmarks::viewer
