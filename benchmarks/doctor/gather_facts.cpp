#include "benchmarks/doctor/gather_facts.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "benchmarks/device_record.h"
#include "benchmarks/doctor/loaded_layers.h"
#include "benchmarks/doctor/play_pairs.h"
#include "benchmarks/doctor/processor_settings.h"
#include "benchmarks/doctor/timestamp_step.h"
#include "benchmarks/environment.h"
#include "benchmarks/machine/clock_sampler.h"
#include "benchmarks/machine/machine_watch.h"
#include "benchmarks/machine/processor_load.h"
#include "engine/process_use.h"

namespace benchmarks {

namespace {

// Of a second in which this process does nothing.
LoadFacts loadNow() {
    const auto before = readProcessorTicks();
    const double own = engine::processUse().cpu;
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const auto after = readProcessorTicks();
    if (!before || !after) return {};
    const auto load = loadBetween(*before, *after, engine::processUse().cpu - own);
    if (!load) return {};
    return {.steal = load->steal, .others = load->others};
}

BuildFacts buildFacts() {
#ifdef NDEBUG
    constexpr bool kAssertions = false;
#else
    constexpr bool kAssertions = true;
#endif
    return {.build = describeBuild(), .assertions = kAssertions};
}

TimestampFacts timestampFacts(const engine::Device& device) {
    TimestampFacts facts{
        .valid_bits = device.info().timestamp_valid_bits,
        .period_ns = double{device.info().limits.timestampPeriod}};
    if (const auto steps = timestampSteps(device)) {
        facts.step_ns = static_cast<double>(steps->step) * facts.period_ns;
        facts.gap_ns = static_cast<double>(steps->gap) * facts.period_ns;
    }
    return facts;
}

ClockFacts clockFacts(const std::vector<ClockReading>& readings) {
    ClockFacts facts;
    addClocks(readings, facts.conditions);
    for (const ClockReading& reading : readings) {
        if (reading.idle || !reading.clock_mhz) continue;
        const double clock = *reading.clock_mhz;
        facts.lowest_mhz = std::min(facts.lowest_mhz.value_or(clock), clock);
        facts.highest_mhz = std::max(facts.highest_mhz.value_or(clock), clock);
    }
    facts.held = std::ranges::any_of(readings, &ClockReading::held);
    return facts;
}

}  // namespace

Facts gatherFacts(
    const engine::Device& device, engine::Validation validation, const MeasureHooks& hooks) {
    Facts facts;
    facts.load = loadNow();
    facts.device = describeDevice(device);
    facts.build = buildFacts();
    facts.layers = {.validation = validation == engine::Validation::on, .loaded = loadedLayers()};
    facts.timestamps = timestampFacts(device);
    facts.processor = {
        .governors = scalingGovernors(),
        .count = std::thread::hardware_concurrency(),
        .quota = processorQuota()};
    facts.on_battery = onBattery();
    if (facts.timestamps.valid_bits > 0) facts.passes = examinePasses(device, hooks);

    std::optional<ClockSampler> sampler;
    if (auto source = openClockSource(device.info())) sampler.emplace(std::move(source));
    if (sampler) sampler->begin();
    facts.repeat = examineRepeat(device, hooks);
    if (sampler) facts.clocks = clockFacts(sampler->end());
    return facts;
}

}  // namespace benchmarks
