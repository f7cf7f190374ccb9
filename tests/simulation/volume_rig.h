#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/buffer_image.h"
#include "engine/transfer.h"
#include "hair/reference/wind.h"
#include "hair/simulation/hair_hair.h"
#include "hair/simulation/solvers.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {

// Runs hair-hair interaction without a solver: takes positions and returns accelerations.
class VolumeRig {
public:
    struct Sum {
        glm::dvec3 momentum;  // m/s
        double share;
    };

    VolumeRig(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings)
        : device_(device), groom_(groom), settings_(settings),
          positions_(device, vectors("positions")), previous_(device, vectors("previous")),
          accelerations_(device, vectors("accelerations")),
          parameters_(engine::makeBuffer(
              device,
              std::array{gpu::GuideParameters{
                  .positions = positions_.address(),
                  .previous = previous_.address(),
                  .rest_positions = 0,
                  .bodies = {},
                  .gravity = {},
                  .step = stepOf(settings),
                  .velocity_kept = 1.0f,
                  .strand_count = groom.strand_count,
                  .vertices_per_strand = groom.vertices_per_strand,
                  .seed = 0}},
              "guide parameters", "tests")),
          hair_hair_(device, groom, settings, stepOf(settings)) {}

    // Returns accelerations, m/s^2, with no step before. `previous` is one substep earlier. Each
    // vertex starts with the acceleration `others`, to which hair-hair interaction adds.
    std::vector<glm::vec3> accelerations(
        std::span<const glm::vec3> positions, std::span<const glm::vec3> previous,
        const RigidMotion& frame = {}, const glm::vec3& others = glm::vec3(0.0f)) {
        hair_hair_.forget(device_);
        return nextAccelerations(positions, previous, frame, others);
    }

    void forget() { hair_hair_.forget(device_); }

    // Returns the accelerations of the next step, after the last call's step. The head's motion is
    // `now` at its start, or at rest, and `frame` at its end.
    std::vector<glm::vec3> nextAccelerations(
        std::span<const glm::vec3> positions, std::span<const glm::vec3> previous,
        const RigidMotion& frame = {}, const glm::vec3& others = glm::vec3(0.0f),
        const std::optional<RigidMotion>& now = {}) const {
        upload(positions, positions_);
        upload(previous, previous_);
        upload(std::vector(groom_.points.size(), others), accelerations_);
        runOnce(device_, [&](engine::Commands& commands) {
            hair_hair_.record(
                commands,
                {.parameters = parameters_.address(),
                 .positions = positions_.address(),
                 .previous = previous_.address(),
                 .accelerations = accelerations_.address()},
                now.value_or(frame), frame);
        });
        const auto result = engine::downloadAs<glm::vec4>(device_, accelerations_);
        return {result.begin(), result.end()};
    }

    // Returns the same accelerations from the reference.
    std::vector<glm::dvec3> expected(
        std::span<const glm::vec3> positions, std::span<const glm::vec3> previous,
        const RigidMotion& frame = {}, std::vector<glm::dvec3>* kept = nullptr) const {
        const auto rest = toDouble(groom_.points);
        const auto now = toDouble(positions);
        const auto before = toDouble(previous);
        return reference::volumeAccelerations(
            settings_, {.vertices = groom_.vertices_per_strand,
                        .rest = rest,
                        .positions = now,
                        .previous = before,
                        .step = reference::inDouble(stepOf(settings_)),
                        .frame = frame,
                        .kept = kept,
                        .frame_before = frame});
    }

    // Returns the grids of the last call, [grid][z][y][x].
    std::vector<Sum> sums() const {
        const auto fixed = engine::downloadAs<std::int32_t>(device_, hair_hair_.sums());
        const auto blocks = engine::downloadAs<gpu::VolumeBlock>(device_, hair_hair_.blocks());
        const auto parameters =
            engine::downloadAs<gpu::VolumeParameters>(device_, hair_hair_.parameters());
        const std::size_t side = settings_.hair_hair.resolution;
        const std::size_t blocks_of_side = (side + 3) / 4;
        std::vector<Sum> result;
        for (std::size_t cell = 0; cell < fixed.size() / 4; ++cell) {
            const std::size_t grid_and_z = cell / side / side;
            const std::size_t z = grid_and_z / side * blocks_of_side + grid_and_z % side / 4;
            const std::size_t y = z * blocks_of_side + cell / side % side / 4;
            const gpu::VolumeBlock& block = blocks[y * blocks_of_side + cell % side / 4];
            // Powers of two above the share and above the speed.
            const double share = std::exp2(std::bit_width(block.share));
            int speed = 0;
            (void)std::frexp(std::bit_cast<float>(block.fastest), &speed);
            const double share_unit = share / gpu::kVolumeBlockOne * 0x1p-32;
            const double momentum_unit = std::ldexp(share_unit, std::max(speed, -62));
            const std::int32_t* sum = &fixed[4 * cell];
            const int borrowed = parameters[0].borrows == 1 && sum[2] < 0 ? 1 : 0;
            result.push_back(
                {momentum_unit * glm::dvec3(sum[1], sum[2], sum[3] + borrowed),
                 share_unit * sum[0]});
        }
        return result;
    }

    VolumeGrid grid() const { return volumeGrid(groom_, settings_.hair_hair.resolution); }

private:
    engine::BufferDescription vectors(const char* name) const {
        return {.size = groom_.points.size() * sizeof(glm::vec4), .name = name, .purpose = "tests"};
    }

    void upload(std::span<const glm::vec3> points, const engine::Buffer& buffer) const {
        std::vector<glm::vec4> vectors;
        for (const glm::vec3& point : points) vectors.emplace_back(point, 1.0f);
        engine::upload(device_, std::as_bytes(std::span(vectors)), buffer);
    }

    const engine::Device& device_;
    groom::Groom groom_;
    SimulationSettings settings_;
    engine::Buffer positions_;
    engine::Buffer previous_;
    engine::Buffer accelerations_;
    engine::Buffer parameters_;
    HairHair hair_hair_;
};

}  // namespace hair::simulation
