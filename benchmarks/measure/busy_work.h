#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"

// Work that slows down one pass by a known amount, to test the detection of slowdowns.
namespace benchmarks::measure {

// Steps of work that nobody needs. No driver can leave them out, because the results are written to
// a buffer. The work is proportional to the number of steps.
class BusyWork {
public:
    BusyWork(const engine::Device& device, std::uint32_t steps);

    // Records the steps after all earlier commands and before all later ones, as if the earlier
    // ones had taken longer. Does nothing for 0 steps.
    void record(engine::Commands& commands) const;

    // Number of work groups that share the steps: enough to fill a GPU. It is small on a processor,
    // where starting a group costs more than a step.
    std::uint32_t groups() const { return groups_; }

    // Results since construction. Waits for the device.
    struct Done {
        std::uint32_t steps;  // modulo 2^32
        std::vector<std::uint32_t>
            numbers;  // [group], exclusive or of all numbers of its invocations
    };
    Done done() const;

private:
    const engine::Device& device_;
    std::uint32_t steps_;
    std::uint32_t groups_;
    engine::ComputePipeline pipeline_;
    engine::Buffer results_;
};

// The pass that is slowed down, and the names of the passes that ran.
class BusyPass {
public:
    BusyPass(const engine::Device& device, std::string name, std::uint32_t steps);

    // Throws engine::Error with the list of passes if none so far had the name.
    void checkThatItRan() const;

    const BusyWork& work() const { return work_; }

private:
    friend class BusyPasses;
    std::string name_;
    BusyWork work_;
    std::vector<std::string> seen_;  // names, in order of appearance
};

// Forwards a frame's passes and appends the work to the busy one. The work is inside the pass, so
// the pass's timer, label and metric include it.
class BusyPasses : public engine::Passes {
public:
    BusyPasses(engine::Passes& passes, BusyPass& busy);

    void pass(
        const char* name, engine::PassKind kind,
        engine::FunctionRef<void(engine::Commands&)> record) override;
    void asyncCompute(std::uint32_t frames, engine::FunctionRef<void()> record) override {
        passes_.asyncCompute(frames, record);
    }

private:
    engine::Passes& passes_;
    BusyPass& busy_;
};

}  // namespace benchmarks::measure
