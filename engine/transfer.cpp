#include "engine/transfer.h"

namespace engine {

void runOnce(const Device& device, const std::function<void(Commands&)>& record) {
    DescriptorSets sets(device);
    device.submitOnce([&](VkCommandBuffer buffer) {
        Commands commands(buffer, sets, device.hazards());
        commands.begin();
        record(commands);
        commands.end();
    });
}

void upload(const Device& device, std::span<const std::byte> bytes, const Buffer& destination) {
    const Buffer staging(
        device, {.size = bytes.size(), .usage = Usage::upload, .name = "upload staging"});
    std::ranges::copy(bytes, staging.mapped().begin());
    runOnce(device, [&](Commands& commands) {
        commands.copy(staging, destination, bytes.size());
        commands.barrier(Access::transfer_write, Access::anything);
    });
}

std::vector<std::byte> download(const Device& device, const Buffer& source) {
    const Buffer staging(
        device, {.size = source.size(), .usage = Usage::readback, .name = "download staging"});
    runOnce(device, [&](Commands& commands) {
        commands.barrier(Access::anything, Access::transfer_read);
        commands.copy(source, staging, source.size());
        commands.barrier(Access::transfer_write, Access::host_read);
    });
    const std::span<std::byte> mapped = staging.mapped();
    return {mapped.begin(), mapped.end()};
}

Buffer readImage(const Device& device, const Image& image, std::size_t bytes_per_pixel) {
    const VkExtent2D extent = image.extent();
    Buffer staging(
        device, {.size = bytes_per_pixel * extent.width * extent.height,
                 .usage = Usage::readback,
                 .name = "picture"});
    runOnce(device, [&](Commands& commands) {
        commands.barrier(Access::anything, Access::transfer_read);
        commands.copy(image, staging);
        commands.barrier(Access::transfer_write, Access::host_read);
    });
    return staging;
}

}  // namespace engine
