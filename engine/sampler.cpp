#include "engine/sampler.h"

namespace engine {

Sampler::Sampler(const Device& device, const SamplerDescription& description) {
    VkSamplerCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    create.magFilter = create.minFilter = description.filter;
    create.mipmapMode = description.filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                               : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    create.addressModeU = description.horizontal;
    create.addressModeV = description.vertical;
    create.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    create.maxLod = VK_LOD_CLAMP_NONE;
    VkSampler sampler{};
    check(vkCreateSampler(device.get(), &create, nullptr, &sampler), "create a sampler");
    sampler_ = {device.get(), sampler};
}

}  // namespace engine
