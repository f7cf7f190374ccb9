#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/quaternion_double.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/mesh/animation.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/simulation_settings.h"

namespace hair::groom {

// The binding of a point to the triangle of the mesh that is nearest to it at rest.
struct SurfaceBinding {
    std::array<std::uint32_t, 3> corners;  // vertices
    glm::dvec3 weights;  // of the corners, at the triangle's nearest point; sum 1
    glm::dvec3 nearest;  // that point at rest, m
    glm::dmat3 frame;  // at rest: along the first edge, across it in the triangle, its normal
    // At rest, from the first corner to the others, in the frame's first two axes.
    glm::dmat2 edges;
};

// A rigid motion since rest: x -> rotation x + translation.
struct SurfaceMotion {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // unit length
    glm::dvec3 translation{0.0};  // m

    glm::dvec3 operator()(const glm::dvec3& point) const { return rotation * point + translation; }
};

// Returns how a bound point moves when the triangle's corners are at `corners`. The point moves
// with its nearest point of the triangle, and turns as the triangle turns. The rotation is that of
// the polar decomposition of the triangle's deformation, so it does not depend on which corner is
// the first. A triangle without area does not turn.
SurfaceMotion motionOf(const SurfaceBinding& binding, const std::array<glm::dvec3, 3>& corners);

// Returns the mean of rigid motions: the mean of their rotations, and the translation that takes
// the mean of `points` to the mean of the moved points. Needs a point for each motion, and at least
// one. Exact if all motions are the same.
SurfaceMotion meanMotion(std::span<const SurfaceMotion> motions, std::span<const glm::vec3> points);

// A mesh that an animation deforms over simulated time.
class DeformingMesh {
public:
    // `mesh` is importMesh() of the animation's file. Throws engine::Error if they don't fit.
    DeformingMesh(const Mesh& mesh, MeshAnimation animation, const AnimationSettings& settings);

    // Binds points to triangles that have an area. Throws engine::Error for a mesh without any.
    std::vector<SurfaceBinding> bind(std::span<const glm::vec3> points) const;

    // Intermediate values. Callers that ask at many times keep one, and the results, so that
    // nothing is allocated again.
    struct Scratch {
        MeshAnimation::Pose pose;
        std::vector<glm::dvec3> facing;
    };

    // [binding], at a simulated time, s.
    void motions(
        std::span<const SurfaceBinding> bindings, double time, Scratch& scratch,
        std::vector<SurfaceMotion>& motions) const;
    std::vector<SurfaceMotion> motions(std::span<const SurfaceBinding> bindings, double time) const;
    // [vertex], m
    void positions(double time, Scratch& scratch, std::vector<glm::dvec3>& positions) const;
    std::vector<glm::dvec3> positions(double time) const;
    // Returns the normals of the mesh, each turned as the surface round its vertex has turned.
    // `positions` are those of positions(). Unit length.
    void normals(
        std::span<const glm::dvec3> positions, Scratch& scratch,
        std::vector<glm::vec3>& normals) const;
    std::vector<glm::vec3> normals(std::span<const glm::dvec3> positions) const;

    std::span<const glm::vec3> restPositions() const { return rest_; }
    // Simulated time in which the clip is played once, s. 0 for a clip of one pose, or at the speed
    // 0.
    double period() const;

private:
    double clipTime(double time) const;
    void facing(std::span<const glm::dvec3> positions, std::vector<glm::dvec3>& sums) const;

    MeshAnimation animation_;
    double speed_;
    bool repeats_;
    std::vector<glm::vec3> rest_;  // [vertex], m
    std::vector<glm::vec3> normals_;  // [vertex]
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::uint32_t> joined_;  // [vertex], the first vertex at the same place
    std::vector<glm::dvec3> facing_;  // [vertex], at rest: facing()
};

}  // namespace hair::groom
