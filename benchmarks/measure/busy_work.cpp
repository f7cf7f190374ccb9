#include "benchmarks/measure/busy_work.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "engine/transfer.h"

namespace benchmarks {

namespace gpu {
using uint = std::uint32_t;
#include "shaders/shared/busy_structs.h"
static_assert(offsetof(BusyPush, steps) == 8);
}  // namespace gpu

namespace {

// 262,144 invocations fill the largest GPUs; 64 groups are shared evenly by any processor's
// threads.
constexpr std::uint32_t kGroups = 4096;
constexpr std::uint32_t kProcessorGroups = 64;

}  // namespace

BusyWork::BusyWork(const engine::Device& device, std::uint32_t steps)
    : device_(device), steps_(steps),
      groups_(device.info().type == "cpu" ? kProcessorGroups : kGroups),
      pipeline_(device, {.shader = "busy/busy.comp", .push_size = sizeof(gpu::BusyPush)}),
      results_(engine::makeBuffer(
          device, std::span<const std::uint32_t>(std::vector<std::uint32_t>(1 + groups_, 0)),
          "busy work")) {}

void BusyWork::record(engine::Commands& commands) const {
    using engine::Access;
    if (steps_ == 0) return;
    commands.barrier(Access::anything, Access::compute_write);
    commands.bind(pipeline_, gpu::BusyPush{.results = results_.address(), .steps = steps_});
    commands.dispatch(std::min(steps_, groups_));
    commands.barrier(Access::compute_write, Access::anything);
}

BusyWork::Done BusyWork::done() const {
    const auto results = engine::downloadAs<std::uint32_t>(device_, results_);
    return {results.front(), {results.begin() + 1, results.end()}};
}

}  // namespace benchmarks
