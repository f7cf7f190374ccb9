#include "benchmarks/doctor/reports.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/doctor/facts.h"
#include "benchmarks/gate/session.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/process.h"
#include "engine/system/files.h"

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

OwnGate::OwnGate(const engine::DeviceOptions& device)
    : device_(device), scene_(writeDoctorScene(folder_.path())) {}

gate::GateOptions OwnGate::options(std::vector<std::string> b_sets) const {
    gate::GateOptions options;
    options.a = options.b = engine::system::thisProgramAsStarted();
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

// ---- The report ---------------------------------------------------------------------------------

namespace {

// ---- JSON ---------------------------------------------------------------------------------------

scene::Json toJson(const Finding& finding) {
    scene::Json object = {
        {"check", finding.check}, {"verdict", healthName(finding.health)}, {"seen", finding.seen}};
    if (!finding.advice.empty()) object["advice"] = finding.advice;
    return object;
}

scene::Json toJson(const Sensitivity& each) {
    scene::Json object = {{"metric", each.metric.name()}};
    if (std::isfinite(each.decisive_change)) object["decisive_change"] = each.decisive_change;
    if (std::isfinite(each.smallest_slowdown)) object["smallest_slowdown"] = each.smallest_slowdown;
    return object;
}

scene::Json toJson(const PlantedGate& gate) {
    scene::Json object = {
        {"pass", gate.pass}, {"found", gate.found}, {"elsewhere", gate.elsewhere}};
    if (std::isfinite(gate.planted)) object["planted"] = gate.planted;
    return object;
}

template <class Thing>
scene::Json listOf(const std::vector<Thing>& things) {
    scene::Json list = scene::Json::array();
    for (const Thing& thing : things) list.push_back(toJson(thing));
    return list;
}

}  // namespace

Finding judgePlanted(const std::vector<PlantedGate>& gates) {
    const auto found = std::ranges::count(gates, true, &PlantedGate::found);
    const auto elsewhere = std::ranges::count(gates, true, &PlantedGate::elsewhere);
    const auto all = static_cast<std::ptrdiff_t>(gates.size());
    Finding finding{
        "planted slowdowns",
        Health::ok,
        std::to_string(found) + " of " + std::to_string(all) + " found in their pass, " +
            std::to_string(elsewhere) + " in another one too",
        {}};
    if (found == all && elsewhere == 0) return finding;
    finding.health = Health::bad;
    finding.advice = "gates on this machine miss slowdowns or name the wrong pass: fix the other "
                     "findings, and repeat";
    return finding;
}

bool isTrusted(const DoctorReport& report) {
    return std::ranges::find(report.findings, Health::bad, &Finding::health) ==
           report.findings.end();
}

std::string doctorReportText(const DoctorReport& report) {
    scene::Json object = scene::Json::object();
    object["schema"] = kDoctorSchema;
    object["environment"] = report::environmentJson(report.environment);
    object["trusted"] = isTrusted(report);
    object["interrupted"] = report.interrupted;
    object["findings"] = listOf(report.findings);
    if (!report.sensitivities.empty()) object["sensitivities"] = listOf(report.sensitivities);
    if (!report.planted.empty()) object["planted"] = listOf(report.planted);
    // Output of drivers and commands need not be UTF-8.
    return object.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

namespace {

// ---- Text for a terminal ------------------------------------------------------------------------

std::string tableOf(const std::vector<report::Column>& columns, std::size_t rows) {
    std::string text;
    for (std::size_t row = 0; row <= rows; ++row) text += report::columnsLine(columns, row);
    return text;
}

std::string shareCell(double share) {
    return std::isfinite(share) ? report::shareText(share) : "-";
}

std::string findingsTable(const std::vector<Finding>& findings) {
    std::vector<report::Column> columns{{"check", false}, {"verdict", false}, {"seen", false}};
    for (const Finding& finding : findings) {
        columns[0].cells.push_back(finding.check);
        columns[1].cells.emplace_back(healthName(finding.health));
        columns[2].cells.push_back(finding.seen);
    }
    return tableOf(columns, findings.size());
}

std::string sensitivityTable(const std::vector<Sensitivity>& sensitivities) {
    std::vector<report::Column> columns{
        {"metric", false}, {"changes count from"}, {"48 pairs find"}};
    for (const Sensitivity& each : sensitivities) {
        columns[0].cells.push_back(each.metric.name());
        columns[1].cells.push_back(shareCell(each.decisive_change));
        columns[2].cells.push_back(shareCell(each.smallest_slowdown));
    }
    return tableOf(columns, sensitivities.size());
}

std::string plantedTable(const std::vector<PlantedGate>& gates) {
    std::vector<report::Column> columns{{"planted in", false}, {"slower by"}, {"found", false}};
    for (const PlantedGate& gate : gates) {
        columns[0].cells.push_back(gate.pass);
        columns[1].cells.push_back(shareCell(gate.planted));
        columns[2].cells.emplace_back(
            std::string(gate.found ? "yes" : "no") +
            (gate.elsewhere ? ", and in another pass" : ""));
    }
    return tableOf(columns, gates.size());
}

// Lists bad findings first.
std::string toFix(const std::vector<Finding>& findings) {
    std::string text;
    for (const Health health : {Health::bad, Health::warn, Health::unknown})
        for (const Finding& finding : findings)
            if (finding.health == health && !finding.advice.empty())
                text += "  " + finding.check + ": " + finding.advice + '\n';
    return text.empty() ? text : "\nwhat to fix:\n" + text;
}

std::string conclusion(const DoctorReport& report) {
    const auto bad = std::ranges::count(report.findings, Health::bad, &Finding::health);
    const auto warned = std::ranges::count(report.findings, Health::warn, &Finding::health);
    if (bad > 0)
        return "timings can't be trusted: " + std::to_string(bad) +
               (bad == 1 ? " check is bad\n" : " checks are bad\n");
    if (warned > 0)
        return "timings can be used with care: " + std::to_string(warned) +
               (warned == 1 ? " warning\n" : " warnings\n");
    return "timings can be trusted\n";
}

}  // namespace

std::string doctorText(const DoctorReport& report) {
    std::string text = findingsTable(report.findings);
    if (!report.sensitivities.empty())
        text += "\nslowdowns that a gate can find here:\n" + sensitivityTable(report.sensitivities);
    if (!report.planted.empty()) text += '\n' + plantedTable(report.planted);
    return text + toFix(report.findings) + '\n' + conclusion(report);
}

}  // namespace benchmarks::doctor
