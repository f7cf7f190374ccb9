#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"

// Work that slows down one pass by a known amount, to test what finds slowdowns.
namespace benchmarks::measure {

// Steps of work that nobody needs and no driver can leave out: what it makes is written to a
// buffer. The work is proportional to the number of steps.
class BusyWork {
public:
    BusyWork(const engine::Device& device, std::uint32_t steps);

    // Records the steps after all that was recorded before and before all that comes after, as if
    // what came before had taken longer. Nothing for 0 steps.
    void record(engine::Commands& commands) const;

    // At most so many groups share the steps: enough to fill the device, and on a processor, where
    // beginning a group costs more than a step, few.
    std::uint32_t groups() const { return groups_; }

    // What was done since it was made. Waits for the device.
    struct Done {
        std::uint32_t steps;  // modulo 2^32
        std::vector<std::uint32_t>
            numbers;  // [group], exclusive or of all that its invocations made
    };
    Done done() const;

private:
    const engine::Device& device_;
    std::uint32_t steps_;
    std::uint32_t groups_;
    engine::ComputePipeline pipeline_;
    engine::Buffer results_;
};

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
        engine::FunctionRef<void(engine::Commands&)> record) override;
    void beside(std::uint32_t frames, engine::FunctionRef<void()> record) override {
        passes_.beside(frames, record);
    }

private:
    engine::Passes& passes_;
    BusyPass& busy_;
};

}  // namespace benchmarks::measure
