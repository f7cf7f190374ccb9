#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/buffer.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/mesh.h"

namespace hair {

// Signed distances to a closed mesh on a grid, in the mesh's frame, for shaders
// (shaders/simulation/constraints/distance_field.glsl).
class DistanceField {
public:
    // Bakes on the device and waits. The longest side of the mesh's bounding box is `resolution`
    // cells, at least 1; the grid goes on for at least `padding` (m, not negative) on every side,
    // as far on opposite ones. Throws engine::Error for a mesh that is not closed, and
    // engine::Unsupported where a buffer is larger than the device's.
    DistanceField(
        const engine::Device& device, const Mesh& mesh, std::uint32_t resolution, float padding);

    const gpu::DistanceField& parameters() const { return parameters_; }
    std::size_t bytes() const { return distances_.size(); }

    // [z][y][x], m; downloaded, for set-up and tests.
    std::vector<float> distances(const engine::Device& device) const;

private:
    gpu::DistanceField parameters_;
    engine::Buffer distances_;
};

}  // namespace hair
