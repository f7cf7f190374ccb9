#include "benchmarks/viewer/picture/difference_pass.h"

#include <array>
#include <cstddef>
#include <cstring>

#include "engine/commands.h"

namespace benchmarks {

namespace gpu {
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
    using engine::Access;
    const auto [width, height] = difference.extent();
    pixels_ = std::uint64_t{width} * height;
    commands.barrier(Access::anything, Access::transfer_write);
    commands.fill(counts_, 0);
    commands.barrier(Access::transfer_write, Access::compute_write);
    commands.bind(pipeline_, gpu::DifferencePush{.counts = counts_.address(), .gain = gain});
    commands.images(pipeline_, std::array{&a, &b}, std::array{&difference});
    commands.dispatch(
        (width + gpu::kDifferenceGroupSide - 1) / gpu::kDifferenceGroupSide,
        (height + gpu::kDifferenceGroupSide - 1) / gpu::kDifferenceGroupSide);
    commands.barrier(Access::compute_write, Access::transfer_read);
    commands.copy(counts_, readback_, sizeof(gpu::DifferenceCounts));
    commands.barrier(Access::transfer_write, Access::host_read);
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

}  // namespace benchmarks
