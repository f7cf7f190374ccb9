#pragma once

#include <glm/vec3.hpp>

#include "engine/buffer.h"
#include "engine/device.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"

namespace hair {

// What a fibre scatters, as the settings say. Angles of the table are in rad.
gpu::HairOptics makeHairOptics(const Settings& settings);

// The same on the device, with what dual scattering looks up.
class HairOpticsBuffers {
public:
    HairOpticsBuffers(const engine::Device& device, const Settings& settings);

    std::uint64_t address() const { return optics_.address(); }  // of gpu::HairOptics

private:
    engine::Buffer optics_;
};

}  // namespace hair
