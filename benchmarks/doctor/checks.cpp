#include "benchmarks/doctor/checks.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/report/change.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "engine/instance.h"

namespace benchmarks::doctor {
namespace {

using report::shareText;
using report::Trusted;

// ---- Texts --------------------------------------------------------------------------------------

std::string joined(const std::vector<std::string>& parts, std::string_view between) {
    std::string text;
    for (const std::string& part : parts) {
        if (!text.empty()) text += between;
        text += part;
    }
    return text;
}

// ---- The machine --------------------------------------------------------------------------------

bool isSoftware(const Facts& facts) { return facts.device.type == engine::DeviceType::cpu; }

// "1.2 % more", "0.3 % less" for shares of 0.012 and -0.003.
std::string changeText(double share) {
    if (!std::isfinite(share)) return "any amount";
    return shareText(std::abs(share)) + (share < 0.0 ? " less" : " more");
}

std::string megahertz(double clock) { return report::shortNumber(clock) + " MHz"; }

std::string clockText(const ClockFacts& clocks) {
    std::string text;
    if (clocks.lowest_mhz && clocks.highest_mhz)
        text = *clocks.lowest_mhz == *clocks.highest_mhz
                   ? megahertz(*clocks.highest_mhz)
                   : megahertz(*clocks.lowest_mhz) + " to " + megahertz(*clocks.highest_mhz);
    else
        text = clocks.taken_for_idle ? "unknown: the driver reports the device as idle"
                                     : "shader clock unknown";
    if (const auto base = clocks.conditions.base_clock_mhz) text += " of " + megahertz(*base);
    if (clocks.held) text += ", held by the administrator";
    if (const auto degrees = clocks.conditions.temperature)
        text += ", " + report::shortNumber(*degrees) + " degrees C";
    if (!clocks.conditions.throttle_reasons.empty())
        text += ", throttled by " + joined(clocks.conditions.throttle_reasons, ", ");
    return text;
}

Judgement judgeClocks(const Facts& facts) {
    if (isSoftware(facts)) return {Health::ok, "those of the processor: see there"};
    if (!facts.clocks)
        return {
            Health::unknown, "neither NVML nor files of amdgpu, i915 or xe",
            "watch the clocks by other means: throttling would go unnoticed"};
    const ClockFacts& clocks = *facts.clocks;
    const std::string seen = clockText(clocks);
    const Trusted level = report::judgeClock(clocks.conditions);
    if (level == Trusted::untrusted)
        return {
            Health::bad, seen,
            "the device is throttled: let it cool down, raise its power limit, end other programs "
            "that use it"};
    if (level == Trusted::doubtful)
        return {
            Health::warn, seen,
            "lock the clocks at a rate that the device sustains (NVIDIA: nvidia-smi "
            "--lock-gpu-clocks, as administrator)"};
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
    if (processor.quota) seen += ", " + report::shortNumber(*processor.quota) + " of them usable";
    seen += processor.governors.empty() ? "; frequency scaling unknown"
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
    const Health health = healthOf(
        report::judgeOtherLoad(*facts.load.others, report::sharesProcessors(facts.device.type)));
    if (health == Health::ok) return {health, seen};
    return {health, seen, "end other programs, or measure when the machine is idle"};
}

Judgement judgeSteal(const Facts& facts) {
    if (!facts.load.steal) return {Health::unknown, "no /proc/stat"};
    const std::string seen = shareText(*facts.load.steal) + " of all processors' time";
    const Health health = healthOf(report::judgeSteal(*facts.load.steal, isSoftware(facts)));
    if (health == Health::ok) return {health, seen};
    return {health, seen, "the hypervisor gives time to other guests: use a machine of your own"};
}

Judgement judgePower(const Facts& facts) {
    if (!facts.on_battery) return {Health::unknown, "no power supply is listed"};
    if (!*facts.on_battery) return {Health::ok, "mains"};
    return {Health::warn, "battery", "plug the machine in: on battery it saves power"};
}

// ---- The program --------------------------------------------------------------------------------

bool contains(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

// This layer only selects a device and does not touch submissions.
bool isHarmless(const std::string& layer) { return contains(layer, "MESA_device_select"); }

Judgement judgeDevice(const Facts& facts) {
    const std::string seen = facts.device.name + " (" +
                             (facts.device.type ? engine::deviceTypeName(*facts.device.type) : "") +
                             ")";
    if (!isSoftware(facts)) return {Health::ok, seen};
    return {Health::ok, seen + ": times are those of the processors; judge by CPU time too"};
}

Judgement judgeBuild(const Facts& facts) {
    const report::BuildRecord& build = facts.build.build;
    std::string seen = build.type.empty() ? "no build type" : build.type;
    if (!build.flags.empty()) seen += " (" + build.flags + ")";
    if (facts.build.assertions) seen += ", assertions on";
    if (build.dirty == true) seen += ", not as committed";
    if (facts.build.assertions || report::judgeBuild(build) == Trusted::untrusted)
        return {Health::bad, seen, "measure with the release preset"};
    if (build.dirty == true)
        return {Health::warn, seen, "commit before you keep results: nobody can build this again"};
    return {Health::ok, seen};
}

Judgement judgeLayers(const Facts& facts) {
    if (facts.layers.validation)
        return {Health::bad, "the validation layer is on", "leave out --validate"};
    if (facts.layers.loaded.empty()) return {Health::ok, "none"};
    Judgement judgement{Health::ok, joined(facts.layers.loaded, ", ")};
    for (const std::string& layer : facts.layers.loaded) {
        if (isHarmless(layer)) continue;
        judgement.health = Health::warn;
        judgement.advice = "layers slow down every call: unset VK_INSTANCE_LAYERS and "
                           "VK_LOADER_LAYERS_ENABLE, or set VK_LOADER_LAYERS_DISABLE='*'";
        if (contains(layer, "validation")) {
            judgement.health = Health::bad;
            return judgement;
        }
    }
    return judgement;
}

// ---- Timings ------------------------------------------------------------------------------------

// A pass is known to 1 % only if it takes a hundred steps. For a step of this length, that is a
// tenth of a millisecond.
constexpr double kCoarseStep = 1000.0;  // ns
// Level of the test whether two equal runs differ: a false alarm in one of a hundred runs of the
// doctor.
constexpr double kRepeatAlpha = 0.01;
// The default threshold of gates and comparisons for a change.
constexpr double kThreshold = 0.02;
// Pairs with a larger scatter hide the gain of most optimisations.
constexpr double kNoisy = 0.1;

// Possible error of a single pair: three standard deviations.
double scatter(const std::vector<double>& differences) {
    return report::decisiveChange(0.0, differences);
}

Judgement judgeTimestamps(const Facts& facts) {
    const TimestampFacts& timestamps = facts.timestamps;
    if (timestamps.valid_bits == 0)
        return {
            Health::bad, "the device's queue has none",
            "passes cannot be timed on this device: use another one"};
    std::string seen = std::to_string(timestamps.valid_bits) + " bits, " +
                       report::shortNumber(timestamps.period_ns) + " ns a tick";
    if (!timestamps.step_ns || !timestamps.gap_ns)
        return {Health::bad, seen + "; they do not advance", "update the driver"};
    seen += ", in steps of " + report::shortNumber(*timestamps.step_ns) + " ns; two in a row are " +
            report::shortNumber(*timestamps.gap_ns * 1e-3) + " us apart";
    if (*timestamps.step_ns > kCoarseStep)
        return {
            Health::warn, seen,
            "the error of passes below " + report::shortNumber(*timestamps.step_ns * 1e-4) +
                " ms is above 1 %: make the scene larger"};
    return {Health::ok, seen};
}

Judgement judgePassSum(const Facts& facts) {
    if (facts.timestamps.valid_bits == 0) return {Health::unknown, "needs timestamps"};
    const measure::PassSum& sum = facts.passes.sum;
    if (!sum.over_wall) return {Health::unknown, "no frame had timestamps"};
    std::string seen = "isolated passes add up to " + shareText(*sum.over_wall) + " of wall clock";
    // On a fast device, a submission takes longer than a frame.
    if (!isSoftware(facts) && sum.over_device)
        seen += ", " + shareText(*sum.over_device) + " of the device's own time";
    const bool whole = isSoftware(facts) ? report::judgePassSum(*sum.over_wall) == Trusted::trusted
                                         : !sum.incomplete;
    if (whole) return {Health::ok, seen};
    return {
        Health::bad, seen,
        "times of passes can't be trusted here; times of frames can. Close other programs and try "
        "again; if it persists, the driver is at fault"};
}

Judgement judgePassTimes(const Facts& facts) {
    if (facts.timestamps.valid_bits == 0) return {Health::unknown, "needs timestamps"};
    const std::vector<std::string>& faults = facts.passes.faults;
    if (faults.empty()) return {Health::ok, "the same as by submitting and waiting for each pass"};
    return {
        Health::bad, joined(faults, "; "),
        "reports of this device time passes by wall clock. Close other programs and try again; if "
        "it persists, the driver is at fault"};
}

Judgement judgeRepeat(const Facts& facts) {
    const RepeatFacts& repeat = facts.repeat;
    if (!repeat.same_picture || !repeat.same_state) {
        const char* const what = repeat.same_state     ? "pictures"
                                 : repeat.same_picture ? "states"
                                                       : "pictures and states";
        return {
            Health::bad, std::string(what) + " of two equal runs differ",
            "times of different work can't be compared: look for a driver update"};
    }
    const report::MedianInterval frame = report::signedRankInterval(repeat.frame, kRepeatAlpha);
    const double b = std::log1p(kThreshold);
    const std::string seen = "same picture and state; of two equal runs the second took " +
                             changeText(std::expm1(frame.estimate)) + " (" +
                             changeText(std::expm1(frame.lower)) + " to " +
                             changeText(std::expm1(frame.upper)) + ")";
    if (frame.lower > b || frame.upper < -b)
        return {
            Health::bad, seen,
            "equal runs seem to differ: close other programs, lock clocks, let the machine cool "
            "down"};
    return {Health::ok, seen};
}

Judgement judgeNoise(const Facts& facts) {
    const double frame = scatter(facts.repeat.frame);
    const double cpu = scatter(facts.repeat.cpu);
    std::string seen =
        "three standard deviations of a pair are " + shareText(frame) + " of the frame time";
    if (isSoftware(facts)) seen += ", " + shareText(cpu) + " of the CPU time";
    if (frame <= kNoisy) return {Health::ok, seen};
    if (isSoftware(facts) && cpu <= kNoisy)
        return {
            Health::warn, seen, "frame times show only large changes: compare CPU times instead"};
    return {
        Health::warn, seen,
        "only large changes can be found: see other load, clocks and processor; `--pairs 48` says "
        "how large"};
}

// ---- All checks ---------------------------------------------------------------------------------

constexpr DoctorCheck kChecks[] = {
    {"device", judgeDevice},         {"build", judgeBuild},       {"layers", judgeLayers},
    {"timestamps", judgeTimestamps}, {"pass sum", judgePassSum},  {"pass times", judgePassTimes},
    {"repeatability", judgeRepeat},  {"noise", judgeNoise},       {"clocks", judgeClocks},
    {"processor", judgeProcessor},   {"other load", judgeOthers}, {"steal", judgeSteal},
    {"power", judgePower},
};

}  // namespace

Health healthOf(Trusted level) {
    switch (level) {
    case Trusted::trusted:
        return Health::ok;
    case Trusted::doubtful:
        return Health::warn;
    case Trusted::untrusted:
        break;
    }
    return Health::bad;
}

const char* healthName(Health health) {
    switch (health) {
    case Health::ok:
        return "ok";
    case Health::unknown:
        return "unknown";
    case Health::warn:
        return "warn";
    case Health::bad:
        return "bad";
    }
    return "";
}

std::span<const DoctorCheck> doctorChecks() { return kChecks; }

std::vector<Finding> judgeAll(const Facts& facts) {
    std::vector<Finding> findings;
    for (const DoctorCheck& check : kChecks) {
        Judgement judgement = check.judge(facts);
        findings.push_back(
            {check.name, judgement.health, std::move(judgement.seen), std::move(judgement.advice)});
    }
    return findings;
}

}  // namespace benchmarks::doctor
