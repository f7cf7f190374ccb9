#pragma once

#include <cstdint>
#include <vector>

#include "engine/buffer.h"
#include "engine/commands.h"
#include "engine/pipeline.h"

namespace benchmarks {

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

}  // namespace benchmarks
