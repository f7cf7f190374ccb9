#include "benchmarks/doctor/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/doctor/play_pairs.h"
#include "benchmarks/gate/blocks.h"
#include "benchmarks/gate/session.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/report/statistics.h"
#include "engine/error.h"
#include "engine/process.h"

namespace benchmarks::doctor {
namespace {

// ---- Gates of this program against itself -------------------------------------------------------

// Gates of this program against itself, on the doctor's scene.
class OwnGate {
public:
    explicit OwnGate(const engine::DeviceOptions& device);

    // `b_sets`: "POINTER=VALUE" for B's runs only. A block has one round, some tenths of a second
    // on a software device.
    gate::GateOptions options(std::vector<std::string> b_sets = {}) const;

private:
    engine::ScratchFolder folder_;
    engine::DeviceOptions device_;
    std::filesystem::path scene_;
};

// This program, even if its file was replaced since its start.
constexpr const char* kThisProgram = "/proc/self/exe";

OwnGate::OwnGate(const engine::DeviceOptions& device)
    : device_(device), scene_(writeDoctorScene(folder_.path())) {}

gate::GateOptions OwnGate::options(std::vector<std::string> b_sets) const {
    gate::GateOptions options;
    options.a = options.b = kThisProgram;
    options.scene.scene = scene_;
    options.scene.device = device_;
    options.scene.max_time = 0.0;
    options.b_sets = std::move(b_sets);
    return options;
}

// ---- Busy work for a wanted slowdown ------------------------------------------------------------

// The amount of /run/busy_work in a pass and the slowdown that it causes.
struct PlantedWork {
    std::string pass;
    std::uint32_t work = 0;
    double planted = 0.0;  // added share of the pass's cost, as measured
};

// The "POINTER=VALUE" settings that plant it.
std::vector<std::string> busySets(const std::string& pass, std::uint32_t work);

constexpr std::uint32_t kFirstWork = 64;
constexpr std::uint32_t kMostWork = 1u << 28;
constexpr std::uint32_t kGrowth = 8;
constexpr std::size_t kRoughPairs = 3;
constexpr std::size_t kMeasuredPairs = 12;
// Slowdown measured to find the scale: well above the noise of any machine.
constexpr double kPlain = 1.0;

// The share that the work adds to the metric, as the median over pairs of processes.
double measureShare(
    const OwnGate& own, const report::MetricId& metric, std::uint32_t work, std::size_t pairs) {
    const gate::GateOptions options = own.options(busySets(metric.pass(), work));
    gate::BlockRunner runner(options.scene.scene);
    const gate::Side plain = gate::parseSide('A', options);
    const gate::Side busy = gate::parseSide('B', options);
    const auto medianOf = [&](const gate::Side& side) {
        const gate::BlockReport block = runner.run(side, 0);
        const report::MetricReading* const reading =
            block.cases.empty() ? nullptr : report::findMetric(block.cases.front().metrics, metric);
        if (!reading) throw engine::Error("planted slowdown", metric.name() + " was not measured");
        return reading->median;
    };
    std::vector<double> ratios;
    for (std::size_t i = 0; i < pairs; ++i) {
        const double first = medianOf(i % 2 == 0 ? plain : busy);
        const double second = medianOf(i % 2 == 0 ? busy : plain);
        ratios.push_back(i % 2 == 0 ? second / first : first / second);
    }
    return report::summarize(ratios).median - 1.0;
}

std::uint32_t clampedWork(double work) {
    return static_cast<std::uint32_t>(std::clamp(work, 1.0, double{kMostWork}));
}

std::vector<std::string> busySets(const std::string& pass, std::uint32_t work) {
    return {"/run/busy_pass=" + pass, "/run/busy_work=" + std::to_string(work)};
}

// Finds the work that adds this share to a pass's metric, with pairs of processes with and without
// it. Throws engine::Error if no amount of it shows, and Interrupted.
PlantedWork findBusyWork(const OwnGate& own, const report::MetricId& metric, double share) {
    const double plain = std::max(kPlain, 2.0 * share);
    std::uint32_t work = kFirstWork;
    double found = measureShare(own, metric, work, 1);
    while (found < plain && work <= kMostWork / kGrowth) {
        work *= kGrowth;
        found = measureShare(own, metric, work, 1);
    }
    if (found < plain)
        throw engine::Error("planted slowdown", "busy work does not show in " + metric.name());
    found = measureShare(own, metric, work, kRoughPairs);
    // The cost is proportional except for a constant start-up cost, so a second estimate near the
    // target is needed.
    PlantedWork busy{.pass = metric.pass(), .work = clampedWork(work * share / found)};
    const double near = measureShare(own, metric, busy.work, kMeasuredPairs);
    const double slope =
        (found - near) / (static_cast<double>(work) - static_cast<double>(busy.work));
    if (slope > 0.0) busy.work = clampedWork(busy.work + (share - near) / slope);
    busy.planted = measureShare(own, metric, busy.work, kMeasuredPairs);
    return busy;
}

// ---- Smallest slowdown that a gate finds --------------------------------------------------------

constexpr int kGates = 1000;  // 90 % of them are known to one percent
constexpr double kFound = 0.9;
constexpr std::uint32_t kSeed = 1;

}  // namespace

double
smallestSlowdown(std::span<const double> differences, double decisive_change, std::size_t metrics) {
    if (differences.size() < 2) throw engine::Error("calibration", "two pairs are needed");
    const double level =
        report::stageLevel(report::VerdictRule{}.alpha) / static_cast<double>(metrics);
    std::mt19937 random(kSeed);  // the standard defines its numbers
    std::vector<double> missing;  // ln of the slowdown that each gate needs, less ln(1 + tau)
    std::vector<double> drawn(*std::rbegin(report::kStages));
    for (int gate = 0; gate < kGates; ++gate) {
        for (double& each : drawn) {
            each = differences[random() % differences.size()];
            if (random() % 2 == 0) each = -each;
        }
        missing.push_back(-report::signedRankInterval(drawn, level).lower);
    }
    return std::expm1(std::log1p(decisive_change) + report::quantile(missing, kFound));
}

// ---- Calibration on this machine ----------------------------------------------------------------

std::vector<Sensitivity>
measureSensitivity(const engine::DeviceOptions& device, std::uint32_t pairs) {
    const OwnGate own(device);
    gate::GateSession session(own.options(), report::isFrameOrPassCost);
    try {
        const bool calibrated = session.warmUp() && session.calibrate(pairs);
        if (!session.run().mismatches.empty())
            throw engine::Error(
                "calibration",
                "two runs differ: " + report::mismatchText(session.run().mismatches[0]));
        if (!calibrated) throw engine::Error("calibration", "nothing here is long enough to judge");
    } catch (const gate::BlockFailed& failure) {
        throw engine::Error("calibration", failure.what());
    }
    const std::vector<gate::GateTime>& times = session.run().times;
    std::vector<Sensitivity> found;
    for (const gate::GateTime& time : times) {
        if (time.calibration.size() < 2) continue;  // unknown in some process
        // A gate judges either by wall-clock time or by CPU time.
        const auto metrics = static_cast<std::size_t>(std::ranges::count(
            times, report::isOfProcessor(time.metric.id),
            [](const gate::GateTime& each) { return report::isOfProcessor(each.metric.id); }));
        const double tau = report::decisiveChange(session.run().rule.threshold, time.calibration);
        found.push_back(
            {.metric = time.metric.id,
             .decisive_change = tau,
             .smallest_slowdown = smallestSlowdown(time.calibration, tau, metrics),
             .differences = time.calibration});
    }
    return found;
}

namespace {

// ---- Gates with a planted slowdown --------------------------------------------------------------

constexpr double kMargin = 1.5;  // planted slowdown over the smallest detectable one

// Passes that can be slowed down on their own; others share render targets with these.
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

void useCalibration(gate::GateRun& run, const std::vector<Sensitivity>& sensitivities) {
    for (gate::GateTime& time : run.times)
        for (const Sensitivity& each : sensitivities)
            if (each.metric == time.metric.id) time.calibration = each.differences;
}

PlantedGate gateOf(
    const OwnGate& own, const PlantedWork& busy, const report::MetricId& metric,
    const std::vector<Sensitivity>& sensitivities) {
    gate::GateSession session(
        own.options(busySets(busy.pass, busy.work)),
        [&](const report::MetricId& each) { return report::isSameOfFrameOrPass(each, metric); });
    if (session.warmUp()) {
        useCalibration(session.run(), sensitivities);
        session.play();
    }
    if (!session.run().mismatches.empty())
        throw engine::Error(
            "planted slowdown", report::mismatchText(session.run().mismatches.front()));
    PlantedGate gate{.pass = busy.pass, .planted = busy.planted};
    for (const report::Change& change : session.run().changes) {
        if (change.comparison.verdict != report::Verdict::regressed) continue;
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
    } catch (const gate::BlockFailed& failure) {
        throw engine::Error("planted slowdown", failure.what());
    }
}

}  // namespace benchmarks::doctor
