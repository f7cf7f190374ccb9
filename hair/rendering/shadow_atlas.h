#pragma once

#include <cstdint>

#include "engine/device.h"

namespace hair {

// Square parts of one size in an image: in rows, as many of them as columns or one less.
struct ShadowAtlas {
    std::uint32_t parts = 0;
    std::uint32_t side = 0;  // of a part, px

    std::uint32_t columns() const;
    VkExtent2D extent() const;
    VkRect2D part(std::uint32_t index) const;
};

// Throws engine::Unsupported where the device has no such images.
void checkAtlas(const engine::Device& device, const ShadowAtlas& atlas);

}  // namespace hair
