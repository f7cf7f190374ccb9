#pragma once

#include <cstdint>
#include <span>
#include <utility>
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
    struct Capsules {
        engine::Buffer buffer;  // gpu::Capsule [count]
        std::uint32_t count;
    };

    // `meshes[i]` is the mesh of settings.distance_fields[i]. Bakes the fields. Throws Error
    // (/simulation/distance_fields/N) for a mesh that is not closed.
    Bodies(
        const engine::Device& device, const SimulationSettings& settings,
        std::span<const Mesh> meshes);

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

}  // namespace hair
