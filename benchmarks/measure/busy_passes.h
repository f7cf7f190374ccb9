#pragma once

#include <string>
#include <vector>

#include "benchmarks/measure/busy_work.h"
#include "engine/frame_loop.h"

namespace benchmarks {

// One pass that is to be slowed down, and which passes there were.
class BusyPass {
public:
    BusyPass(const engine::Device& device, std::string name, std::uint32_t steps);

    // Throws engine::Error that lists the passes if none of those so far had the name.
    void checkThatItRan() const;

    const BusyWork& work() const { return work_; }

private:
    friend class BusyPasses;
    std::string name_;
    BusyWork work_;
    std::vector<std::string> seen_;  // names, in order of appearance
};

// Hands on a frame's passes, the busy one with its work after its own: inside the pass, so that
// the pass's timer, label and metric have it.
class BusyPasses : public engine::Passes {
public:
    BusyPasses(engine::Passes& passes, BusyPass& busy);

    void pass(
        const char* name, engine::PassKind kind,
        const std::function<void(engine::Commands&)>& record) override;

private:
    engine::Passes& passes_;
    BusyPass& busy_;
};

}  // namespace benchmarks
