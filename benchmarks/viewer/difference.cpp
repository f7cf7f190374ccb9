#include "benchmarks/viewer/difference.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

#include "benchmarks/report/text.h"
#include "engine/commands.h"
#include "engine/device_address.h"

namespace benchmarks::viewer {

// ---- The pass -----------------------------------------------------------------------------------

namespace gpu {
using Address = engine::DeviceAddress;
using uint = std::uint32_t;
#include "shaders/shared/difference_structs.h"
static_assert(sizeof(DifferenceCounts) == 16);
static_assert(offsetof(DifferencePush, gain) == 8);
}  // namespace gpu

DifferencePass::DifferencePass(const engine::Device& device)
    : pipeline_(
          device, {.shader = "post/difference.comp",
                   .push_size = sizeof(gpu::DifferencePush),
                   .sampled_images = 2,
                   .storage_images = 1}),
      counts_(device, {.size = sizeof(gpu::DifferenceCounts), .name = "difference counts"}),
      readback_(
          device, {.size = sizeof(gpu::DifferenceCounts),
                   .usage = engine::Usage::readback,
                   .name = "difference counts"}) {}

void DifferencePass::record(
    engine::Commands& commands, const engine::Image& a, const engine::Image& b,
    const engine::Image& difference, std::uint32_t gain) {
    const auto [width, height] = difference.extent();
    pixels_ = std::uint64_t{width} * height;
    commands.barrier(engine::Access::anything, engine::Access::transfer_write);
    commands.fill(counts_, 0);
    commands.barrier(engine::Access::transfer_write, engine::Access::compute_write);
    commands.bind(pipeline_, gpu::DifferencePush{.counts = counts_.address(), .gain = gain});
    commands.uses({{counts_, engine::Access::compute_write}});
    commands.images(pipeline_, std::array{&a, &b}, std::array{&difference});
    commands.dispatch(
        (width + gpu::kDifferenceGroupSide - 1) / gpu::kDifferenceGroupSide,
        (height + gpu::kDifferenceGroupSide - 1) / gpu::kDifferenceGroupSide);
    commands.barrier(engine::Access::compute_write, engine::Access::transfer_read);
    commands.copy(counts_, readback_, sizeof(gpu::DifferenceCounts));
    commands.barrier(engine::Access::transfer_write, engine::Access::host_read);
}

DifferenceFigures DifferencePass::figures() const {
    gpu::DifferenceCounts counts;
    std::memcpy(&counts, readback_.mapped().data(), sizeof counts);
    return {
        .pixels = pixels_,
        .different = counts.pixels,
        .most = counts.most,
        .sum = std::uint64_t{counts.carry} << 32 | counts.sum};
}

// ---- Words --------------------------------------------------------------------------------------

std::string differenceText(const DifferenceFigures& figures) {
    if (figures.different == 0) return "identical";
    return "at most " + std::to_string(figures.most) + " of 255, on average " +
           report::shortNumber(figures.mean()) + "; " +
           report::shortNumber(100.0 * figures.share()) + " % of the pixels differ";
}

// ---- Pictures that widgets show -----------------------------------------------------------------

const engine::Image&
ShownPicture::renew(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage) {
    retired_.reset();
    size_ = extent;
    if (shown_ && extent.width == shown_->image.extent().width &&
        extent.height == shown_->image.extent().height)
        return shown_->image;
    retired_ = std::exchange(
        shown_, std::make_unique<Texture>(
                    device_, engine::ImageDescription{
                                 .format = format,
                                 .width = extent.width,
                                 .height = extent.height,
                                 .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .name = "shown picture"}));
    return shown_->image;
}

bool ShownPicture::copy(
    engine::Commands& commands, std::uint64_t number, std::span<const std::uint8_t> rgba,
    VkExtent2D extent, VkExtent2D size) {
    size_ = size;
    if (number_ == number) return true;
    const engine::Image& image =
        renew(VK_FORMAT_R8G8B8A8_UNORM, extent, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    size_ = size;
    number_ = number;
    if (staging_.size() != rgba.size())
        staging_ = engine::Buffer(
            device_,
            {.size = rgba.size(), .usage = engine::Usage::upload, .name = "shown picture"});
    staging_.write(std::as_bytes(rgba));
    commands.transition(
        image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        engine::Access::anything, engine::Access::transfer_write);
    commands.copy(staging_, 0, image, 0);
    commands.transition(
        image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        engine::Access::transfer_write, engine::Access::graphics_read);
    return !retired_;
}

// ---- The difference as a picture ----------------------------------------------------------------

void PictureDifference::record(
    engine::Commands& commands, const ShownPicture& a, const ShownPicture& b, std::uint32_t gain) {
    if (recorded_) figures_ = pass_.figures();
    const engine::Image& image =
        picture_.renew(VK_FORMAT_R8G8B8A8_UNORM, a.extent(), VK_IMAGE_USAGE_STORAGE_BIT);
    commands.transition(
        image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, engine::Access::anything,
        engine::Access::compute_write);
    pass_.record(commands, a.image(), b.image(), image, gain);
    commands.transition(
        image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        engine::Access::compute_write, engine::Access::graphics_read);
    recorded_ = true;
}

void PictureDifference::forget() {
    recorded_ = false;
    figures_.reset();
}

}  // namespace benchmarks::viewer
