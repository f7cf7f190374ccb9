#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/ext/quaternion_double.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/formats/usd_import.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom/named_files.h"
#include "hair/simulation_settings.h"

// A mesh that an animation of its file deforms over time.
namespace hair::groom {

// ---- The animation of a file --------------------------------------------------------------------

// Returns the names of a mesh file's animations, numbers ("0", "1" ...) for those without. Empty
// for formats with animations that are not read. Throws engine::Error "path: reason".
std::vector<std::string>
animationNames(const std::filesystem::path& path, const NamedFileCheck& check = {});

// The positions of a file's vertices over time. glTF 2.0: sections 3.7.2.2 (morph targets), 3.7.3
// (skins), 3.11 and appendix C (animations). USD: one clip, "points", with the samples of
// readUsdSamples(). Everything is computed in double precision.
class MeshAnimation {
public:
    // The scene's nodes and the weights of morph targets at a time. A pose that is used again
    // allocates nothing.
    struct Pose {
        // [part][joint] with a skin, otherwise [part][0].
        std::vector<std::vector<glm::dmat4>> joints;
        std::vector<std::vector<double>> weights;  // [part][morph target]

        // Memory for intermediate values:
        struct Placing {
            glm::dvec3 translation;  // m
            glm::dquat rotation;  // unit length
            glm::dvec3 scale;
        };
        std::vector<Placing> placings;  // [node]
        std::vector<std::vector<double>> animated;  // [node][morph target], or empty
        std::vector<glm::dmat4> transforms;  // [node], to the scene
        std::vector<double> value;  // of a channel

        // USD: the samples before and after the time, the same at the ends.
        std::size_t before = 0, after = 0;
        double share = 0.0;  // weight of the sample after
    };

    // `clip` is the name of one of the file's animations, or its number in animationNames(). Throws
    // engine::Error "path: reason" for faults against glTF: joints that the skin lacks, weights of
    // joints with a sum other than 1, keyframes that don't ascend, numbers that are not finite.
    // Channels that name no node, or a property of another extension, are skipped.
    MeshAnimation(
        const std::filesystem::path& path, const std::string& clip,
        const NamedFileCheck& check = {});

    // The vertices of the meshes that importMesh() reads of the same file, in the same order.
    std::size_t vertexCount() const { return vertex_count_; }
    // The time of the last keyframe, s; at least 0.
    double duration() const { return duration_; }

    // The first and last keyframes of a channel hold before and after them.
    void poseAt(double time, Pose& pose) const;
    // m
    glm::dvec3 position(const Pose& pose, std::size_t vertex) const;
    void positions(const Pose& pose, std::vector<glm::dvec3>& positions) const;

private:
    enum class Interpolation { step, linear, cubic_spline };
    enum class Property { translation, rotation, scale, weights };

    struct Node {
        int parent;  // -1: none; comes before the node
        int number;  // in the file
        glm::dmat4 matrix;  // read if has_matrix
        bool has_matrix;
        glm::dvec3 translation;  // m
        glm::dquat rotation;  // unit length
        glm::dvec3 scale;
    };

    struct Channel {
        std::size_t node;  // index into nodes_
        Property property;
        Interpolation interpolation;
        std::size_t components;  // of a value
        std::vector<double> times;  // [key], s, ascending
        std::vector<double> values;  // [key][component]; cubic: [key][in tangent, value, out][...]

        void at(double time, std::vector<double>& result) const;
    };

    // A primitive.
    struct Part {
        std::size_t first;  // vertex
        std::vector<glm::dvec3> positions;  // [vertex]
        std::vector<std::vector<glm::dvec3>> targets;  // [morph target][vertex], displacements
        std::vector<double> weights;  // [morph target], if nothing animates them
        std::size_t node;  // index into nodes_
        bool is_skinned = false;
        std::vector<std::size_t> joints;  // [joint], indices into nodes_
        std::vector<glm::dmat4> inverse_binds;  // [joint]
        std::size_t influences = 0;
        // [vertex][influence]: a joint and its weight; the weights of a vertex add up to 1.
        std::vector<std::pair<std::uint32_t, double>> influence_list;
    };

    friend class GltfAnimationReader;

    static glm::dvec3
    placed(const Part& part, const Pose& pose, std::size_t number, std::size_t vertex);
    glm::dvec3 sampled(const Pose& pose, std::size_t vertex) const;

    std::size_t vertex_count_ = 0;
    double duration_ = 0.0;
    std::vector<Node> nodes_;  // parents first
    std::vector<Channel> channels_;
    std::vector<Part> parts_;  // by their first vertices
    UsdSamples samples_;  // empty for other formats
};

// ---- The mesh -----------------------------------------------------------------------------------

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
