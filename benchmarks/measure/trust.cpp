#include "benchmarks/measure/trust.h"

#include <algorithm>
#include <cmath>
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

EmptySubmission emptySubmission(std::span<const engine::FrameRecord> empty) {
    std::vector<double> walls;
    for (const engine::FrameRecord& frame : empty) walls.push_back(frame.wall);
    const double median = report::quantile(walls, 0.5);
    return {median, report::quantile(walls, 0.95) - median};
}

PassSum passSums(std::span<const engine::FrameRecord> isolated, const EmptySubmission& empty) {
    std::vector<double> device;
    std::vector<double> work;
    std::vector<double> missing;  // ms of the wall clock that no pass has
    for (const engine::FrameRecord& frame : isolated) {
        if (!frame.device || frame.passes.empty()) continue;
        const double sum = passSum(frame);
        const double at_work = frame.wall - empty.median;
        if (*frame.device > 0.0) device.push_back(sum / *frame.device);
        // A frame of nothing but its submission leaves nothing to compare with.
        if (at_work > empty.spread) work.push_back(sum / at_work);
        missing.push_back(std::abs(at_work - sum) / frame.wall);
    }
    PassSum result;
    if (missing.empty()) return result;
    result.over_wall = passSumOverWall(isolated);
    if (!device.empty()) result.over_device = report::quantile(device, 0.5);
    if (!work.empty()) result.over_work = report::quantile(work, 0.5);
    std::vector<double> walls;
    for (const engine::FrameRecord& frame : isolated) walls.push_back(frame.wall);
    const double slack = 2.0 * empty.spread / report::quantile(walls, 0.5);
    result.incomplete =
        (result.over_device && std::abs(*result.over_device - 1.0) > kTrustTolerance) ||
        report::quantile(missing, 0.5) > kTrustTolerance + slack;
    return result;
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
