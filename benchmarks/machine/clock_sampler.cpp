#include "benchmarks/machine/clock_sampler.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "benchmarks/machine/medians.h"

namespace benchmarks {

namespace {

// A round is tenths of a second long; drivers renew what they say about as often as this.
constexpr std::chrono::milliseconds kPeriod{50};

}  // namespace

ClockSampler::ClockSampler(std::unique_ptr<ClockSource> source)
    : source_(std::move(source)), thread_([this] { sampleUntilStopped(); }) {}

ClockSampler::~ClockSampler() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void ClockSampler::begin() {
    {
        const std::lock_guard lock(mutex_);
        readings_.clear();
        running_ = true;
    }
    changed_.notify_one();
}

std::vector<ClockReading> ClockSampler::end() {
    const std::lock_guard lock(mutex_);
    running_ = false;
    readings_.push_back(source_->read());
    return std::exchange(readings_, {});
}

void ClockSampler::sampleUntilStopped() {
    std::unique_lock lock(mutex_);
    while (!stopped_) {
        changed_.wait(lock, [this] { return running_ || stopped_; });
        // The first reading is one period in: the device has work by then.
        const bool still =
            !changed_.wait_for(lock, kPeriod, [this] { return !running_ || stopped_; });
        if (still) readings_.push_back(source_->read());
    }
}

void addClocks(const std::vector<ClockReading>& readings, Conditions& conditions) {
    std::vector<ClockReading> busy;
    std::ranges::copy_if(
        readings, std::back_inserter(busy), [](const ClockReading& each) { return !each.idle; });
    const std::vector<ClockReading>& counted = busy.empty() ? readings : busy;
    conditions.clock_mhz = medianOf(counted, &ClockReading::clock_mhz);
    conditions.base_clock_mhz = medianOf(counted, &ClockReading::base_clock_mhz);
    conditions.memory_clock_mhz = medianOf(counted, &ClockReading::memory_clock_mhz);
    conditions.temperature = medianOf(counted, &ClockReading::temperature);
    conditions.throttle_reasons = everyReason(counted);
}

}  // namespace benchmarks
