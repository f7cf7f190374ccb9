#include "benchmarks/gate/session.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/process.h"

namespace benchmarks::gate {
namespace {

// ---- Verdicts and differences of a run ----------------------------------------------------------

// The two blocks of a pair, in order.
struct PairOfBlocks {
    const BlockRecord* first;
    const BlockRecord* second;
};

std::vector<PairOfBlocks> completePairs(const GateRun& run, Phase phase) {
    std::vector<PairOfBlocks> pairs;
    const BlockRecord* waiting = nullptr;
    for (const BlockRecord& each : run.blocks) {
        if (each.phase != phase) continue;
        if (waiting) pairs.push_back({waiting, &each});
        waiting = waiting ? nullptr : &each;
    }
    return pairs;
}

double difference(const GateTime& time, double a, double b) {
    const double ratio = std::log(report::costOf(time.metric, b) / report::costOf(time.metric, a));
    return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

report::Verdict overallVerdict(const GateRun& run) {
    return run.mismatches.empty() ? report::overallVerdict(run.changes) : report::Verdict::mismatch;
}

int exitStatus(const GateRun& run, const report::VerdictOptions& options) {
    if (run.end == GateRun::End::interrupted && run.decided_at == 0) return report::kInterrupted;
    if (run.end == GateRun::End::failed) return run.failure_status;
    if (run.end == GateRun::End::out_of_time && run.decided_at == 0)
        return options.pass_without_verdicts ? report::kOk : report::kInconclusive;
    if (run.mismatches.empty() && run.changes.empty()) return report::kNothingRan;
    return report::verdictStatus(overallVerdict(run), options.fail_on_inconclusive);
}

std::vector<std::vector<double>> pairDifferences(const GateRun& run, Phase phase) {
    std::vector<std::vector<double>> differences(run.times.size());
    for (const PairOfBlocks& pair : completePairs(run, phase)) {
        const bool a_first =
            phase == Phase::calibration ? pair.first->pair % 2 == 0 : pair.first->side == 'A';
        const BlockRecord& a = a_first ? *pair.first : *pair.second;
        const BlockRecord& b = a_first ? *pair.second : *pair.first;
        for (std::size_t i = 0; i < run.times.size(); ++i)
            differences[i].push_back(difference(run.times[i], a.medians[i], b.medians[i]));
    }
    return differences;
}

namespace {

// ---- Warm-up, calibration, gate -----------------------------------------------------------------

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

// A metric is not comparable if it was timed differently in this process, for example if timestamps
// were not trusted in one process.
std::vector<double> mediansOf(const std::vector<GateTime>& times, const BlockReport& block) {
    std::vector<double> medians;
    for (const GateTime& time : times) {
        const BlockCase* const block_case = findCase(block, time.case_name);
        const report::MetricReading* const metric =
            block_case ? report::findMetric(block_case->metrics, time.metric.id) : nullptr;
        const bool comparable =
            metric && metric->unit == time.metric.unit && metric->isTimedAs(time.metric);
        medians.push_back(comparable ? metric->median : kNotMeasured);
    }
    return medians;
}

// Whether the power cap lowered the clock, for each time.
std::vector<char> cappedOf(const std::vector<GateTime>& times, const BlockReport& block) {
    std::vector<char> capped;
    for (const GateTime& time : times) {
        const BlockCase* const block_case = findCase(block, time.case_name);
        capped.push_back(block_case && block_case->capped);
    }
    return capped;
}

std::vector<double> costsOf(const std::vector<GateTime>& times, std::vector<double> medians) {
    for (std::size_t i = 0; i < times.size(); ++i)
        medians[i] = report::costOf(times[i].metric, medians[i]);
    return medians;
}

double medianOfBlocks(const GateRun& run, char side, std::size_t time) {
    std::vector<double> medians;
    for (const BlockRecord& each : run.blocks)
        if (each.phase == Phase::gate && each.side == side && std::isfinite(each.medians[time]))
            medians.push_back(each.medians[time]);
    return medians.empty() ? kNotMeasured : report::summarize(medians).median;
}

// Number of reruns of a block in which a case failed that had not failed before, for example
// because of heat or a lost device. A case that fails every time counts as a difference, which ends
// the gate.
constexpr int kMostRepeats = 2;

bool isLost(const BlockReport& first, const BlockReport& block) {
    return std::ranges::any_of(block.cases, [&](const BlockCase& each) {
        const BlockCase* const before = findCase(first, each.outcome.name);
        return each.outcome.status == "failed" && before && before->outcome.status == "ok";
    });
}

std::string pieceName(const char* phase, std::size_t pair, char side) {
    return std::string(phase) + " pair " + std::to_string(pair + 1) + ", " + side;
}

void addUnmatched(const BlockReport& block, const BlockReport& other, char side, GateRun& run) {
    for (const BlockCase& each : block.cases)
        if (!findCase(other, each.outcome.name))
            run.unmatched.push_back(std::string("only in ") + side + ": " + each.outcome.name);
}

}  // namespace

GateSession::GateSession(const GateOptions& options, report::MetricChoice judged)
    : max_minutes_(options.max_minutes), all_(options.all),
      smallest_share_(options.verdict.smallest_share), regex_(options.verdict.metrics),
      judged_(std::move(judged)), runner_(options.scene.scene), seed_(std::random_device()()) {
    run_.a = parseSide('A', options);
    run_.b = parseSide('B', options);
    run_.scene = options.scene.scene.string();
    run_.rule.threshold = options.verdict.threshold;
    run_.rule.first_pairs = options.pairs;
    if (!judged_)
        judged_ = report::metricsNamed(regex_);  // throws before anything runs if malformed
}

GateSession::~GateSession() {
    if (progress_) progress_->clear();
}

bool GateSession::warmUp() {
    progress_.emplace(2);
    for (const Side* const side : {&run_.a, &run_.b}) {
        progress_->begin(std::string("warm-up, ") + side->name);
        (side->name == 'A' ? run_.first_a : run_.first_b) = runner_.run(*side, seed_);
    }
    addUnmatched(*run_.first_a, *run_.first_b, 'A', run_);
    addUnmatched(*run_.first_b, *run_.first_a, 'B', run_);
    run_.mismatches = mismatches(*run_.first_a, *run_.first_b);
    chooseTimes();
    for (const Side* const side : {&run_.a, &run_.b})
        run_.blocks.push_back(
            {Phase::warm_up, side->name, 0, seed_,
             mediansOf(run_.times, side->name == 'A' ? *run_.first_a : *run_.first_b)});
    return run_.mismatches.empty() && !run_.times.empty();
}

namespace {

// Share of a pass in all passes of its case by the same clock; absent if it is not a pass.
std::optional<double> shareOf(const report::MetricReading& metric, const BlockCase& block_case) {
    if (metric.id.of != report::MetricOf::pass) return std::nullopt;
    double sum = 0.0;
    for (const report::MetricReading& each : block_case.metrics)
        if (each.id.of == report::MetricOf::pass && each.id.what == metric.id.what &&
            each.isTimedAs(metric))
            sum += each.median;
    return sum > 0.0 ? std::optional(metric.median / sum) : std::nullopt;
}

}  // namespace

void GateSession::chooseTimes() {
    const std::vector<CommonMetric> common = commonMetrics(*run_.first_a, *run_.first_b);
    std::vector<report::MetricId> metrics;
    for (const CommonMetric& each : common) metrics.push_back(each.a->id);
    const bool software = run_.first_a->software_device && run_.first_b->software_device;
    const report::MetricChoice judged = judged_ ? judged_ : report::usualMetrics(software, metrics);
    for (const CommonMetric& each : common) {
        const report::Judgement judgement = report::judgementOf(
            judged, *each.a, *each.b,
            software ? report::kShortestTime : report::kShortestTimestamped);
        if (judgement == report::Judgement::not_wanted) {
            report::addCodeChange(*each.a, *each.b, run_.code);
            continue;
        }
        GateTime time{.case_name = each.case_name, .metric = *each.a};
        for (const auto& [block, metric] :
             {std::pair(&*run_.first_a, each.a), std::pair(&*run_.first_b, each.b)})
            if (const auto share = shareOf(*metric, *findCase(*block, each.case_name)))
                time.share = std::max(*share, time.share.value_or(0.0));
        time.decides = !time.share || *time.share >= smallest_share_;
        (judgement == report::Judgement::judged ? run_.times : run_.too_short)
            .push_back(std::move(time));
    }
    addCycles(common);
    if (run_.times.empty() && run_.too_short.empty() && !regex_.empty() && !common.empty())
        throw engine::Error("--metrics", "'" + regex_ + "' matches no metric's name");
}

// For each judged time, adds the same in cycles if both sides have it.
void GateSession::addCycles(const std::vector<CommonMetric>& common) {
    const std::size_t times = run_.times.size();
    for (std::size_t i = 0; i < times; ++i) {
        report::MetricId wanted = run_.times[i].metric.id;
        if (wanted.what != report::Measured::time) continue;
        wanted.what = report::Measured::cycles;
        for (const CommonMetric& each : common) {
            if (each.case_name != run_.times[i].case_name || each.a->id != wanted) continue;
            run_.times[i].cycles = run_.times.size();
            run_.times.push_back(
                {.case_name = each.case_name, .metric = *each.a, .decides = false});
        }
    }
}

bool GateSession::block(const Side& side, Phase phase, std::size_t pair) {
    progress_->begin(
        pieceName(phase == Phase::calibration ? "calibration," : "gate,", pair, side.name));
    const auto seed = static_cast<std::uint32_t>(seed_ + pair);
    const BlockReport& first = side.name == 'A' ? *run_.first_a : *run_.first_b;
    const auto run = [&] {
        const std::chrono::duration<double, std::ratio<60>> passed =
            std::chrono::steady_clock::now() - start_;
        if (max_minutes_ > 0.0 && passed.count() >= max_minutes_) throw OutOfTime();
        return runner_.run(side, seed);
    };
    BlockReport report = run();
    for (int again = 0; again < kMostRepeats && isLost(first, report); ++again) {
        ++run_.repeated_blocks;
        report = run();
    }
    run_.mismatches = mismatches(first, report);
    if (!run_.mismatches.empty()) run_.unstable = side.name;
    run_.blocks.push_back(
        {phase, side.name, pair, seed, mediansOf(run_.times, report),
         cappedOf(run_.times, report)});
    return run_.mismatches.empty();
}

bool GateSession::calibrate(std::size_t pairs) {
    progress_.emplace(2 * pairs);
    for (std::size_t i = 0; i < 2 * pairs; ++i)
        if (!block(run_.a, Phase::calibration, i / 2)) return false;
    const std::vector<std::vector<double>> differences = pairDifferences(run_, Phase::calibration);
    for (std::size_t i = 0; i < differences.size(); ++i)
        std::ranges::copy_if(
            differences[i], std::back_inserter(run_.times[i].calibration),
            [](double each) { return std::isfinite(each); });
    return true;
}

bool GateSession::play() {
    std::vector<GateMetric> metrics;
    for (const GateTime& each : run_.times)
        metrics.push_back(
            {.calibration = each.calibration, .decides = each.decides, .cycles = each.cycles});
    Gate gate(std::move(metrics), run_.rule, all_);
    while (gate.next() != Gate::Step::decided) {
        const std::size_t decision = gate.nextDecision();
        progress_.emplace(2 * decision, 2 * gate.pairs());
        for (auto step = gate.next(); gate.pairs() < decision && step != Gate::Step::decided;
             step = gate.next()) {
            const Side& side = step == Gate::Step::run_a ? run_.a : run_.b;
            if (!block(side, Phase::gate, gate.pairs())) return false;
            const BlockRecord& block = run_.blocks.back();
            gate.add(costsOf(run_.times, block.medians), block.capped);
            judge(gate);
        }
    }
    return true;
}

void GateSession::judge(const Gate& gate) {
    run_.pairs = gate.pairs();
    run_.decided_at = gate.decidedAt();
    run_.changes.clear();
    if (run_.pairs == 0) return;
    const std::vector<report::Comparison> comparisons = gate.comparisons();
    for (std::size_t i = 0; i < run_.times.size(); ++i)
        run_.changes.push_back(
            {.case_name = run_.times[i].case_name,
             .metric = run_.times[i].metric.id,
             .unit = run_.times[i].metric.unit,
             .a = medianOfBlocks(run_, 'A', i),
             .b = medianOfBlocks(run_, 'B', i),
             .comparison = comparisons[i],
             .decides = run_.times[i].decides && !gate.isClockChange(i),
             .by_clock = gate.isClockChange(i)});
}

GateRun runGate(const GateOptions& options) {
    GateSession session(options);
    try {
        if (session.warmUp() &&
            (options.calibration == 0 || session.calibrate(options.calibration)))
            session.play();
    } catch (const engine::Interrupted&) {
        session.run().end = GateRun::End::interrupted;
    } catch (const OutOfTime&) {
        session.run().end = GateRun::End::out_of_time;
    } catch (const BlockFailed& failure) {
        session.run().end = GateRun::End::failed;
        session.run().failure = failure.what();
        session.run().failure_status = failure.exitStatus();
    }
    return std::move(session.run());
}

// ---- Its report ---------------------------------------------------------------------------------

namespace {

// ---- JSON ---------------------------------------------------------------------------------------

const char* phaseName(Phase phase) {
    switch (phase) {
    case Phase::warm_up:
        return "warm_up";
    case Phase::calibration:
        return "calibration";
    case Phase::gate:
        return "gate";
    }
    return "gate";
}

const char* endName(GateRun::End end) {
    switch (end) {
    case GateRun::End::decided:
        return "decided";
    case GateRun::End::interrupted:
        return "interrupted";
    case GateRun::End::out_of_time:
        return "out_of_time";
    case GateRun::End::failed:
        return "failed";
    }
    return "failed";
}

// Numbers that are not finite become null in lists, because omitting them would shift the others.
scene::Json numbers(const std::vector<double>& values) {
    scene::Json list = scene::Json::array();
    for (const double value : values)
        list.push_back(std::isfinite(value) ? scene::Json(value) : scene::Json());
    return list;
}

scene::Json outcomesJson(const BlockReport& block) {
    scene::Json list = scene::Json::array();
    for (const BlockCase& each : block.cases) {
        const report::CaseOutcome& outcome = each.outcome;
        scene::Json object = {{"name", outcome.name}, {"status", outcome.status}};
        if (!outcome.reason.empty()) object["reason"] = outcome.reason;
        if (!outcome.image_hash.empty()) object["image_hash"] = outcome.image_hash;
        if (!outcome.state_hash.empty()) object["state_hash"] = outcome.state_hash;
        list.push_back(std::move(object));
    }
    return list;
}

scene::Json
sideJson(const GateRun& run, const Side& side, const std::optional<BlockReport>& first) {
    scene::Json object = {{"given", side.text}};
    object["command"] = blockCommand(side, run.scene, "{out}", 0);
    if (first) {
        object["environment"] = first->environment.json();
        object["scene"] = first->scene.json();
        object["cases"] = outcomesJson(*first);
    }
    return object;
}

scene::Json timesJson(const GateRun& run) {
    const std::vector<std::vector<double>> differences = pairDifferences(run, Phase::gate);
    scene::Json list = scene::Json::array();
    for (std::size_t i = 0; i < run.times.size(); ++i) {
        const GateTime& time = run.times[i];
        scene::Json object = {
            {"case", time.case_name},
            {"metric", time.metric.name()},
            {"unit", time.metric.unit},
            {"hint", report::betterName(time.metric.better)}};
        if (time.metric.mode != report::Mode::none)
            object["mode"] = report::modeName(time.metric.mode);
        if (time.share) object["share"] = *time.share;
        if (!time.decides) object["decides"] = false;
        if (!time.calibration.empty()) object["calibration"] = time.calibration;
        object["differences"] = numbers(differences[i]);
        list.push_back(std::move(object));
    }
    return list;
}

scene::Json blocksJson(const GateRun& run) {
    scene::Json list = scene::Json::array();
    for (const BlockRecord& each : run.blocks) {
        list.push_back(
            {{"phase", phaseName(each.phase)},
             {"side", std::string{each.side}},
             {"pair", each.pair},
             {"order_seed", each.seed},
             {"medians", numbers(each.medians)}});
        if (std::ranges::count(each.capped, 0) < std::ssize(each.capped))
            list.back()["capped"] = std::vector<bool>(each.capped.begin(), each.capped.end());
    }
    return list;
}

}  // namespace

scene::Json gateReport(
    const GateRun& run, const report::VerdictOptions& options,
    const std::vector<std::string>& command) {
    scene::Json object = {{"schema", kGateSchema}, {"command", command}, {"scene", run.scene}};
    object["end"] = endName(run.end);
    if (!run.failure.empty()) object["failure"] = run.failure;
    const bool known = run.end == GateRun::End::decided || run.decided_at > 0;
    object["verdict"] =
        report::verdictName(known ? overallVerdict(run) : report::Verdict::inconclusive);
    if (run.decided_at > 0) object["decided_at"] = run.decided_at;
    object["exit_status"] = exitStatus(run, options);
    object["a"] = sideJson(run, run.a, run.first_a);
    object["b"] = sideJson(run, run.b, run.first_b);
    object["rule"] = {
        {"threshold", run.rule.threshold},
        {"alpha", run.rule.alpha},
        {"smallest_share", options.smallest_share},
        {"decisions", scene::Json::array()}};
    if (run.rule.first_pairs == *std::begin(report::kStages)) {
        object["rule"]["large_change"] = report::kLargeChange;
        object["rule"]["decisions"].push_back(report::kEarlyStage);
    }
    for (const std::size_t stage : report::kStages)
        if (stage >= run.rule.first_pairs) object["rule"]["decisions"].push_back(stage);
    object["pairs"] = run.pairs;
    if (run.repeated_blocks > 0) object["repeated_blocks"] = run.repeated_blocks;
    object["unmatched"] = run.unmatched;
    object["times"] = timesJson(run);
    scene::Json& too_short = object["too_short"] = scene::Json::array();
    for (const GateTime& each : run.too_short)
        too_short.push_back({{"case", each.case_name}, {"metric", each.metric.name()}});
    object["code"] = report::codeChangesJson(run.code);
    object["blocks"] = blocksJson(run);
    scene::Json& differing = object["mismatches"] = scene::Json::array();
    for (const report::Mismatch& each : run.mismatches)
        differing.push_back(report::mismatchJson(each));
    if (run.unstable != 0) object["unstable_side"] = std::string{run.unstable};
    scene::Json& changes = object["changes"] = scene::Json::array();
    for (const report::Change& each : run.changes) changes.push_back(report::changeJson(each));
    return object;
}

namespace {

// ---- Text for a terminal ------------------------------------------------------------------------

// "build/old, hairbench 0.1.0 (1a2b3c4)"
std::string sideText(const Side& side, const std::optional<BlockReport>& first) {
    std::string text = std::string{side.name} + ": " + side.text;
    if (!first) return text + '\n';
    const scene::Json& environment = first->environment.json();
    if (const auto build = environment.find("build"); build != environment.end()) {
        text += ", hairbench " + build->value("version", "");
        if (const std::string commit = build->value("commit", ""); !commit.empty())
            text += " (" + commit + ')';
    }
    return text + '\n';
}

// Omits what two builds on one machine share. From the scenes, only cases and results count.
std::string differencesText(const GateRun& run) {
    if (!run.first_a || !run.first_b) return {};
    std::string text;
    const scene::Json a = {{"environment", run.first_a->environment.json()}};
    const scene::Json b = {{"environment", run.first_b->environment.json()}};
    for (const std::string& each : report::environmentDifferences(a, b))
        text += "warning: " + each + '\n';
    return text;
}

std::string mismatchesText(const GateRun& run) {
    if (run.mismatches.empty()) return {};
    std::string text;
    if (run.unstable != 0)
        text += std::string("The runs of ") + run.unstable + " differ among themselves.\n";
    for (const report::Mismatch& each : run.mismatches) text += report::mismatchText(each) + '\n';
    return text + "mismatch: times of different work can't be compared\n";
}

report::ShowCases showCases(const GateRun& run) {
    std::set<std::string> names;
    for (const GateTime& each : run.times) names.insert(each.case_name);
    return names.size() > 1 ? report::ShowCases::yes : report::ShowCases::no;
}

std::string tooShortText(const GateRun& run) {
    if (run.too_short.empty()) return {};
    const bool software = run.first_a->software_device && run.first_b->software_device;
    std::string text =
        "shorter than " +
        report::plainNumber(software ? report::kShortestTime : report::kShortestTimestamped) +
        " ms, not judged:";
    std::set<std::string> names;
    for (const GateTime& each : run.too_short) names.insert(each.metric.name());
    for (const std::string& name : names) text += ' ' + name;
    return text + '\n';
}

std::string incomparableText(const GateRun& run) {
    std::string text;
    for (const report::Change& each : run.changes)
        if (!std::isfinite(each.comparison.change)) text += ' ' + each.metric.name();
    return text.empty() ? text : "missing, or timed in another way, in some process:" + text + '\n';
}

std::string calibrationText(const GateRun& run) {
    if (run.times.empty() || run.times.front().calibration.empty()) return {};
    return " after " + std::to_string(run.times.front().calibration.size()) + " of A with itself";
}

}  // namespace

std::string gateText(const GateRun& run) {
    std::string text = sideText(run.a, run.first_a) + sideText(run.b, run.first_b);
    text += differencesText(run);
    for (const std::string& each : run.unmatched) text += each + '\n';
    if (!run.mismatches.empty()) return text + mismatchesText(run);
    if (run.changes.empty()) return text;
    text += run.scene + ", " + std::to_string(run.pairs) + (run.pairs == 1 ? " pair" : " pairs") +
            calibrationText(run) + "\n\n";
    text += report::changesTable(run.changes, showCases(run)) + tooShortText(run) +
            incomparableText(run) + report::codeChangesText(run.code) + '\n';
    if (run.end != GateRun::End::decided)
        text += run.decided_at > 0 ? "stopped; the verdicts are those passed at " +
                                         std::to_string(run.decided_at) + " pairs\n"
                                   : std::string("stopped before the first verdict\n");
    return text + report::verdictCounts(run.changes) + '\n';
}

}  // namespace benchmarks::gate
