#include "engine/rendering.h"

#include <cassert>
#include <vector>

namespace engine {

namespace {

VkRenderingAttachmentInfo attachmentInfo(const Attachment& attachment) {
    const bool is_depth = attachment.image->aspect() == VK_IMAGE_ASPECT_DEPTH_BIT;
    VkRenderingAttachmentInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info.imageView = attachment.image->view();
    info.imageLayout = is_depth ? VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL
                                : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    info.loadOp =
        attachment.load == Load::clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (is_depth) {
        info.clearValue.depthStencil = {attachment.clear[0], 0};
    } else {
        for (std::size_t i = 0; i < 4; ++i) info.clearValue.color.float32[i] = attachment.clear[i];
    }
    return info;
}

}  // namespace

void beginRendering(
    Commands& commands, std::span<const Attachment> colors, const std::optional<Attachment>& depth,
    const std::optional<VkRect2D>& area) {
    assert(!colors.empty() || depth || area);
    std::vector<VkRenderingAttachmentInfo> color_infos;
    for (const Attachment& color : colors) color_infos.push_back(attachmentInfo(color));
    VkRenderingAttachmentInfo depth_info{};
    if (depth) depth_info = attachmentInfo(*depth);

    VkRect2D rendered{};
    if (area)
        rendered = *area;
    else
        rendered.extent = (colors.empty() ? *depth : colors.front()).image->extent();
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = rendered;
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(color_infos.size());
    info.pColorAttachments = color_infos.data();
    info.pDepthAttachment = depth ? &depth_info : nullptr;
    vkCmdBeginRendering(commands.get(), &info);

    const VkViewport viewport{
        static_cast<float>(rendered.offset.x),
        static_cast<float>(rendered.offset.y),
        static_cast<float>(rendered.extent.width),
        static_cast<float>(rendered.extent.height),
        0.0f,
        1.0f};
    vkCmdSetViewport(commands.get(), 0, 1, &viewport);
    vkCmdSetScissor(commands.get(), 0, 1, &rendered);
}

void endRendering(Commands& commands) { vkCmdEndRendering(commands.get()); }

}  // namespace engine
