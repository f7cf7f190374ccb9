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

// What carries a point: the triangle of the mesh at rest that is nearest to it.
struct SurfaceBinding {
    std::array<std::uint32_t, 3> corners;  // vertices
    glm::dvec3 weights;  // of the corners, at the triangle's nearest point; sum 1
    glm::dvec3 nearest;  // that point at rest, m
    glm::dmat3 frame;  // at rest: along the first edge, across it in the triangle, its normal
    glm::dmat2 edges;  // at rest, from the first corner to the others, along the first two of these
};

// A rigid motion since rest: x -> rotation x + translation.
struct SurfaceMotion {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // unit length
    glm::dvec3 translation{0.0};  // m

    glm::dvec3 operator()(const glm::dvec3& point) const { return rotation * point + translation; }
};

// How a point that is bound to a triangle moves when the triangle's corners are at `corners`: with
// the point of the triangle that it was nearest to, turned as the triangle has turned. The rotation
// is the one of the polar decomposition of the triangle's deformation, so it does not depend on
// which corner is the first. A triangle without area does not turn.
SurfaceMotion motionOf(const SurfaceBinding& binding, const std::array<glm::dvec3, 3>& corners);

// The rigid motion that is in the middle of others: the mean of their rotations, and the one of
// where they take `points` (as many, at least one). Exact where all of them are one motion.
SurfaceMotion meanMotion(std::span<const SurfaceMotion> motions, std::span<const glm::vec3> points);

// A mesh that an animation deforms over simulated time.
class DeformingMesh {
public:
    // `mesh` is importMesh() of the animation's file. Throws engine::Error where they don't fit.
    DeformingMesh(const Mesh& mesh, MeshAnimation animation, const AnimationSettings& settings);

    // Triangles without area carry nothing. Throws engine::Error for a mesh without any other.
    std::vector<SurfaceBinding> bind(std::span<const glm::vec3> points) const;

    // What is worked out on the way: whoever asks at many times keeps one, and its results', so
    // that none takes memory anew.
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
    // The normals of the mesh, each turned as the surface round its vertex has turned; `positions`
    // as above. Unit length.
    void normals(
        std::span<const glm::dvec3> positions, Scratch& scratch,
        std::vector<glm::vec3>& normals) const;
    std::vector<glm::vec3> normals(std::span<const glm::dvec3> positions) const;

    std::span<const glm::vec3> restPositions() const { return rest_; }
    // Simulated time in which the clip is played once, s; 0: it has one pose.
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
