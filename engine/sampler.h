#pragma once

#include "engine/device.h"

namespace engine {

struct SamplerDescription {
    VkFilter filter = VK_FILTER_LINEAR;  // within a level and between levels
    VkSamplerAddressMode horizontal = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    VkSamplerAddressMode vertical = VK_SAMPLER_ADDRESS_MODE_REPEAT;
};

// How fragment shaders sample an image.
class Sampler {
public:
    Sampler(const Device& device, const SamplerDescription& description);

    VkSampler get() const { return sampler_.get(); }

private:
    Handle<VkSampler, &vkDestroySampler> sampler_;
};

}  // namespace engine
