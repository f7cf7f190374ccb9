#pragma once

#include <vector>

#include "engine/buffer.h"
#include "engine/device.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"

namespace hair {

// What a fibre scatters, as the settings say, without the address of the averages.
gpu::HairOptics makeHairOptics(const ShadingSettings& shading);

// The averages that dual scattering looks up, over cos theta_i.
std::vector<gpu::FiberAverage> makeFiberAverages(const ShadingSettings& shading);

// HairOptics and FiberAverages on the device; the averages only where the model needs them.
class HairOpticsBuffers {
public:
    HairOpticsBuffers(const engine::Device& device, const Settings& settings);

    std::uint64_t address() const { return optics_.address(); }  // of gpu::HairOptics

private:
    engine::Buffer averages_;
    engine::Buffer optics_;
};

}  // namespace hair
