#include "benchmarks/machine/machine_watch.h"

#include <optional>

#include "benchmarks/machine/amdgpu.h"
#include "benchmarks/machine/clock_sampler.h"
#include "benchmarks/machine/medians.h"
#include "benchmarks/machine/nvml.h"
#include "benchmarks/machine/pci_address.h"
#include "benchmarks/machine/processor_load.h"
#include "engine/process_use.h"

namespace benchmarks {

bool isThrottled(const Conditions& round) {
    return round.clock_mhz && round.base_clock_mhz &&
           *round.clock_mhz < kThrottledShare * *round.base_clock_mhz;
}

Conditions medianConditions(const std::vector<Conditions>& rounds) {
    return {
        .clock_mhz = medianOf(rounds, &Conditions::clock_mhz),
        .base_clock_mhz = medianOf(rounds, &Conditions::base_clock_mhz),
        .memory_clock_mhz = medianOf(rounds, &Conditions::memory_clock_mhz),
        .temperature = medianOf(rounds, &Conditions::temperature),
        .steal = medianOf(rounds, &Conditions::steal),
        .other_load = medianOf(rounds, &Conditions::other_load),
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
    double own = 0.0;                     // ms of this process, at begin()
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

Conditions MachineWatch::end() {
    Conditions conditions;
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

}  // namespace benchmarks
