#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/device.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"

// The body that an open mesh bounds, on a distance field's grid.

namespace hair::simulation {

// The inside is the region with winding number 1/2 or more, within the mesh's bounding box. The
// mesh is only part of its surface. Where the winding number goes smoothly through 1/2 there is a
// cap, which is flat across a flat opening. Distances to the mesh alone would change sign there
// with a jump as large as the opening, and would push hair that comes through the opening all the
// way to the rim. With the cap's triangles added, distances go through 0 as at any other surface.
struct OpenBody {
    std::vector<float> sides;  // [z][y][x] of the grid: -1 inside, 1 outside
    std::vector<glm::vec3> positions;  // [vertex], m
    // Triangles of the mesh, except those with the inside on both sides, then of the caps. Their
    // orientation has no meaning.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Computes winding numbers on the device, and waits for it, and caps on the host. Throws
// engine::Error if no grid point is inside.
OpenBody makeOpenBody(
    const engine::Device& device, const groom::OpenMesh& mesh, const gpu::DistanceField& grid);

// Bodies that hair collides with: capsules and distance fields.

// A baked field on the host. From it, another field of the same mesh, resolution and padding is
// made without baking.
struct BakedField {
    gpu::DistanceField grid{};  // without its address
    std::vector<float> distances;  // [z][y][x], m
    std::string warning;  // bodyWarning() of the mesh
};

// Signed distances to a body's surface on a grid, in the mesh's frame, for shaders
// (shaders/simulation/constraints/distance_field.glsl). The body is the interior of a closed mesh.
// For any other mesh it is the region of winding number 1/2 or more (OpenBody).
class DistanceField {
public:
    // Bakes on the device and waits. The longest side of the mesh's bounding box has `resolution`
    // cells, at least 1. The grid extends at least `padding` (m, not negative) beyond the box,
    // equally far on opposite sides. Distances are exact inside, and outside up to `padding` plus
    // two cells. Farther away, a distance is at least that and at most the true distance. Next to a
    // mesh's rim and to triangles that cross, distances are off by less than a cell; inside, behind
    // these, depths are not overestimated. Throws engine::Error for a mesh that bounds no body
    // (bodyMesh()) or has no grid point inside, and engine::Unsupported if a buffer exceeds the
    // device's limit.
    DistanceField(
        const engine::Device& device, const groom::BodyMesh& mesh, std::uint32_t resolution,
        float padding);
    DistanceField(
        const engine::Device& device, const groom::Mesh& mesh, std::uint32_t resolution,
        float padding)
        : DistanceField(device, groom::bodyMesh(mesh), resolution, padding) {}
    // Equals the baked field bit for bit.
    DistanceField(const engine::Device& device, const BakedField& baked);

    // Waits for the device.
    BakedField read(const engine::Device& device) const;

    const gpu::DistanceField& parameters() const { return parameters_; }
    const engine::Buffer& distances() const { return distances_; }  // float [z][y][x], m
    // Warning about the mesh for the user; empty: none.
    const std::string& warning() const { return warning_; }

private:
    gpu::DistanceField parameters_;
    engine::Buffer distances_;
    std::string warning_;
};

// Bodies on the device: capsules and distance fields.
class Bodies {
public:
    struct Capsules {
        engine::Buffer buffer;  // gpu::Capsule [count]
        std::uint32_t count;
    };

    // `meshes[i]` is the mesh of settings.distance_fields[i]. Bakes the fields that are missing in
    // `baked`, which has as many entries or none. Throws Error (/simulation/distance_fields/N) for
    // a mesh that bounds no body.
    Bodies(
        const engine::Device& device, const SimulationSettings& settings,
        std::span<const groom::Mesh> meshes, std::span<const BakedField* const> baked = {});

    // A field takes at most the size of that of a mesh as wide and as deep as it is high.
    static engine::MemoryRows rows(const SimulationSettings& settings);

    // Fields of settings.distance_fields.
    const std::vector<DistanceField>& fields() const { return distances_; }
    // Warnings about their meshes for the user, each after the field's JSON pointer.
    std::vector<std::string> warnings() const;

    std::size_t count() const { return capsules_.count + distances_.size(); }

    gpu::Bodies parameters() const { return parametersWith(capsules_); }
    // Returns the parameters with other capsules and the same distance fields.
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

// Collision of guide segments with bodies: /simulation/collision/parts.

// Moves segments out of bodies after each substep of `shape` and `ftl`, the solvers with positions
// and previous positions as their whole state: shaders/simulation/segments.comp. Keeps segment
// lengths. Borrows nothing.
class SegmentPass {
public:
    static engine::MemoryRows rows(std::uint64_t vertices) {
        return {"simulation", {{"guide starts", engine::bytesOf<glm::vec4>(vertices)}}};
    }

    SegmentPass(
        const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
        const SimulationSettings& settings);

    // Saves the positions at the start of a substep. They must be written before. Afterwards the
    // solver may overwrite them.
    void recordStart(engine::Commands& commands, const engine::Buffer& positions) const;

    // Runs after the solver's substep. `frame` and `frame_before`: the head at the substep's end
    // and start.
    void record(
        engine::Commands& commands, const GuideAddresses& guides, const gpu::RigidFrame& frame,
        const gpu::RigidFrame& frame_before) const;

private:
    std::uint32_t strand_count_;
    std::uint32_t keeps_rest_;
    engine::Buffer starts_;  // vec4 [strand][vertex], m
    engine::ComputePipeline pipeline_;
};

}  // namespace hair::simulation
