#include "benchmarks/measure/busy_work.h"

#include <algorithm>
#include <span>
#include <utility>

#include "benchmarks/measure/gpu_structs.h"
#include "engine/buffer_image.h"
#include "engine/error.h"
#include "engine/transfer.h"

namespace benchmarks::measure {

// ---- Busy work ----------------------------------------------------------------------------------

namespace {

// 262,144 invocations fill the largest GPUs. 64 work groups are shared evenly by any processor's
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
    commands.barrier(engine::Access::anything, engine::Access::compute_write);
    commands.bind(pipeline_, gpu::BusyPush{.results = results_.address(), .steps = steps_});
    commands.uses({{results_, Access::compute_write}});
    commands.dispatch(std::min(steps_, groups_));
    commands.barrier(engine::Access::compute_write, engine::Access::anything);
}

BusyWork::Done BusyWork::done() const {
    const auto results = engine::downloadAs<std::uint32_t>(device_, results_);
    return {results.front(), {results.begin() + 1, results.end()}};
}

// ---- Busy passes --------------------------------------------------------------------------------

BusyPass::BusyPass(const engine::Device& device, std::string name, std::uint32_t steps)
    : name_(std::move(name)), work_(device, steps) {}

void BusyPass::checkThatItRan() const {
    if (std::ranges::find(seen_, name_) != seen_.end()) return;
    std::string known;
    for (const std::string& name : seen_) known += (known.empty() ? "" : ", ") + name;
    throw engine::Error("/run/busy_pass", "unknown pass '" + name_ + "'; known: " + known);
}

BusyPasses::BusyPasses(engine::Passes& passes, BusyPass& busy) : passes_(passes), busy_(busy) {
    slot_ = passes.slot();
}

void BusyPasses::pass(
    const char* name, engine::PassKind kind, engine::FunctionRef<void(engine::Commands&)> record) {
    if (std::ranges::find(busy_.seen_, name) == busy_.seen_.end()) busy_.seen_.emplace_back(name);
    if (busy_.name_ != name) {
        passes_.pass(name, kind, record);
        return;
    }
    passes_.pass(name, kind, [&](engine::Commands& commands) {
        record(commands);
        busy_.work().record(commands);
    });
}

}  // namespace benchmarks::measure
