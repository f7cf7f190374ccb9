#include <algorithm>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/texts.h"
#include "benchmarks/machine/machine_watch.h"
#include "benchmarks/table.h"

namespace benchmarks {

namespace {

// Shares of all processors' time from which others disturb, and from which they rule.
constexpr double kLittleLoad = 0.05;
constexpr double kMuchLoad = 0.25;
constexpr double kLittleSteal = 0.01;
constexpr double kMuchSteal = 0.1;

bool isSoftware(const Facts& facts) { return facts.device.type == "cpu"; }

std::string megahertz(double clock) { return shortNumber(clock) + " MHz"; }

std::string clockText(const ClockFacts& clocks) {
    std::string text;
    if (clocks.lowest_mhz && clocks.highest_mhz)
        text = *clocks.lowest_mhz == *clocks.highest_mhz
                   ? megahertz(*clocks.highest_mhz)
                   : megahertz(*clocks.lowest_mhz) + " to " + megahertz(*clocks.highest_mhz);
    else
        text = "shaders' clock not told";
    if (const auto base = clocks.conditions.base_clock_mhz) text += " of " + megahertz(*base);
    if (clocks.held) text += ", held by the administrator";
    if (const auto degrees = clocks.conditions.temperature)
        text += ", " + shortNumber(*degrees) + " degrees C";
    if (!clocks.conditions.throttle_reasons.empty())
        text += ", held back by " + joined(clocks.conditions.throttle_reasons, ", ");
    return text;
}

// What disturbs a software device's frames disturbs only the recording of others'.
Health disturbance(const Facts& facts, double share, double little, double much) {
    if (share <= little) return Health::ok;
    return share > much && isSoftware(facts) ? Health::bad : Health::warn;
}

}  // namespace

Judgement judgeClocks(const Facts& facts) {
    if (isSoftware(facts)) return {Health::ok, "the processor's: see there"};
    if (!facts.clocks)
        return {
            Health::unknown, "no NVML, nor files of amdgpu",
            "watch the clocks by other means: throttling goes unnoticed"};
    const ClockFacts& clocks = *facts.clocks;
    const std::string seen = clockText(clocks);
    if (isThrottled(clocks.conditions))
        return {
            Health::bad, seen,
            "the device is throttled: let it cool down, raise its power limit, end what else uses "
            "it"};
    if (!clocks.conditions.throttle_reasons.empty())
        return {
            Health::warn, seen,
            "lock the clocks at what the device can hold (NVIDIA: nvidia-smi --lock-gpu-clocks, "
            "as administrator)"};
    if (!clocks.held)
        return {
            Health::warn, seen,
            "clocks are free to change: lock them before comparing (NVIDIA: nvidia-smi "
            "--lock-gpu-clocks; AMD: power_dpm_force_performance_level; as administrator)"};
    return {Health::ok, seen};
}

Judgement judgeProcessor(const Facts& facts) {
    const ProcessorFacts& processor = facts.processor;
    std::string seen = processor.count ? std::to_string(*processor.count) + " processors"
                                       : std::string("processors");
    if (processor.quota) seen += ", " + shortNumber(*processor.quota) + " of them to be used";
    seen += processor.governors.empty() ? "; frequency scaling not told"
                                        : "; governor " + joined(processor.governors, ", ");
    if (isSoftware(facts) && processor.quota && processor.count &&
        *processor.quota < *processor.count)
        return {
            Health::warn, seen,
            "the container's quota stops frames half-way: give it whole processors (cpuset)"};
    if (processor.governors.empty()) return {Health::unknown, seen};
    const bool steady = std::ranges::all_of(
        processor.governors, [](const std::string& each) { return each == "performance"; });
    if (steady) return {Health::ok, seen};
    return {
        Health::warn, seen,
        "set the governor to performance (cpupower frequency-set -g performance, as "
        "administrator)"};
}

Judgement judgeOthers(const Facts& facts) {
    if (!facts.load.others) return {Health::unknown, "no /proc/stat"};
    const std::string seen = shareText(*facts.load.others) + " of all processors' time";
    const Health health = disturbance(facts, *facts.load.others, kLittleLoad, kMuchLoad);
    if (health == Health::ok) return {health, seen};
    return {health, seen, "end other programs, or measure when the machine is idle"};
}

Judgement judgeSteal(const Facts& facts) {
    if (!facts.load.steal) return {Health::unknown, "no /proc/stat"};
    const std::string seen = shareText(*facts.load.steal) + " of all processors' time";
    const Health health = disturbance(facts, *facts.load.steal, kLittleSteal, kMuchSteal);
    if (health == Health::ok) return {health, seen};
    return {health, seen, "the hypervisor gives time to other guests: use a machine of your own"};
}

Judgement judgePower(const Facts& facts) {
    if (!facts.on_battery) return {Health::unknown, "no power supply is listed"};
    if (!*facts.on_battery) return {Health::ok, "mains"};
    return {Health::warn, "battery", "plug the machine in: it saves power now"};
}

}  // namespace benchmarks
