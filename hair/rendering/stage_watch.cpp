#include "hair/rendering/stage_watch.h"

#include <span>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"

namespace hair {

namespace {

engine::Buffer watchBuffer(const engine::Device& device) {
    VkPhysicalDeviceFeatures features{};
    vkGetPhysicalDeviceFeatures(device.info().handle, &features);
    if (!features.vertexPipelineStoresAndAtomics)
        throw engine::Unsupported(
            "ablation", "the device's vertex, tessellation and geometry stages can't store");
    return {
        device,
        {.size = sizeof(gpu::StageWatch), .usage = engine::Usage::storage, .name = "stage watch"}};
}

}  // namespace

StageWatch::StageWatch(const engine::Device& device)
    : device_(device), buffer_(watchBuffer(device)) {
    seeNone();
}

void StageWatch::seeAll() { see(0, 0); }

void StageWatch::seeNone() { see(0xffffffff, 0x9e3779b9); }  // any number that is nothing special

StageWatch::Seen StageWatch::seen() const {
    const gpu::StageWatch watch = engine::downloadAs<gpu::StageWatch>(device_, buffer_).front();
    return {.invocations = watch.count, .sum = watch.sum};
}

void StageWatch::see(std::uint32_t mask, std::uint32_t wanted) {
    const gpu::StageWatch watch{.mask = mask, .wanted = wanted, .sum = 0, .count = 0};
    engine::upload(device_, std::as_bytes(std::span(&watch, 1)), buffer_);
}

}  // namespace hair
