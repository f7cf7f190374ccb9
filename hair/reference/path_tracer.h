#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "hair/rendering/fiber.h"

// Light transport among fibres: a path tracer from the eye in double precision, with the scattering
// of fiber.h. Independent of the tracers that judge our shading, and of the device.
namespace hair::reference {

// A matt triangle mesh: a BRDF of reflectance / pi on the side of its normals.
struct MattMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;  // unit, interpolated; one per position
    std::vector<std::array<std::uint32_t, 3>> triangles;
    glm::dvec3 reflectance{0};
    enum class Sides { front, both } sides = Sides::front;
};

// Lights; colours are linear RGB.
struct PointLight {
    glm::dvec3 position{0};
    glm::dvec3 intensity{0};  // radiant intensity: irradiance times distance^2
};
struct DirectionalLight {
    glm::dvec3 direction{0};  // unit; the light travels along it
    glm::dvec3 irradiance{0};  // on a perpendicular plane
};
// Visible, and casts shadows.
struct SphereLight {
    glm::dvec3 center{0};
    double radius = 0;
    glm::dvec3 radiance{0};
};

struct TracedScene {
    rendering::Fiber fiber;
    // Control points of uniform cubic B-splines from root to tip, with radii: round fibres without
    // caps. A ray hits them from outside; inside a fibre it goes on to the next one.
    std::vector<std::vector<glm::dvec4>> curves;
    // sigma_a of each span between knots, all curves in their order; empty: that of `fiber`.
    std::vector<glm::dvec3> absorptions;
    std::vector<MattMesh> meshes;
    std::vector<PointLight> points;
    std::vector<DirectionalLight> directions;
    std::vector<SphereLight> spheres;
    glm::dvec3 background{0};  // radiance from all directions
};

// A pinhole camera. A pixel is the mean over its square.
struct TracedCamera {
    glm::dvec3 position{0};
    glm::dvec3 target{0};
    glm::dvec3 up{0, 1, 0};
    double field_of_view = 0;  // vertical, deg
    std::uint32_t width = 0;  // px
    std::uint32_t height = 0;
};

struct TracedPicture {
    std::vector<glm::dvec3> radiances;  // [row][column], top row first
    std::vector<glm::dvec3> variances;  // of these means, from the spread of their samples

    glm::dvec3 mean() const;
    glm::dvec3 standardError() const;  // of mean()
};

// Paths end after this many hits of fibres and meshes.
inline constexpr int kMostBounces = 63;

class PathTracer {
public:
    explicit PathTracer(const TracedScene& scene);  // `scene` must outlive this
    ~PathTracer();

    // Two threads share the rows. The picture depends only on `seed`, not on the threads.
    // `samples`: per pixel, at least two.
    TracedPicture
    trace(const TracedCamera& camera, std::uint32_t samples, std::uint64_t seed) const;

private:
    class Surfaces;
    class Paths;
    const TracedScene& scene_;
    std::unique_ptr<Surfaces> surfaces_;
};

}  // namespace hair::reference
