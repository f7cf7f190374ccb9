#pragma once

#include "engine/target.h"
#include "hair/rendering/working_color.h"
#include "hair/settings.h"

namespace hair {

// Format of the colors that a picture is rendered to.
inline VkFormat colorFormat(const RenderSettings& render) {
    return hasLinearLight(render) ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R8G8B8A8_UNORM;
}

inline engine::TargetDescription targetDescription(const RenderSettings& render) {
    return {
        .width = render.width,
        .height = render.height,
        .msaa = render.msaa,
        .ssaa = render.ssaa,
        .color_format = colorFormat(render)};
}

}  // namespace hair
