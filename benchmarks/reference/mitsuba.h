#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "benchmarks/scene/scene.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// Export of a frame as a scene of Mitsuba 3.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::reference {

// Control points of the uniform cubic B-spline that goes through `points`, the first at its start
// and the last at its end, with natural ends (no curvature there): two more than points. Of at
// least two points; four coordinates are four splines.
std::vector<glm::dvec4> interpolatingControlPoints(std::span<const glm::dvec4> points);

// What was exported, for the closing line.
struct MitsubaExport {
    std::uint32_t strands = 0;
    std::size_t points = 0;
    std::size_t triangles = 0;
};

// Plays the scene up to `frame`, from 0, with progress, and writes what is then drawn into
// `folder`: hair.txt, head_0.ply and so on, and, when those are whole, scene.xml. Throws
// Interrupted.
MitsubaExport exportMitsuba(
    const engine::Device& device, const scene::Scene& scene, const hair::Settings& settings,
    std::uint32_t frame, const std::filesystem::path& folder, measure::HairCache& cache);

// Path-traces the scene.xml that exportMitsuba() wrote into `folder`, with progress, and writes the
// picture, .exr in linear light or .png. Throws engine::Error, Interrupted.
void traceMitsuba(
    const std::filesystem::path& folder, std::uint32_t samples, const std::filesystem::path& out);

// What lies beside a Mitsuba scene.
struct MitsubaParts {
    struct Mesh {
        std::string file;
        std::size_t triangles = 0;
        glm::vec3 color{0.0f};  // display RGB
        float metallic = 0.0f;
        float roughness = 1.0f;
        std::string texture;  // instead of the colour; empty: none
        std::string wrap = "repeat";  // Mitsuba's: also "mirror", "clamp"
        bool two_sided = false;  // seen from behind too
    };
    std::string hair_file;  // empty: no hair
    std::vector<Mesh> meshes;
    std::string environment_file;  // empty: no environment
};

// A scene of Mitsuba 3 with the settings' camera, background and lights. Hair is Mitsuba's `hair`
// (Chiang et al. 2016) with the settings' absorption, roughnesses, tilt and index; nothing else of
// our shading is in it. The background is a light too, of the same radiance from everywhere. Pixels
// are means over their squares (a box filter), as in our supersampling. Samples a pixel: the
// parameter `spp`. Lengths are in cm.
void writeMitsubaScene(
    std::ostream& out, const hair::Settings& settings, const MitsubaParts& parts);

// What a scene's lights mean to a path tracer, which has linear RGB and units: a light's colour is
// the radiance of a white matt surface that faces it. Where ours does not weaken with distance,
// theirs does, and they agree at `target`.

// Linear RGB, with the strength.
glm::dvec3 lightColor(const hair::RenderSettings& render, const hair::LightSettings& light);

// Radiant intensity of a point light of a linear colour.
glm::dvec3
lightIntensity(const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target);

// Radiance of the surface of a sphere or rectangle of light.
glm::dvec3
lightRadiance(const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target);

// Files of geometry that Mitsuba 3 reads; lengths in cm.

// Mitsuba's `bsplinecurve`: a line "x y z radius" for each control point, an empty line after each
// strand. The curves go through the strands' points and begin and end at them; half the widths are
// their radii. Strands of one point are left out. A radius that the spline would make negative,
// just beyond a tip that narrows to nothing, is 0 instead.
void writeMitsubaCurves(std::ostream& out, const hair::groom::StrandSet& strands);

// PLY of the triangles with this material, where `pose` takes them, with texture coordinates where
// the mesh has them.
void writeMaterialPly(
    std::ostream& out, const hair::groom::Mesh& mesh, std::uint32_t material,
    const hair::simulation::RigidMotion& pose);

}  // namespace benchmarks::reference
