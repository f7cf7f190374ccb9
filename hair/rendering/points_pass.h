#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair::rendering {

// Levels of detail by cluster (Huang et al. 2025, Real-time Level-of-detail Strand-based Rendering,
// whose clusters become thick strands by their width in the picture). A cluster has the strands of
// a root triangle. It draws as few strands and points as /lod/error lets it, e px. In the picture,
// at the same place along the strand:
// * Each strand of level 0 has a drawn strand within 0.9 e. By ClusterOrder, k strands leave none
//   farther than covering / sqrt(k + 1) times the greatest distance between
//   the guides.
// * Drawn strands stick out of their strand of level 0 by at most 0.9 e on each side, which limits
//   how many hairs one of them stands for, as greatestWidthScale() does too.
// * Drawn pieces leave their curve by at most 0.1 e. A piece of 1 / p of a guide segment leaves it
//   by |r''| / (8 p^2), and r'' lies between the second
//   differences of the guides.
// Distances become pixels where the cluster is nearest to the eye. Offsets count twice their reach.
class LevelsPass {
public:
    static bool isNeeded(const StrandPlan& plan) {
        return plan.lod_mode == LodMode::cluster && plan.strands() > 0;
    }

    LevelsPass(const engine::Device& device, const Settings& settings, const StrandPlan& plan);

    static engine::MemoryRows rows(const StrandPlan& plan);

    // Chooses the levels for the picture of the camera. Belongs after the pass that moves the
    // guides, and before all that draws strands. `picture` is the device address of `parameters`.
    void record(
        engine::Commands& commands, std::uint64_t picture, const gpu::PictureParameters& parameters,
        const LodSettings& lod) const;

    const engine::Buffer& levels() const { return levels_; }  // gpu::ClusterLevel [triangle]
    const engine::Buffer& order() const { return order_; }  // PictureParameters::strand_order

private:
    gpu::LevelsPush push_;  // without the picture and the levels; slopes in rendered pixels, error
                            // in such per pixel
    engine::ComputePipeline pipeline_;
    engine::Buffer levels_;
    engine::Buffer order_;
    engine::Buffer coverings_;
};

// The mesh under the hair if an animation deforms it, and the roots of drawn strands, each bound to
// the triangle of the mesh that was nearest to it at rest. The simulation moves the roots of
// guides. The roots of strands between guides follow their guides and are then corrected here.
class SkinnedHead {
public:
    // `view` must have a mesh that deforms. `levels` is set if LevelsPass::isNeeded(). Finds the
    // roots at rest on the device and waits.
    SkinnedHead(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan,
        const StrandView& view, const LevelsPass* levels = nullptr);

    // `vertices`: of the mesh.
    static engine::MemoryRows
    rows(std::uint64_t vertices, std::uint64_t strands, const RenderSettings& render);

    // Writes the mesh at the view's time. No frame in flight may read the slot.
    void write(std::uint32_t slot, const StrandView& view);

    // vec3 [vertex], in the world; upload buffers.
    const engine::Buffer& positions(std::uint32_t slot) const { return positions_[slot]; }
    const engine::Buffer& normals(std::uint32_t slot) const { return normals_[slot]; }

    // Records the correction of the roots for the draws that follow. The guides and their frames
    // must be up to date and visible to compute. The corrections are then visible to the stages
    // before the rasteriser, and to a PointsPass. `picture` is the address of the
    // gpu::PictureParameters.
    void record(
        engine::Commands& commands, std::uint64_t picture, const gpu::PictureParameters& parameters,
        std::uint32_t slot) const;

    // vec4 [root triangle][strand], m.
    const engine::Buffer& corrections() const { return corrections_; }

private:
    // Kept, so that no picture allocates memory.
    struct Work {
        groom::DeformingMesh::Scratch scratch;
        std::vector<glm::dvec3> positions;  // [vertex], of the mesh, m
        std::vector<glm::vec3> moved;  // [vertex], in the world
        std::vector<glm::vec3> turned;
    };

    std::uint32_t strand_count_;
    Work work_;
    engine::ComputePipeline pipeline_;
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> positions_;
    std::array<engine::Buffer, engine::FrameLoop::kMaxSlots> normals_;
    engine::Buffer corrections_;
    engine::Buffer roots_;  // gpu::CarriedRoot [root triangle][strand]
};

// Throws engine::Unsupported for more points than shaders can number.
void checkPoints(const StrandPlan& plan);

// Evaluates each point of all drawn strands once a frame, for the camera's picture and the shadow
// maps. All of them use the camera's levels of detail. 16 bytes a point.
class PointsPass {
public:
    // `culls`: strands that the camera can't see get no points. Only for pictures in which no
    // shadow map needs them. Throws as checkPoints() does.
    PointsPass(
        const engine::Device& device, const Settings& settings, const StrandPlan& plan, bool culls);

    static engine::MemoryRows rows(const StrandSettings& strands, const StrandPlan& plan);

    // Clears the bounds, in front of record().
    void clear(engine::Commands& commands) const;
    // `picture` is the device address of `parameters`, which are the camera's.
    void record(
        engine::Commands& commands, std::uint64_t picture,
        const gpu::PictureParameters& parameters) const;

    const engine::Buffer& points() const { return points_; }  // gpu::PointsPush::points
    const engine::Buffer& pieces() const { return pieces_; }  // gpu::PointsPush::pieces
    // Gpu::HairBounds in the camera's picture.
    const engine::Buffer& bounds() const { return bounds_; }
    // The points as a texel buffer; null if the device reads them by address.
    const engine::TexelView* texels() const { return texels_ ? &*texels_ : nullptr; }
    // Strands that may be drawn in a picture; at most plan.strands().
    std::uint32_t strandCount(const gpu::PictureParameters& picture) const {
        return triangles_ * picture.forced_density;
    }
    std::uint64_t bytes() const { return points_.size() + pieces_.size(); }

private:
    gpu::PointsPush push_;  // all except addresses
    std::uint32_t group_;  // invocations of a work group
    std::uint32_t triangles_;
    std::uint32_t block_;  // strands of an invocation
    std::uint32_t runs_;  // of segments, along a strand
    engine::Buffer points_;
    std::optional<engine::TexelView> texels_;
    engine::Buffer pieces_;
    engine::Buffer bounds_;
    engine::ComputePipeline evaluate_;
};

// Returns the number of points of a strand at the finest level of detail: kPointsPerStrand of
// strands/points/layout.glsl.
std::size_t pointsPerStrand(const StrandSettings& strands, const StrandPlan& plan);

// The specialization constants of strands/points/layout.glsl. pointsConstants() has
// strandConstants(), too.
engine::Constants placeConstants(const StrandPlan& plan);
engine::Constants pointsConstants(const StrandSettings& strands, const StrandPlan& plan);

// Whether shaders read and write points 64 bits at a time. A device that takes one element of one
// invocation at a time reads 64 bits as fast as 32.
bool readsPairs(const engine::Device& device);

// Returns the invocations of a work group of passes with some strands or pieces per invocation: a
// subgroup, so that none of its lanes is idle, but at least 32.
std::uint32_t strandGroup(const engine::Device& device);

// Returns the number of strands per invocation, if each piece of a strand takes `turns` iterations
// of loops. On a processor, an invocation reads once what its strands share. Other devices need
// many invocations and get 1. Strands of a groom have guides of their own, share nothing and get 1,
// too. Mesa's lavapipe ends an invocation's loops after 65,535 iterations in all.
std::uint32_t strandBlock(
    const engine::Device& device, const StrandSettings& strands, const StrandPlan& plan,
    std::uint32_t turns);

}  // namespace hair::rendering
