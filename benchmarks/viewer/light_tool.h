#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/player.h"
#include "hair/settings.h"

// The tool for the lights of /shading/lights and the environment.
namespace benchmarks::viewer {

// ---- Where light comes from ---------------------------------------------------------------------

// Returns the unit vector from the groom's middle to a light; for a directional light, against its
// direction.
glm::vec3 lightDirection(const hair::LightSettings& light, const Sphere& groom);

// Moves a light around the groom's middle at its distance. A directional light then shines from
// there through the middle, and a rectangle still faces it.
void setLightDirection(hair::LightSettings& light, const Sphere& groom, const glm::vec3& direction);

// Returns the distance from the groom's middle, m; nothing for a directional light.
std::optional<float> lightDistance(const hair::LightSettings& light, const Sphere& groom);
void setLightDistance(hair::LightSettings& light, const Sphere& groom, float distance);

// Turns the environment by `degrees`, and keeps its angle within -180 to 180.
void turnEnvironment(hair::RenderSettings& render, float degrees);

// ---- The tool -----------------------------------------------------------------------------------

// A handle for each light, on a sphere around the groom in the direction of the light, which may
// itself be far outside the picture. A ring turns the environment.
class LightTool {
public:
    Edit
    update(const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played);
    bool drags() const { return drag_.has_value() || turn_.has_value(); }

    // Options in one line: the chosen light's strength and distance, and the environment's turn.
    Edit options(OptionsLine& line, hair::Settings& settings, const Shown& played);

private:
    struct Drag {
        const Shown* played;  // side of the picture under the mouse
        glm::vec3 handle;  // where it was grabbed
        glm::vec2 from;  // px
    };
    struct Turn {
        const Shown* played;
        glm::vec2 from;  // px
        float start;  // deg
    };
    Edit dragLight(const Pointer& pointer, hair::Settings& settings, const Sphere& groom);
    Edit dragEnvironment(const Pointer& pointer, hair::Settings& settings, const Gizmo& ring);

    std::size_t selected_ = 0;
    std::optional<Drag> drag_;
    std::optional<Turn> turn_;
};

}  // namespace benchmarks::viewer
