#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// Tools that apply forces to hair: hands that pull it, and the wind.

namespace benchmarks::viewer {

// Pulls hair with the mouse: writes the path of an entry of /simulation/pulls while frames are
// played.
class GrabTool {
public:
    // `runs`: frames are being played.
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played,
        bool runs);
    bool drags() const { return drag_.has_value(); }

    // Options in one line: the amount of hair to hold, and a button that clears all pulls.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        GuideVertex held;
        glm::vec3 start;  // position of the vertex
        glm::vec2 from;   // px
        std::optional<std::size_t> pull;  // the entry being written; absent until the mouse moves
    };
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    void draw(
        const Pointer& pointer, Handles& handles, const hair::Settings& settings,
        const Shown& played) const;

    float radius_ = hair::PullSettings{}.radius;  // m, for the next pull
    std::optional<Drag> drag_;
};

// Turns and stretches the wind's arrow by its tip.
class WindTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // Options in one line: a slider for the wind, and a button for still air.
    static Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        glm::vec3 tip;  // where the arrow was grabbed
        glm::vec2 from;  // px
    };
    std::optional<Drag> drag_;
};

// ---- The path of a hand -------------------------------------------------------------------------

// The mouse writes a path key by key while frames are played. Keys of played frames never change,
// so replaying the path gives the same hair.

// Returns the hand's position: linear between keys, constant before the first and after the last.
// `path` has at least one key.
glm::vec3 handAt(std::span<const hair::PullKey> path, float time);

// Puts the hand at `position` from the next frame on, where it stays.
void moveHand(std::vector<hair::PullKey>& path, const Moment& moment, glm::vec3 position);

// Ends the pull now. A pull without a played frame still pulls for the next frame. Clears a path
// that would begin after now, because time was set back.
void release(std::vector<hair::PullKey>& path, const Moment& moment);

// Whether a path has room for the keys of moveHand().
bool hasRoom(std::span<const hair::PullKey> path);

// ---- The wind's arrow ---------------------------------------------------------------------------

// The arrow points from the middle of the groom in the wind's direction. Its length grows with the
// logarithm of the wind, so that a breeze and a storm both fit a picture. In still air it keeps
// some length, so that it can be grabbed.

// Returns the wind that the arrow's length shows: strength, m/s^2, or in drag mode the mean speed,
// m/s.
float windOf(const hair::WindSettings& wind);

// Returns the end of a groom's arrow.
glm::vec3 windTip(const hair::WindSettings& wind, const Sphere& groom);

// Sets the wind from the arrow's end. A tip at the middle of the groom keeps the direction.
void setWindTip(hair::WindSettings& wind, const Sphere& groom, const glm::vec3& tip);
void setWind(hair::WindSettings& wind, float value);

// The grooming tool: brushes that comb, cut, lengthen, push and clump hair.

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
