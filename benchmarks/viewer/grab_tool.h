#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// The tools that put forces on hair: hands that pull at it, and the wind.
namespace benchmarks::viewer {

// Pulls at hair with the mouse: an entry of /simulation/pulls, whose path is written while frames
// are played.
class GrabTool {
public:
    // `runs`: whether frames are being played.
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played,
        bool runs);
    bool drags() const { return drag_.has_value(); }

    // How much hair is held, and a button that clears all pulls, in one line.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // whose picture the mouse is in
        GuideVertex held;
        glm::vec3 start;  // where the vertex was
        glm::vec2 from;   // px
        std::optional<std::size_t> pull;  // the entry that is written; none before the mouse moves
    };
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Shown& played);
    void draw(
        const Pointer& pointer, Handles& handles, const hair::Settings& settings,
        const Shown& played) const;

    float radius_ = hair::PullSettings{}.radius;  // m, of the next pull
    std::optional<Drag> drag_;
};

// Turns and stretches the wind's arrow: the tip is dragged.
class WindTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value(); }

    // A slider for the wind and a button for still air, in one line.
    static Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Shown* played;  // whose picture the mouse is in
        glm::vec3 tip;  // where the arrow was held
        glm::vec2 from;  // px
    };
    std::optional<Drag> drag_;
};

// ---- The path of a hand -------------------------------------------------------------------------

// The mouse writes a path key by key while frames are played. What was played keeps its keys:
// playing the path anew gives the same hair.

// Where the hand is: straight between keys, and at the first or last key before and after them.
// `path` has at least one key.
glm::vec3 handAt(std::span<const hair::PullKey> path, float time);

// The hand is at `position` from the next frame on, and stays there.
void moveHand(std::vector<hair::PullKey>& path, const Moment& moment, glm::vec3 position);

// Ends the pull now; a pull of which no frame was played pulls for the next frame. The path becomes
// empty where it would have begun after now, because time was set back.
void letGo(std::vector<hair::PullKey>& path, const Moment& moment);

// Whether a path has room for the keys of moveHand().
bool hasRoom(std::span<const hair::PullKey> path);

// ---- The wind's arrow ---------------------------------------------------------------------------

// The arrow points from the middle of the groom to where the wind blows. Its length grows with the
// logarithm of the wind, so that a breeze and a storm both fit a picture; in still air it has a
// length too, so that it can be held.

// The wind that the arrow's length shows: strength, m/s^2, or in drag mode the mean speed, m/s.
float windOf(const hair::WindSettings& wind);

// Where the arrow of a groom ends.
glm::vec3 windTip(const hair::WindSettings& wind, const Sphere& groom);

// Sets the wind whose arrow ends at `tip`; a tip at the middle of the groom leaves the direction.
void setWindTip(hair::WindSettings& wind, const Sphere& groom, const glm::vec3& tip);
void setWind(hair::WindSettings& wind, float value);

}  // namespace benchmarks::viewer
