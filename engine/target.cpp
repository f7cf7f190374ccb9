#include "engine/target.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "engine/buffer_image.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"

namespace engine {
namespace {

constexpr std::size_t kMostColors = 4;  // every device supports at least this many

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
    if (attachment.resolved) {
        info.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        info.resolveImageView = attachment.resolved->view();
        info.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    if (is_depth) {
        info.clearValue.depthStencil = {attachment.clear[0], 0};
    } else {
        for (std::size_t i = 0; i < 4; ++i) info.clearValue.color.float32[i] = attachment.clear[i];
    }
    return info;
}

TargetDescription checked(const Device& device, const TargetDescription& description) {
    if (!device.supportsSamples(description.msaa)) {
        throw Unsupported(
            "the device has no " + std::to_string(description.msaa) + "-sample images");
    }
    const std::uint32_t limit = device.info().limits.maxImageDimension2D;
    const std::uint32_t largest =
        std::max(description.width, description.height) * description.ssaa;
    if (largest > limit) {
        throw Unsupported(
            "an image side of " + std::to_string(largest) + " px exceeds the device's limit of " +
            std::to_string(limit));
    }
    return description;
}

ImageDescription rendered(
    const TargetDescription& description, VkFormat format, VkImageUsageFlags usage,
    const char* name) {
    return {
        .format = format,
        .width = description.width * description.ssaa,
        .height = description.height * description.ssaa,
        .samples = description.msaa,
        .usage = usage,
        .name = name,
        .purpose = "targets"};
}

std::optional<Image>
made(const Device& device, const std::optional<ImageDescription>& description) {
    if (!description) return std::nullopt;
    return std::optional<Image>(std::in_place, device, *description);
}

}  // namespace

// ---- Rendering to attachments -------------------------------------------------------------------

void beginRendering(
    Commands& commands, std::span<const Attachment> colors, const std::optional<Attachment>& depth,
    const std::optional<VkRect2D>& area) {
    assert(!colors.empty() || depth || area);
    assert(colors.size() <= kMostColors);
    std::array<VkRenderingAttachmentInfo, kMostColors> color_infos;
    std::ranges::transform(colors, color_infos.begin(), attachmentInfo);
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
    info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    info.pColorAttachments = color_infos.data();
    info.pDepthAttachment = depth ? &depth_info : nullptr;
    for (const Attachment& color : colors) {
        commands.uses({{*color.image, Access::attachment}});
        if (color.resolved) commands.uses({{*color.resolved, Access::attachment}});
    }
    if (depth) commands.uses({{*depth->image, Access::attachment}});
    commands.beginRendering(info);

    setArea(commands, rendered);
}

void setArea(Commands& commands, const VkRect2D& area) {
    const VkViewport viewport{
        static_cast<float>(area.offset.x),
        static_cast<float>(area.offset.y),
        static_cast<float>(area.extent.width),
        static_cast<float>(area.extent.height),
        0.0f,
        1.0f};
    vkCmdSetViewport(commands.get(), 0, 1, &viewport);
    vkCmdSetScissor(commands.get(), 0, 1, &area);
}

void endRendering(Commands& commands) { commands.endRendering(); }

// ---- The images of an offscreen picture ---------------------------------------------------------

Resolve resolveOf(const TargetDescription& description) {
    if (description.color_format != Target::kOutputFormat || description.ssaa > 1)
        return Resolve::compute;
    return description.msaa > 1 ? Resolve::attachment : Resolve::none;
}

TargetImages imagesOf(const TargetDescription& description) {
    constexpr VkImageUsageFlags kColor = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                         VK_IMAGE_USAGE_SAMPLED_BIT |
                                         VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    const VkImageUsageFlags read_depth =
        description.sampled_depth ? VkImageUsageFlags{VK_IMAGE_USAGE_SAMPLED_BIT} : 0u;
    const VkImageUsageFlags written = resolveOf(description) == Resolve::compute
                                          ? VK_IMAGE_USAGE_STORAGE_BIT
                                          : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    TargetImages images{
        .color = std::nullopt,
        .depth = rendered(
            description, Target::kDepthFormat,
            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | read_depth, "depth"),
        .output =
            {.format = Target::kOutputFormat,
             .width = description.width,
             .height = description.height,
             .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | written,
             .name = "output",
             .purpose = "targets"},
        .radiance = std::nullopt};
    if (resolveOf(description) != Resolve::none)
        images.color = rendered(description, description.color_format, kColor, "color");
    if (description.color_format != Target::kOutputFormat)
        images.radiance = ImageDescription{
            .format = Target::kRadianceFormat,
            .width = description.width,
            .height = description.height,
            .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
            .name = "radiance",
            .purpose = "targets"};
    return images;
}

MemoryRows targetRows(const TargetDescription& description) {
    const TargetImages images = imagesOf(description);
    MemoryRows rows;
    rows.add(images.depth);
    rows.add(images.output);
    if (images.color) rows.add(*images.color);
    if (images.radiance) rows.add(*images.radiance);
    return rows;
}

Target::Target(
    const Device& device, const TargetDescription& description, const TargetImages& images)
    : description_(checked(device, description)), color_(made(device, images.color)),
      depth_(device, images.depth), output_(device, images.output),
      radiance_(made(device, images.radiance)) {}

void Target::beginRendering(
    Commands& commands, Load load, const std::array<float, 3>& background, Last last) const {
    constexpr VkImageLayout kColor = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    constexpr VkImageLayout kDepth = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    if (load == Load::clear) {
        commands.transition(this->color(), VK_IMAGE_LAYOUT_UNDEFINED, kColor);
        commands.transition(depth_, VK_IMAGE_LAYOUT_UNDEFINED, kDepth);
    }
    const bool resolves = last == Last::yes && resolve() == Resolve::attachment;
    if (resolves) commands.transition(output_, VK_IMAGE_LAYOUT_UNDEFINED, kColor);

    const Attachment color{
        .image = &this->color(),
        .load = load,
        .clear = {background[0], background[1], background[2], 1.0f},
        .resolved = resolves ? &output_ : nullptr};
    engine::beginRendering(
        commands, std::span(&color, 1),
        Attachment{.image = &depth_, .load = load, .clear = {kFarDepth}});
}

void Target::endRendering(Commands& commands, Last last) const {
    engine::endRendering(commands);
    if (last == Last::no || resolve() == Resolve::compute) return;
    commands.transition(
        output_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
}

void Target::beginDepthRead(Commands& commands) const {
    assert(description_.sampled_depth);
    commands.transition(
        depth_, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

void Target::endDepthRead(Commands& commands) const {
    commands.transition(
        depth_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
}

void Target::beginResolve(Commands& commands) const {
    assert(resolve() == Resolve::compute);
    commands.transition(
        *color_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    commands.transition(output_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    if (radiance_)
        commands.transition(*radiance_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
}

void Target::endResolve(Commands& commands) const {
    const auto end = [&](const Image& written) {
        commands.transition(written, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    };
    end(output_);
    if (radiance_) end(*radiance_);
}

std::vector<std::uint8_t> readOutput(const Device& device, const Target& target) {
    const Buffer staging = readImage(device, target.output(), 4);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(staging.mapped().data());
    return {bytes, bytes + staging.size()};
}

std::vector<float> readRadiance(const Device& device, const Target& target) {
    assert(target.hasRadiance());
    constexpr std::size_t kPixel = 4 * sizeof(float);
    const Buffer staging = readImage(device, target.radiance(), kPixel);
    std::vector<float> rgb(staging.size() / kPixel * 3);
    for (std::size_t i = 0; i < rgb.size() / 3; ++i)
        std::memcpy(&rgb[3 * i], &staging.mapped()[kPixel * i], 3 * sizeof(float));
    return rgb;
}

}  // namespace engine
