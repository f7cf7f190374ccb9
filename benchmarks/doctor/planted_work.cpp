#include "benchmarks/doctor/planted_work.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/gate/gate_session.h"
#include "benchmarks/statistics.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

constexpr std::uint32_t kFirstWork = 64;
constexpr std::uint32_t kMostWork = 1u << 28;
constexpr std::uint32_t kGrowth = 8;
constexpr std::size_t kRoughPairs = 3;
constexpr std::size_t kPairs = 12;
// What is measured to find the scale: well above the noise of any machine.
constexpr double kPlain = 1.0;

// The share that the work adds to the metric, the median over pairs of processes.
double
measureShare(const OwnGate& own, const MetricId& metric, std::uint32_t work, std::size_t pairs) {
    const GateOptions options = own.options(busySets(metric.pass(), work));
    BlockRunner runner(options.scene.scene);
    const Side plain = parseSide('A', options);
    const Side busy = parseSide('B', options);
    const auto medianOf = [&](const Side& side) {
        const BlockReport block = runner.run(side, 0);
        const MetricReading* const reading =
            block.cases.empty() ? nullptr : findMetric(block.cases.front().metrics, metric);
        if (!reading) throw engine::Error("planted slowdown", metric.name() + " was not measured");
        return reading->median;
    };
    std::vector<double> ratios;
    for (std::size_t i = 0; i < pairs; ++i) {
        const double first = medianOf(i % 2 == 0 ? plain : busy);
        const double second = medianOf(i % 2 == 0 ? busy : plain);
        ratios.push_back(i % 2 == 0 ? second / first : first / second);
    }
    return summarize(ratios).median - 1.0;
}

std::uint32_t clampedWork(double work) {
    return static_cast<std::uint32_t>(std::clamp(work, 1.0, double{kMostWork}));
}

}  // namespace

std::vector<std::string> busySets(const std::string& pass, std::uint32_t work) {
    return {"/run/busy_pass=" + pass, "/run/busy_work=" + std::to_string(work)};
}

PlantedWork findBusyWork(const OwnGate& own, const MetricId& metric, double share) {
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
    // It is proportional but for what starting it costs, so near the end a second estimate is
    // needed.
    PlantedWork busy{.pass = metric.pass(), .work = clampedWork(work * share / found)};
    const double near = measureShare(own, metric, busy.work, kPairs);
    const double slope =
        (found - near) / (static_cast<double>(work) - static_cast<double>(busy.work));
    if (slope > 0.0) busy.work = clampedWork(busy.work + (share - near) / slope);
    busy.planted = measureShare(own, metric, busy.work, kPairs);
    return busy;
}

}  // namespace benchmarks
