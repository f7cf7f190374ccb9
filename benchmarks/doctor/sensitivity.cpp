#include "benchmarks/doctor/sensitivity.h"

#include <algorithm>

#include "benchmarks/compare/judged_metrics.h"
#include "benchmarks/doctor/own_gate.h"
#include "benchmarks/doctor/smallest_slowdown.h"
#include "benchmarks/gate/gate_session.h"
#include "engine/error.h"

namespace benchmarks {

std::vector<Sensitivity>
measureSensitivity(const engine::DeviceOptions& device, std::uint32_t pairs) {
    const OwnGate own(device);
    GateSession session(own.options(), isFrameOrPassCost);
    try {
        const bool calibrated = session.warmUp() && session.calibrate(pairs);
        if (!session.run().mismatches.empty())
            throw engine::Error(
                "calibration", "two runs differ: " + mismatchText(session.run().mismatches[0]));
        if (!calibrated) throw engine::Error("calibration", "nothing here is long enough to judge");
    } catch (const BlockFailed& failure) {
        throw engine::Error("calibration", failure.what());
    }
    const std::vector<GateTime>& times = session.run().times;
    std::vector<Sensitivity> found;
    for (const GateTime& time : times) {
        if (time.calibration.size() < 2) continue;  // not known in some process
        // A gate judges either by the wall clock or by the processor's.
        const auto metrics = static_cast<std::size_t>(
            std::ranges::count(times, isOfProcessor(time.metric.id), [](const GateTime& each) {
                return isOfProcessor(each.metric.id);
            }));
        const double tau = decisiveChange(session.run().rule.threshold, time.calibration);
        found.push_back(
            {.metric = time.metric.id,
             .decisive_change = tau,
             .smallest_slowdown = smallestSlowdown(time.calibration, tau, metrics),
             .differences = time.calibration});
    }
    return found;
}

}  // namespace benchmarks
