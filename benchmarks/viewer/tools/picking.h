#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "benchmarks/viewer/tools/picture_view.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/simulation/rigid_motion.h"
#include "hair/simulation_settings.h"

namespace benchmarks {

struct Sphere {
    glm::vec3 center{0.0f};
    float radius = 0.0f;
};

// Round the middle of the points' bounding box. There is at least one point.
Sphere sphereRound(std::span<const glm::vec3> points);

// A vertex that is no root, of guides [guide][vertex].
struct GuideVertex {
    std::uint32_t guide = 0;
    std::uint32_t vertex = 1;
};

// The vertex nearest to a pixel, at most `reach` px from it: what is nearer to the camera by
// `depth_scale` (m) counts as if it were nearer to the pixel by `reach`.
std::optional<GuideVertex> pickVertex(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach, float depth_scale);

// The point on a guide that is nearest to the camera among those at most `reach` px from a pixel.
std::optional<glm::vec3> pickHair(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach);

// m along the ray to where it first meets a mesh that was moved.
std::optional<double>
pickMesh(const Ray& ray, const hair::Mesh& mesh, const hair::RigidMotion& moved);

// m along the ray to where it enters a capsule; none where it misses it or begins inside.
std::optional<double>
pickCapsule(const Ray& ray, const glm::vec3& a, const glm::vec3& b, float radius);

}  // namespace benchmarks
