#include "benchmarks/measure/machine_watch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include "benchmarks/measure/clocks.h"
#include "benchmarks/report/statistics.h"
#include "engine/process.h"

namespace benchmarks::measure {
namespace {

// ---- Medians of readings and rounds -------------------------------------------------------------

// The median of one member over those that know it; absent where none does.
template <class Thing>
std::optional<double>
medianOf(const std::vector<Thing>& things, std::optional<double> Thing::* member) {
    std::vector<double> known;
    for (const Thing& thing : things)
        if (thing.*member) known.push_back(*(thing.*member));
    if (known.empty()) return std::nullopt;
    return report::summarize(known).median;
}

// Every throttle reason, each once, in the order in which they were first seen.
template <class Thing>
std::vector<std::string> everyReason(const std::vector<Thing>& things) {
    std::vector<std::string> reasons;
    for (const Thing& thing : things)
        for (const std::string& reason : thing.throttle_reasons)
            if (std::ranges::find(reasons, reason) == reasons.end()) reasons.push_back(reason);
    return reasons;
}

// ---- Sampling of clocks -------------------------------------------------------------------------

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

void addClocks(const std::vector<ClockReading>& readings, report::Conditions& conditions) {
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

// ---- Load of the processors ---------------------------------------------------------------------

std::optional<ProcessorTicks> readProcessorTicks(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) return std::nullopt;
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (name != "cpu") return std::nullopt;
    enum { user, nice, system, idle, waiting, interrupts, soft_interrupts, steal, fields };
    std::array<std::uint64_t, fields> ticks{};
    for (std::uint64_t& each : ticks)
        if (!(words >> each)) return std::nullopt;
    // The guests' time that follows is in user and nice already.
    const std::uint64_t busy =
        ticks[user] + ticks[nice] + ticks[system] + ticks[interrupts] + ticks[soft_interrupts];
    return ProcessorTicks{
        .busy = busy,
        .steal = ticks[steal],
        .total = busy + ticks[idle] + ticks[waiting] + ticks[steal]};
}

std::optional<ProcessorLoad>
loadBetween(const ProcessorTicks& before, const ProcessorTicks& after, double own) {
    // Idle time is known to step back by a tick now and then.
    if (after.total <= before.total) return std::nullopt;
    const auto between = [](std::uint64_t from, std::uint64_t to) {
        return to > from ? static_cast<double>(to - from) : 0.0;
    };
    const double total = between(before.total, after.total);
    const double own_ticks = own * 1e-3 * static_cast<double>(sysconf(_SC_CLK_TCK));
    const double others = between(before.busy, after.busy) - own_ticks;
    return ProcessorLoad{
        .steal = std::min(between(before.steal, after.steal) / total, 1.0),
        .others = std::clamp(others / total, 0.0, 1.0)};
}

// ---- Conditions of a round ----------------------------------------------------------------------

bool isThrottled(const report::Conditions& round) {
    return round.clock_mhz && round.base_clock_mhz &&
           *round.clock_mhz < kThrottledShare * *round.base_clock_mhz;
}

report::Conditions medianConditions(const std::vector<report::Conditions>& rounds) {
    return {
        .clock_mhz = medianOf(rounds, &report::Conditions::clock_mhz),
        .base_clock_mhz = medianOf(rounds, &report::Conditions::base_clock_mhz),
        .memory_clock_mhz = medianOf(rounds, &report::Conditions::memory_clock_mhz),
        .temperature = medianOf(rounds, &report::Conditions::temperature),
        .steal = medianOf(rounds, &report::Conditions::steal),
        .other_load = medianOf(rounds, &report::Conditions::other_load),
        .throttle_reasons = everyReason(rounds)};
}

std::unique_ptr<ClockSource> openClockSource(const engine::DeviceInfo& device) {
    const std::optional<PciAddress> address = pciAddress(device);
    if (!address) return nullptr;
    if (auto nvml = openNvml(*address)) return nvml;
    return openAmdgpu(*address);
}

struct MachineWatch::Sources {
    std::optional<ClockSampler> clocks;
    std::optional<ProcessorTicks> ticks;  // at begin()
    double own = 0.0;  // ms of this process, at begin()
};

MachineWatch::MachineWatch(const engine::Device& device) : sources_(std::make_unique<Sources>()) {
    if (auto source = openClockSource(device.info())) sources_->clocks.emplace(std::move(source));
}

MachineWatch::~MachineWatch() = default;

void MachineWatch::begin() {
    sources_->ticks = readProcessorTicks();
    sources_->own = engine::processUse().cpu;
    if (sources_->clocks) sources_->clocks->begin();
}

report::Conditions MachineWatch::end() {
    report::Conditions conditions;
    if (sources_->clocks) addClocks(sources_->clocks->end(), conditions);
    const std::optional<ProcessorTicks> now = readProcessorTicks();
    if (!now || !sources_->ticks) return conditions;
    const double own = engine::processUse().cpu - sources_->own;
    if (const auto load = loadBetween(*sources_->ticks, *now, own)) {
        conditions.steal = load->steal;
        conditions.other_load = load->others;
    }
    return conditions;
}

}  // namespace benchmarks::measure
