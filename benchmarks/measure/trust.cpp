#include "benchmarks/measure/trust.h"

#include <algorithm>
#include <limits>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace benchmarks::measure {

std::vector<std::string> passNames(std::span<const engine::FrameRecord> frames) {
    std::vector<std::string> names;
    for (const engine::FrameRecord& frame : frames) {
        for (const engine::PassTime& pass : frame.passes) {
            if (std::ranges::find(names, pass.name) == names.end()) names.push_back(pass.name);
        }
    }
    return names;
}

std::vector<double>
passTimes(std::span<const engine::FrameRecord> frames, const std::string& pass) {
    std::vector<double> times;
    for (const engine::FrameRecord& frame : frames) {
        const auto found = std::ranges::find(frame.passes, pass, &engine::PassTime::name);
        if (found != frame.passes.end()) times.push_back(found->milliseconds);
    }
    return times;
}

double passSum(const engine::FrameRecord& frame) {
    double sum = 0.0;
    for (const engine::PassTime& pass : frame.passes) sum += pass.milliseconds;
    return sum;
}

double passSumOverWall(std::span<const engine::FrameRecord> isolated) {
    std::vector<double> ratios;
    for (const engine::FrameRecord& frame : isolated) ratios.push_back(passSum(frame) / frame.wall);
    return report::summarize(ratios).median;
}

std::vector<std::string> timestampFaults(
    std::span<const engine::FrameRecord> isolated,
    std::span<const engine::FrameRecord> wall_clock) {
    double fastest_frame = std::numeric_limits<double>::infinity();
    for (const engine::FrameRecord& frame : wall_clock) {
        fastest_frame = std::min(fastest_frame, passSum(frame));
    }
    const double slack = kSubmissionCost + kFrameShare * fastest_frame;

    std::vector<std::string> faults;
    for (const std::string& pass : passNames(isolated)) {
        const std::vector<double> stamped_times = passTimes(isolated, pass);
        const std::vector<double> clocked_times = passTimes(wall_clock, pass);
        if (clocked_times.empty()) continue;
        // A busy machine only ever adds time, so the fastest frames are the ones to compare.
        const double stamped = std::ranges::min(stamped_times);
        const double clocked = std::ranges::min(clocked_times);
        const bool too_long = stamped > clocked * (1.0 + kTrustTolerance) + slack;
        const bool too_short = stamped < clocked * (1.0 - kTrustTolerance) - slack;
        if (too_long || too_short) {
            faults.push_back(
                "pass." + pass + ": timestamps say " + report::shortNumber(stamped) +
                " ms, the CPU's clock " + report::shortNumber(clocked) + " ms");
        }
    }
    return faults;
}

}  // namespace benchmarks::measure
