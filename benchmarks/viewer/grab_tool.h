#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"
#include "hair/simulation_settings.h"

namespace benchmarks::viewer {

// Pulls at hair with the mouse: an entry of /simulation/pulls, whose path is written while frames
// are played.
class GrabTool {
public:
    // `runs`: whether frames are being played.
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Player& player,
        bool runs);
    bool drags() const { return drag_.has_value(); }

    // How much hair is held, and a button that clears all pulls, in one line.
    Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Player* player;  // whose picture
        GuideVertex held;
        glm::vec3 start;  // where the vertex was
        glm::vec2 from;   // px
        std::optional<std::size_t> pull;  // that it writes; none before the mouse moves
    };
    Edit drag(const Pointer& pointer, hair::Settings& settings, const Player& player);
    void draw(
        const Pointer& pointer, Handles& handles, const hair::Settings& settings,
        const Player& player) const;

    float radius_ = hair::PullSettings{}.radius;  // m, of the next pull
    std::optional<Drag> drag_;
};

// The path of a hand that the mouse drags, key by key while frames are played. What was played
// keeps its keys: playing the path anew gives the same hair.

// Straight between keys; before the first and after the last where these are. There is a key.
glm::vec3 handAt(std::span<const hair::PullKey> path, float time);

// The hand is at `position` from the next frame on, and stays there.
void moveHand(std::vector<hair::PullKey>& path, const Moment& moment, glm::vec3 position);

// The pull ends now; one that no frame was played of pulls for the next frame. Empty where it would
// have begun after now, because time was set back.
void letGo(std::vector<hair::PullKey>& path, const Moment& moment);

// Whether moveHand has room for its keys.
bool hasRoom(std::span<const hair::PullKey> path);

// The arrow that shows the wind: from the middle of the groom to where the wind blows. Its length
// grows with the logarithm of the wind, so that a breeze and a storm both fit a picture; it has one
// in still air too, so that it can be held.

// What the arrow's length is: strength, m/s^2, or in drag mode the mean speed, m/s.
float windOf(const hair::WindSettings& wind);
const char* windUnit(const hair::WindSettings& wind);

glm::vec3 windDirection(const hair::WindSettings& wind);  // unit length

// Where the arrow of a groom ends.
glm::vec3 windTip(const hair::WindSettings& wind, const Sphere& groom);

// Makes the wind one whose arrow ends there; a tip at the middle leaves its direction.
void setWindTip(hair::WindSettings& wind, const Sphere& groom, const glm::vec3& tip);
void setWind(hair::WindSettings& wind, float value);

// The wind's arrow in the picture: dragging its tip turns and stretches it.
class WindTool {
public:
    Edit update(
        const Pointer& pointer, Handles& handles, hair::Settings& settings, const Player& player);
    bool drags() const { return drag_.has_value(); }

    // The wind as a number, in one line.
    static Edit options(OptionsLine& line, hair::Settings& settings);

private:
    struct Drag {
        const Player* player;  // whose picture
        glm::vec3 tip;  // where it was held
        glm::vec2 from;  // px
    };
    std::optional<Drag> drag_;
};

}  // namespace benchmarks::viewer
