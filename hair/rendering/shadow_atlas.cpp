#include "hair/rendering/shadow_atlas.h"

#include <algorithm>
#include <string>

#include "engine/error.h"

namespace hair {

std::uint32_t ShadowAtlas::columns() const {
    std::uint32_t columns = 1;
    while (columns * columns < parts) ++columns;
    return columns;
}

VkExtent2D ShadowAtlas::extent() const {
    const std::uint32_t rows = (parts + columns() - 1) / columns();
    return {side * columns(), side * rows};
}

VkRect2D ShadowAtlas::part(std::uint32_t index) const {
    return {
        {static_cast<std::int32_t>(side * (index % columns())),
         static_cast<std::int32_t>(side * (index / columns()))},
        {side, side}};
}

void checkAtlas(const engine::Device& device, const ShadowAtlas& atlas) {
    const VkPhysicalDeviceLimits& limits = device.info().limits;
    const std::uint32_t most = std::min(
        {limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight});
    const std::uint32_t width = atlas.extent().width;
    if (width > most) {
        throw engine::Unsupported(
            "/shading/shadows/resolution", std::to_string(atlas.parts) + " lights' maps of " +
                                               std::to_string(atlas.side) + " px are an image of " +
                                               std::to_string(width) + " px, over the device's " +
                                               std::to_string(most));
    }
}

}  // namespace hair
