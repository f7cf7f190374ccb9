#include <cmath>

#include "benchmarks/decide/signed_rank.h"
#include "benchmarks/decide/verdict.h"
#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/texts.h"
#include "benchmarks/table.h"
#include "benchmarks/trust.h"

namespace benchmarks {

namespace {

// A pass is known to 1 % only if it takes a hundred steps: a tenth of a millisecond of these.
constexpr double kCoarseStep = 1000.0;  // ns
// Of the test whether two equal runs differ: one doctor in a hundred may wrongly say so.
constexpr double kRepeatAlpha = 0.01;
// What gates and comparisons call a change if nobody says otherwise.
constexpr double kThreshold = 0.02;
// A pair that scatters by more hides what most optimisations gain.
constexpr double kNoisy = 0.1;

bool isSoftware(const Facts& facts) { return facts.device.type == "cpu"; }

// What a single pair can be off by: three standard deviations.
double scatter(const std::vector<double>& differences) { return decisiveChange(0.0, differences); }

}  // namespace

Judgement judgeTimestamps(const Facts& facts) {
    const TimestampFacts& stamps = facts.timestamps;
    if (stamps.valid_bits == 0)
        return {
            Health::bad, "the device's queue has none",
            "passes cannot be timed on this device: use another one"};
    std::string seen = std::to_string(stamps.valid_bits) + " bits, " +
                       shortNumber(stamps.period_ns) + " ns a tick";
    if (!stamps.step_ns || !stamps.gap_ns)
        return {Health::bad, seen + "; they do not advance", "update the driver"};
    seen += ", in steps of " + shortNumber(*stamps.step_ns) + " ns; two in a row are " +
            shortNumber(*stamps.gap_ns * 1e-3) + " us apart";
    if (*stamps.step_ns > kCoarseStep)
        return {
            Health::warn, seen,
            "passes below " + shortNumber(*stamps.step_ns * 1e-4) +
                " ms are known to worse than 1 %: make the scene larger"};
    return {Health::ok, seen};
}

Judgement judgePassSum(const Facts& facts) {
    if (facts.timestamps.valid_bits == 0) return {Health::unknown, "needs timestamps"};
    const double ratio = facts.passes.sum_over_wall;
    const std::string seen = "isolated passes add up to " + shareText(ratio) + " of wall clock";
    if (std::abs(ratio - 1.0) <= kTrustTolerance) return {Health::ok, seen};
    return {
        Health::bad, seen,
        "don't believe times of passes here; frame times stand. Close other programs and try "
        "again; if it stays, it is the driver"};
}

Judgement judgeStamps(const Facts& facts) {
    if (facts.timestamps.valid_bits == 0) return {Health::unknown, "needs timestamps"};
    const std::vector<std::string>& faults = facts.passes.faults;
    if (faults.empty()) return {Health::ok, "as by submitting and waiting for each pass"};
    return {
        Health::bad, joined(faults, "; "),
        "reports of this device have passes by wall clock. Close other programs and try again; "
        "if it stays, it is the driver"};
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
    const MedianInterval frame = signedRankInterval(repeat.frame, kRepeatAlpha);
    const double b = std::log1p(kThreshold);
    const std::string seen = "same picture and state; of two equal runs the second took " +
                             changeText(std::expm1(frame.estimate)) + " (" +
                             changeText(std::expm1(frame.lower)) + " to " +
                             changeText(std::expm1(frame.upper)) + ")";
    if (frame.lower > b || frame.upper < -b)
        return {
            Health::bad, seen,
            "equal runs look different: close other programs, lock clocks, let the machine cool "
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
            Health::warn, seen, "frame times show large changes only: compare CPU times instead"};
    return {
        Health::warn, seen,
        "only large changes can be found: see other load, clocks and processor; `--pairs 48` says "
        "how large"};
}

}  // namespace benchmarks
