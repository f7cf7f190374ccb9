#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/buffer_image.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

// The bodies that hair collides with: capsules and distance fields.
namespace hair::simulation {

// A baked field on the host: what another one of the same mesh, resolution and padding is made of
// at once.
struct BakedField {
    gpu::DistanceField grid{};  // without an address
    std::vector<float> distances;  // [z][y][x], m
    std::string warning;  // bodyWarning() of the mesh
};

// Signed distances to the surface of a body on a grid, in the mesh's frame, for shaders
// (shaders/simulation/constraints/distance_field.glsl). The body is what a closed mesh encloses,
// and of any other where the winding number is 1/2 or more (open_body.h).
class DistanceField {
public:
    // Bakes on the device and waits. The longest side of the mesh's bounding box is `resolution`
    // cells, at least 1; the grid goes on for at least `padding` (m, not negative) on every side,
    // as far on opposite ones. Distances are exact inside and, outside, to `padding` and two cells
    // more; what is farther away is said to be at least that, and at most as far as it is. Next to
    // a mesh's rim and to triangles that cross they are off by less than a cell, and inside, behind
    // those, no deeper than it is. Throws engine::Error for a mesh that bounds no body (bodyMesh())
    // or has no point of the grid inside, and engine::Unsupported where a buffer is larger than the
    // device's.
    DistanceField(
        const engine::Device& device, const groom::BodyMesh& mesh, std::uint32_t resolution,
        float padding);
    DistanceField(
        const engine::Device& device, const groom::Mesh& mesh, std::uint32_t resolution,
        float padding)
        : DistanceField(device, groom::bodyMesh(mesh), resolution, padding) {}
    // The same as where it was baked, to the bit.
    DistanceField(const engine::Device& device, const BakedField& baked);

    // Waits for the device.
    BakedField read(const engine::Device& device) const;

    const gpu::DistanceField& parameters() const { return parameters_; }
    const engine::Buffer& distances() const { return distances_; }  // float [z][y][x], m
    // What a user has to know of the mesh; empty: nothing.
    const std::string& warning() const { return warning_; }

private:
    gpu::DistanceField parameters_;
    engine::Buffer distances_;
    std::string warning_;
};

// B of a DistanceField at most, of a mesh that is as wide and as deep as high.
std::uint64_t fieldBytes(std::uint32_t resolution);

// What hair collides with, on the device: capsules and distance fields.
class Bodies {
public:
    struct Capsules {
        engine::Buffer buffer;  // gpu::Capsule [count]
        std::uint32_t count;
    };

    // `meshes[i]` is the mesh of settings.distance_fields[i]. Bakes the fields but those that
    // `baked`, as many or none, has. Throws Error (/simulation/distance_fields/N) for a mesh that
    // bounds no body.
    Bodies(
        const engine::Device& device, const SimulationSettings& settings,
        std::span<const groom::Mesh> meshes, std::span<const BakedField* const> baked = {});

    // Of settings.distance_fields.
    const std::vector<DistanceField>& fields() const { return distances_; }
    // What a user has to know of their meshes, each with the field's JSON pointer before it.
    std::vector<std::string> warnings() const;

    std::size_t count() const { return capsules_.count + distances_.size(); }

    gpu::Bodies parameters() const { return parametersWith(capsules_); }
    // The parameters of the same distance fields with other capsules.
    gpu::Bodies parametersWith(const Capsules& capsules) const;

    static Capsules makeCapsules(const engine::Device& device, const SimulationSettings& settings);
    void setCapsules(Capsules capsules) noexcept { capsules_ = std::move(capsules); }

private:
    std::vector<DistanceField> distances_;
    Capsules capsules_;
    engine::Buffer fields_;
    float margin_;
    float friction_;
};

}  // namespace hair::simulation
