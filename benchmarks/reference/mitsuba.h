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

// Control points of the uniform cubic B-spline through `points`, with the first at its start, the
// last at its end and natural ends (zero curvature): two more than points. Needs at least two
// points. The four coordinates are four splines.
std::vector<glm::dvec4> interpolatingControlPoints(std::span<const glm::dvec4> points);

// Returns how much the directions of strands within 2 mm of each other differ, in degrees: the root
// of their mean square sine over the square root of two, which is the standard deviation in each
// plane along a strand if it is small. It is /shading/orientation_spread. Points are in metres.
// Returns 0 if no strands are that near.
double orientationSpread(const hair::groom::StrandSet& strands);

// Counts of the export, for the closing line.
struct MitsubaExport {
    std::uint32_t strands = 0;
    double orientation_spread = 0;  // degrees
    std::size_t points = 0;
    std::size_t triangles = 0;
};

// Plays the scene up to `frame`, from 0, with progress, and writes the drawn frame into `folder`:
// hair.txt, head_0.ply and so on and, after those are complete, scene.xml. Throws Interrupted.
MitsubaExport exportMitsuba(
    const engine::Device& device, const scene::Scene& scene, const hair::Settings& settings,
    std::uint32_t frame, const std::filesystem::path& folder, measure::HairCache& cache);

// Path-traces the scene.xml of exportMitsuba() in `folder`, with progress, and writes the picture,
// as .exr in linear light or as .png. Throws engine::Error and Interrupted.
void traceMitsuba(
    const std::filesystem::path& folder, std::uint32_t samples, const std::filesystem::path& out);

// The files beside a Mitsuba scene.
struct MitsubaParts {
    struct Mesh {
        std::string file;
        std::size_t triangles = 0;
        glm::vec3 color{0.0f};  // display RGB
        float metallic = 0.0f;
        float roughness = 1.0f;
        std::string texture;  // instead of the colour; empty: none
        std::string wrap = "repeat";  // Mitsuba's name: also "mirror", "clamp"
        bool two_sided = false;  // visible from behind too
    };
    std::string hair_file;  // empty: no hair
    std::string absorption_file;  // writeMitsubaAbsorption(); empty: one absorption for all hair
    std::vector<Mesh> meshes;
    std::string environment_file;  // empty: no environment
};

// A scene of Mitsuba 3 with the settings' camera, background and lights. Hair is Mitsuba's `hair`
// (Chiang et al. 2016) with the settings' absorption, roughnesses, tilt and refractive index, and
// nothing else of our shading. The background is also a light, with the same radiance from
// everywhere. Pixels are means over their squares (a box filter), as in our supersampling. The
// parameter `spp` is the number of samples per pixel. Lengths are in cm.
void writeMitsubaScene(
    std::ostream& out, const hair::Settings& settings, const MitsubaParts& parts);

// Conversion of a scene's lights for a path tracer, which uses linear RGB and physical units. A
// light's colour is the radiance of a white matt surface that faces it. If our light does not fall
// off with distance, the path tracer's does; they agree at `target`.

// Linear RGB, including the strength.
glm::dvec3 lightColor(const hair::RenderSettings& render, const hair::LightSettings& light);

// Radiant intensity of a point light with a linear colour.
glm::dvec3
lightIntensity(const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target);

// Radiance of the surface of a spherical or rectangular light.
glm::dvec3
lightRadiance(const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target);

// Geometry files that Mitsuba 3 reads; lengths in cm.

// Writes Mitsuba's `bsplinecurve` format: a line "x y z radius" for each control point, and an
// empty line after each strand. The curves pass through the strands' points and begin and end
// there. Radii are half the widths. Strands of one point are omitted. A radius that the spline
// would make negative, just beyond a tip that narrows to nothing, is set to 0.
void writeMitsubaCurves(std::ostream& out, const hair::groom::StrandSet& strands);

// Writes sigma_a of the same curves as an OpenEXR picture of one column: a pixel for each segment,
// in their order. Mitsuba's texture coordinate v goes over all segments of a `bsplinecurve` in
// equal steps. `powers` of the strands' points are those of their colours; a colour c^a has a^2
// times the absorption, by equation (9) of Chiang et al. 2016.
void writeMitsubaAbsorption(
    const std::filesystem::path& path, const hair::groom::StrandSet& strands,
    std::span<const float> powers, const glm::dvec3& absorption);

// Writes a PLY file of the triangles with this material, moved by `pose`, with texture coordinates
// if the mesh has them.
void writeMaterialPly(
    std::ostream& out, const hair::groom::Mesh& mesh, std::uint32_t material,
    const hair::simulation::RigidMotion& pose);

}  // namespace benchmarks::reference
