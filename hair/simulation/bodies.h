#pragma once

#include <span>
#include <vector>

#include "engine/buffer.h"
#include "hair/gpu_structs.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/distance_field.h"

namespace hair {

// What hair collides with, on the device: capsules and distance fields.
class Bodies {
public:
    // `meshes[i]` is the mesh of settings.distance_fields[i]. Bakes the fields. Throws Error
    // (/simulation/distance_fields/N) for a mesh that is not closed.
    Bodies(
        const engine::Device& device, const SimulationSettings& settings,
        std::span<const Mesh> meshes);

    gpu::Bodies parameters() const { return parameters_; }

private:
    std::vector<DistanceField> distances_;
    engine::Buffer capsules_;
    engine::Buffer fields_;
    gpu::Bodies parameters_;
};

}  // namespace hair
