#include "benchmarks/viewer/picture/shown_picture.h"

#include <utility>

#include "engine/commands.h"

namespace benchmarks {

using engine::Access;

const engine::Image&
ShownPicture::renew(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage) {
    retired_.reset();
    if (shown_ && extent.width == shown_->image.extent().width &&
        extent.height == shown_->image.extent().height)
        return shown_->image;
    retired_ = std::exchange(
        shown_, std::make_unique<Shown>(
                    device_, engine::ImageDescription{
                                 .format = format,
                                 .width = extent.width,
                                 .height = extent.height,
                                 .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .name = "shown picture"}));
    return shown_->image;
}

void ShownPicture::copy(engine::Commands& commands, const engine::Image& output) {
    const engine::Image& image =
        renew(output.format(), output.extent(), VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    commands.transition(
        image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, Access::anything,
        Access::transfer_write);
    commands.copy(output, image);
    commands.transition(
        image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        Access::transfer_write, Access::graphics_read);
}

}  // namespace benchmarks
