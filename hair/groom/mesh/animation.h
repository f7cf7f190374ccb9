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
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/formats/usd_import.h"
#include "hair/groom/named_files.h"

namespace hair::groom {

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

}  // namespace hair::groom
