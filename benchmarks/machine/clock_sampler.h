#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "benchmarks/machine/clock_source.h"
#include "benchmarks/report.h"

namespace benchmarks {

// Reads a clock source again and again while a round is played: before and after it the device is
// idle, and its clocks with it. A reading takes some tens of microseconds of one processor, in a
// thread that sleeps otherwise.
class ClockSampler {
public:
    explicit ClockSampler(std::unique_ptr<ClockSource> source);
    ~ClockSampler();
    ClockSampler(const ClockSampler&) = delete;
    ClockSampler& operator=(const ClockSampler&) = delete;

    void begin();
    // One reading at least: that at the end.
    std::vector<ClockReading> end();

private:
    void sampleUntilStopped();

    std::unique_ptr<ClockSource> source_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool running_ = false;
    bool stopped_ = false;
    std::vector<ClockReading> readings_;
    std::thread thread_;
};

// Medians of what the readings know, of those that were not taken of an idle device if there are
// such; every throttle reason of theirs, each once.
void addClocks(const std::vector<ClockReading>& readings, Conditions& conditions);

}  // namespace benchmarks
