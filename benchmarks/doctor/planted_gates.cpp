#include <algorithm>

#include "benchmarks/doctor/own_gate.h"
#include "benchmarks/doctor/planted_work.h"
#include "benchmarks/doctor/sensitivity.h"
#include "benchmarks/gate/gate_session.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

constexpr double kMargin = 1.5;  // what is planted over what can be found

// Passes that can be slowed down alone: others share what they draw into with these.
bool canBeBusy(const std::string& pass) { return pass == "strands" || pass == "simulate"; }

const Sensitivity& mostPrecise(const std::vector<Sensitivity>& all) {
    const Sensitivity* best = nullptr;
    for (const Sensitivity& each : all)
        if (canBeBusy(each.metric.pass()) &&
            (!best || each.smallest_slowdown < best->smallest_slowdown))
            best = &each;
    if (!best) throw engine::Error("planted slowdown", "no pass here is long enough");
    return *best;
}

void useCalibration(GateRun& run, const std::vector<Sensitivity>& sensitivities) {
    for (GateTime& time : run.times)
        for (const Sensitivity& each : sensitivities)
            if (each.metric == time.metric.id) time.calibration = each.differences;
}

PlantedGate gateOf(
    const OwnGate& own, const PlantedWork& busy, const MetricId& metric,
    const std::vector<Sensitivity>& sensitivities) {
    GateSession session(own.options(busySets(busy.pass, busy.work)), [&](const MetricId& each) {
        return isSameOfFrameOrPass(each, metric);
    });
    if (session.warmUp()) {
        useCalibration(session.run(), sensitivities);
        session.play();
    }
    if (!session.run().mismatches.empty())
        throw engine::Error("planted slowdown", mismatchText(session.run().mismatches.front()));
    PlantedGate gate{.pass = busy.pass, .planted = busy.planted};
    for (const Change& change : session.run().changes) {
        if (change.comparison.verdict != Verdict::regressed) continue;
        const std::string pass = change.metric.pass();
        if (pass == busy.pass) gate.found = true;
        if (!pass.empty() && pass != busy.pass) gate.elsewhere = true;
    }
    return gate;
}

}  // namespace

std::vector<PlantedGate> plantSlowdowns(
    const engine::DeviceOptions& device, const std::vector<Sensitivity>& sensitivities,
    std::uint32_t gates) {
    const Sensitivity& best = mostPrecise(sensitivities);
    const OwnGate own(device);
    try {
        const PlantedWork busy = findBusyWork(own, best.metric, kMargin * best.smallest_slowdown);
        std::vector<PlantedGate> results;
        for (std::uint32_t i = 0; i < gates; ++i)
            results.push_back(gateOf(own, busy, best.metric, sensitivities));
        return results;
    } catch (const BlockFailed& failure) {
        throw engine::Error("planted slowdown", failure.what());
    }
}

}  // namespace benchmarks
