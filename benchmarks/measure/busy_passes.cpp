#include "benchmarks/measure/busy_passes.h"

#include <algorithm>
#include <utility>

#include "engine/error.h"

namespace benchmarks {

BusyPass::BusyPass(const engine::Device& device, std::string name, std::uint32_t steps)
    : name_(std::move(name)), work_(device, steps) {}

void BusyPass::checkThatItRan() const {
    if (std::ranges::find(seen_, name_) != seen_.end()) return;
    std::string known;
    for (const std::string& name : seen_) known += (known.empty() ? "" : ", ") + name;
    throw engine::Error("/run/busy_pass", "there is no pass '" + name_ + "'; there are " + known);
}

BusyPasses::BusyPasses(engine::Passes& passes, BusyPass& busy) : passes_(passes), busy_(busy) {
    slot_ = passes.slot();
}

void BusyPasses::pass(
    const char* name, engine::PassKind kind, const std::function<void(engine::Commands&)>& record) {
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

}  // namespace benchmarks
