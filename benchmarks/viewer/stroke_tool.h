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

// The tool that grooms: brushes that comb, cut, lengthen, push and clump hair.
namespace benchmarks::viewer {

// From a picture of hair that may have moved to the hair at rest, which brushes act on. What is
// there now at `now` was at rest where `toRest(now)` is: turned back with the head, and moved by as
// much as the guide vertex nearest to `hit` has moved since.
class RestPlace {
public:
    // Needs Shown::has_guides.
    RestPlace(const Shown& shown, const glm::vec3& hit);

    glm::vec3 toRest(const glm::vec3& now) const;

private:
    hair::simulation::RigidMotion head_;
    glm::vec3 moved_{0.0f};  // from rest, before the head's motion
};

// Writes strokes to /groom/edits: one each time the button is held.
class StrokeTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // The brushes, radius and strength, and a button that takes all strokes back, in one line.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // whose picture the mouse is in
        RestPlace rest;
        glm::vec3 place;  // of the brush, where hair is now
        glm::vec2 at;  // px, where it was there
        std::size_t stroke;  // the entry that is written
        // What the stroke makes of the guides at rest, [guide][vertex]; empty: not known.
        std::vector<glm::vec3> guides;
    };
    Edit press(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    void foresee(const hair::Settings& settings, const Shown& played);
    void draw(const Pointer& pointer, Handles& handles, const Shown& played);
    void resize();

    hair::BrushTool brush_ = hair::BrushTool::comb;
    float radius_ = hair::StrokeSettings{}.radius;  // m
    float strength_ = hair::StrokeSettings{}.strength;
    std::optional<Drag> drag_;
    std::optional<glm::vec3> under_;  // where the mouse was over hair last
};

}  // namespace benchmarks::viewer
