#include "engine/texture.h"

#include <algorithm>

#include "engine/buffer.h"
#include "engine/commands.h"
#include "engine/error.h"

namespace engine {
namespace {

ImageDescription describe(
    const Device& device, const std::vector<Pixels>& levels, VkFormat format,
    const std::string& name) {
    const Pixels& largest = levels.front();
    const std::uint32_t most = device.info().limits.maxImageDimension2D;
    if (std::max(largest.width, largest.height) > most) {
        throw Unsupported(
            name, std::to_string(largest.width) + " by " + std::to_string(largest.height) +
                      " pixels; the device has " + std::to_string(most) + " a side");
    }
    return {
        .format = format,
        .width = largest.width,
        .height = largest.height,
        .levels = static_cast<std::uint32_t>(levels.size()),
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .name = name};
}

VkFormat formatOf(Texels texels, Decoding decoding) {
    return texels == Texels::display_color && decoding == Decoding::linear
               ? VK_FORMAT_R8G8B8A8_SRGB
               : VK_FORMAT_R8G8B8A8_UNORM;
}

}  // namespace

Texture::Texture(
    const Device& device, const Pixels& pixels, Texels texels, Decoding decoding,
    const std::string& name)
    : Texture(device, textureLevels(pixels, texels), formatOf(texels, decoding), name) {}

Texture::Texture(
    const Device& device, const std::vector<Pixels>& levels, VkFormat format,
    const std::string& name)
    : image_(device, describe(device, levels, format, name)) {
    std::size_t bytes = 0;
    for (const Pixels& level : levels) bytes += level.rgba.size();
    const Buffer staging(device, {.size = bytes, .usage = Usage::upload, .name = name});
    device.runOnce([&](Commands& commands) {
        commands.transition(
            image_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
            Access::anything, Access::transfer_write);
        std::size_t offset = 0;
        for (std::uint32_t i = 0; i < levels.size(); ++i) {
            std::ranges::copy(
                std::as_bytes(std::span(levels[i].rgba)),
                staging.mapped().begin() + static_cast<std::ptrdiff_t>(offset));
            commands.copy(staging, offset, image_, i);
            offset += levels[i].rgba.size();
        }
        commands.transition(
            image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
            Access::transfer_write, Access::graphics_read);
    });
}

}  // namespace engine
