#include "benchmarks/gate/blocks.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/verdict.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/run_tool.h"
#include "engine/system/child.h"
#include "engine/system/files.h"

namespace benchmarks::gate {

// ---- The rule -----------------------------------------------------------------------------------

namespace {

constexpr report::Comparison kNothingKnown{
    .verdict = report::Verdict::inconclusive,
    .change = std::numeric_limits<double>::quiet_NaN(),
    .lower = -1.0,  // a share: infinitely faster
    .upper = std::numeric_limits<double>::infinity(),
    .decisive_change = 0.0,
    .p = 1.0};

// The verdict on a change that is large in every pair; otherwise inconclusive.
report::Verdict verdictOnLarge(std::span<const double> differences, double decisive_change) {
    const double bound = std::log1p(std::max(report::kLargeChange, decisive_change));
    if (std::ranges::all_of(differences, [&](double each) { return each > bound; }))
        return report::Verdict::regressed;
    if (std::ranges::all_of(differences, [&](double each) { return each < -bound; }))
        return report::Verdict::improved;
    return report::Verdict::inconclusive;
}

}  // namespace

Gate::Gate(std::vector<GateMetric> metrics, const report::VerdictRule& rule, bool all)
    : metrics_(std::move(metrics)), rule_(rule), differences_(metrics_.size()),
      comparable_(metrics_.size(), 1), a_capped_(metrics_.size(), 1), b_capped_(metrics_.size(), 1),
      all_(all) {
    assert(std::ranges::count(report::kStages, rule_.first_pairs) == 1);
}

bool Gate::isStage(std::size_t pairs) const {
    return pairs >= rule_.first_pairs && std::ranges::count(report::kStages, pairs) > 0;
}

Gate::Step Gate::next() const {
    const bool a_first = pairs_ % 2 == 0;
    if (waiting_) return a_first ? Step::run_b : Step::run_a;
    if (decided_at_ > 0 && pairs_ == decided_at_) {
        if (pairs_ == *std::rbegin(report::kStages)) return Step::decided;
        bool open = false;
        bool regressed = false;
        for (std::size_t i = 0; i < decided_.size(); ++i) {
            if (!metrics_[i].decides) continue;
            const report::Verdict verdict = decided_[i].verdict;
            open |= comparable_[i] && verdict == report::Verdict::inconclusive;
            if (verdict != report::Verdict::regressed || isClockChange(i)) continue;
            // The cause of the change may not be known yet.
            const auto cycles = metrics_[i].cycles;
            const bool known = !cycles || !comparable_[*cycles] ||
                               decided_[*cycles].verdict != report::Verdict::inconclusive;
            regressed |= known;
            open |= !known;
        }
        if (!open || (regressed && !all_)) return Step::decided;
    }
    return a_first ? Step::run_a : Step::run_b;
}

void Gate::add(std::vector<double> medians, const std::vector<char>& capped) {
    const Step step = next();
    assert(step != Step::decided);
    if (medians.size() != metrics_.size())
        throw engine::Error("gate", "one process measured different metrics from the others");
    assert(capped.empty() || capped.size() == metrics_.size());
    std::vector<char>& always = step == Step::run_a ? a_capped_ : b_capped_;
    for (std::size_t i = 0; i < always.size(); ++i) always[i] &= !capped.empty() && capped[i];
    if (!waiting_) {
        waiting_ = std::move(medians);
        return;
    }
    if (step == Step::run_b)
        addPair(*waiting_, medians);
    else
        addPair(medians, *waiting_);
    waiting_.reset();
}

void Gate::addPair(const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < metrics_.size(); ++i) {
        const double difference = std::log(b[i] / a[i]);
        if (a[i] > 0.0 && std::isfinite(difference))
            differences_[i].push_back(difference);
        else
            comparable_[i] = 0;
    }
    ++pairs_;
    if (pairs_ == report::kEarlyStage && isStage(*std::begin(report::kStages))) passEarlyVerdicts();
    if (isStage(pairs_)) passVerdicts();
}

bool Gate::isClockChange(std::size_t metric) const {
    if (decided_.empty() || !metrics_[metric].cycles) return false;
    const report::Verdict time = decided_[metric].verdict;
    if (time == report::Verdict::regressed ? b_capped_[metric] : a_capped_[metric]) return false;
    return (time == report::Verdict::regressed || time == report::Verdict::improved) &&
           decided_[*metrics_[metric].cycles].verdict == report::Verdict::same;
}

void Gate::passEarlyVerdicts() {
    std::vector<report::Comparison> now = compareNow();
    bool any = false;
    for (std::size_t i = 0; i < now.size(); ++i) {
        now[i].verdict = comparable_[i] ? verdictOnLarge(differences_[i], now[i].decisive_change)
                                        : report::Verdict::inconclusive;
        if (now[i].verdict == report::Verdict::inconclusive) continue;
        now[i].pairs = pairs_;
        any = any || metrics_[i].decides;
    }
    if (!any) return;
    decided_ = std::move(now);
    decided_at_ = pairs_;
}

void Gate::passVerdicts() {
    std::vector<report::Comparison> now = compareNow();
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (!decided_.empty() && decided_[i].verdict != report::Verdict::inconclusive)
            now[i] = decided_[i];
        else
            now[i].pairs = pairs_;
    }
    decided_ = std::move(now);
    decided_at_ = pairs_;
}

std::size_t Gate::nextDecision() const {
    if (next() == Step::decided) return pairs_;
    for (const std::size_t stage : report::kStages)
        if (isStage(stage) && pairs_ < stage) return stage;
    return *std::rbegin(report::kStages);
}

std::vector<report::Comparison> Gate::comparisons() const {
    if (decided_at_ > 0) return decided_;
    std::vector<report::Comparison> known = compareNow();
    for (report::Comparison& each : known) each.verdict = report::Verdict::inconclusive;
    return known;
}

std::vector<report::Comparison> Gate::compareNow() const {
    std::vector<report::Comparison> comparisons(metrics_.size(), kNothingKnown);
    // Metrics that do not decide do not affect the level of the others.
    for (const bool decides : {true, false}) {
        std::vector<std::size_t> which;
        std::vector<std::vector<double>> differences;
        std::vector<double> decisive_changes;
        for (std::size_t i = 0; i < metrics_.size(); ++i) {
            if (metrics_[i].decides != decides) continue;
            const double decisive =
                report::decisiveChange(rule_.threshold, metrics_[i].calibration);
            comparisons[i].decisive_change = decisive;
            if (!comparable_[i] || pairs_ == 0) continue;
            which.push_back(i);
            differences.push_back(differences_[i]);
            decisive_changes.push_back(decisive);
        }
        const std::vector<report::Comparison> known =
            report::compare(differences, decisive_changes, rule_.alpha);
        for (std::size_t i = 0; i < which.size(); ++i) comparisons[which[i]] = known[i];
    }
    return comparisons;
}

// ---- Blocks of runs -----------------------------------------------------------------------------

namespace {

namespace fs = std::filesystem;

// ---- Report of a block --------------------------------------------------------------------------

BlockCase readCase(const scene::Json& result) {
    BlockCase read{.outcome = report::caseOutcome(result)};
    if (read.outcome.status != "ok") return read;
    read.metrics = report::readMetrics(result);
    const scene::Json reasons =
        result.value("/conditions/throttle_reasons"_json_pointer, scene::Json());
    read.capped = std::ranges::find(reasons, report::kPowerCap) != reasons.end();
    return read;
}

// Throws engine::Error if there is no report, or none of this kind.
BlockReport readBlock(const std::filesystem::path& path) {
    const scene::Json report = report::readReport(path);
    try {
        BlockReport block{
            .environment = scene::Document(report.at("environment")),
            .scene = scene::Document(scene::Json{
                {"path", report.at("scene").at("path")}, {"hash", report.at("scene").at("hash")}}),
            .software_device = report::isSoftwareDevice(report.at("environment"))};
        for (const scene::Json& each : report.at("cases")) block.cases.push_back(readCase(each));
        return block;
    } catch (const scene::Json::exception& error) {
        throw engine::Error(path.string(), scene::jsonReason(error));
    }
}

}  // namespace

const BlockCase* findCase(const BlockReport& block, const std::string& name) {
    const auto found = std::ranges::find(
        block.cases, name, [](const BlockCase& each) { return each.outcome.name; });
    return found == block.cases.end() ? nullptr : &*found;
}

std::vector<CommonMetric> commonMetrics(const BlockReport& a, const BlockReport& b) {
    std::vector<CommonMetric> common;
    for (const BlockCase& each : a.cases) {
        const BlockCase* const other = findCase(b, each.outcome.name);
        if (!other) continue;
        for (const report::MetricReading& metric : each.metrics)
            if (const report::MetricReading* const same =
                    report::findMetric(other->metrics, metric.id))
                common.push_back({each.outcome.name, &metric, same});
    }
    return common;
}

std::vector<report::Mismatch> mismatches(const BlockReport& a, const BlockReport& b) {
    std::vector<report::Mismatch> all;
    for (const BlockCase& each : a.cases) {
        const BlockCase* const other = findCase(b, each.outcome.name);
        if (!other) continue;
        const std::vector<report::Mismatch> found =
            report::mismatches(each.outcome, other->outcome);
        all.insert(all.end(), found.begin(), found.end());
    }
    return all;
}

namespace {

// ---- Command of a side --------------------------------------------------------------------------

bool isProgram(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

fs::path programOfBuild(const fs::path& folder, const std::string& context) {
    for (const char* each : {"benchmarks/hairbench", "bin/hairbench", "hairbench"})
        if (fs::path program = folder / each; isProgram(program += engine::system::kProgramEnding))
            return program;
    throw engine::Error(context, "holds no benchmarks/hairbench, bin/hairbench or hairbench");
}

// A file name without a slash would be searched in PATH.
std::string runnable(const fs::path& program) {
    return program.has_parent_path() ? program.string() : "./" + program.string();
}

// A shell command line that accepts arguments after its own.
std::vector<std::string> shellProgram(const std::string& text) {
    std::vector<std::string> command = engine::system::shellCommand(text + " \"$@\"");
    command.emplace_back("hairbench gate");
    return command;
}

void addRepeated(
    std::vector<std::string>& options, const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) options.insert(options.end(), {option, value});
}

// The user's options for the runs of this side.
std::vector<std::string> runOptions(char name, const GateOptions& options) {
    std::vector<std::string> all;
    const scene::SceneOptions& scene = options.scene;
    addRepeated(all, "--axis", scene.axes);
    addRepeated(all, "--set", scene.sets);
    addRepeated(all, "--set", name == 'A' ? options.a_sets : options.b_sets);
    if (!options.filter.empty()) addRepeated(all, "--filter", {options.filter});
    if (!scene.device.wanted.empty()) addRepeated(all, "--device", {scene.device.wanted});
    // Passed only if requested, because older programs do not know these options.
    if (!scene.cache) all.emplace_back("--no-cache");
    if (scene.outside == scene::Outside::allowed) all.emplace_back("--allow-outside");
    if (scene.frames) addRepeated(all, "--frames", {std::to_string(*scene.frames)});
    if (scene.warmup) addRepeated(all, "--warmup", {std::to_string(*scene.warmup)});
    if (scene.precision) addRepeated(all, "--precision", {scene::decimalText(*scene.precision)});
    if (scene.max_time) addRepeated(all, "--max-time", {scene::decimalText(*scene.max_time)});
    return all;
}

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char each : text) result += each == '\'' ? std::string("'\\''") : std::string{each};
    return result + "'";
}

void replaceAll(std::string& text, const std::string& what, const std::string& with) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
        text.replace(at, what.size(), with);
}

bool isPattern(const std::string& text) {
    return text.find("{out}") != std::string::npos || text.find("{scene}") != std::string::npos;
}

}  // namespace

Side parseSide(char name, const GateOptions& options) {
    Side side{.name = name, .text = name == 'A' ? options.a : options.b};
    const std::string context = (name == 'A' ? "--a " : "--b ") + side.text;
    if (side.text.empty()) throw engine::Error(context, "is empty");
    side.options = runOptions(name, options);
    if (isPattern(side.text)) {
        if (side.text.find("{out}") == std::string::npos)
            throw engine::Error(context, "has {scene} but no {out} for the report");
        if (!side.options.empty())
            throw engine::Error(
                context, "has {out} and is taken as it is: put '" + side.options.front() +
                             "' into the command itself");
        side.pattern = side.text;
        return side;
    }
    side.shaders = options.shaders;
    if (!options.scene.max_time && !options.shaders)
        addRepeated(
            side.options, "--max-time",
            {scene::decimalText(options.verdict.probes ? 0.0 : kBlockSeconds)});
    std::error_code ignored;
    if (fs::is_directory(side.text, ignored))
        side.program = {runnable(programOfBuild(side.text, context))};
    else if (isProgram(side.text))
        side.program = {runnable(side.text)};
    else
        side.program = shellProgram(side.text);
    return side;
}

std::vector<std::string>
blockCommand(const Side& side, const fs::path& scene, const fs::path& out, std::uint32_t seed) {
    if (!side.pattern.empty()) {
        std::string command = side.pattern;
        replaceAll(command, "{scene}", quoted(scene.string()));
        replaceAll(command, "{out}", quoted(out.string()));
        replaceAll(command, "{seed}", std::to_string(seed));
        return engine::system::shellCommand(command);
    }
    std::vector<std::string> command = side.program;
    command.insert(
        command.end(), {side.shaders ? "shaders" : "run", scene.string(), "--out", out.string()});
    if (!side.shaders)
        command.insert(command.end(), {"--no-pictures", "--order-seed", std::to_string(seed)});
    command.insert(command.end(), side.options.begin(), side.options.end());
    return command;
}

namespace {

// ---- Run of a block -----------------------------------------------------------------------------

constexpr std::size_t kMostLines = 12;  // shown lines of a failed process
constexpr std::size_t kMostBytes = 4000;

std::string lastLines(const std::filesystem::path& file) {
    std::string text;
    try {
        text = engine::readFile(file);
    } catch (const engine::Error&) {
        return {};  // it could not even be started
    }
    while (text.ends_with('\n')) text.pop_back();
    std::size_t begin = text.size();
    for (std::size_t line = 0; line < kMostLines && begin != std::string::npos && begin > 0; ++line)
        begin = text.rfind('\n', begin - 1);
    if (begin != std::string::npos && begin > 0) text.erase(0, begin + 1);
    if (text.size() > kMostBytes) text.erase(0, text.size() - kMostBytes);
    return text;
}

int exitStatusFor(int status) {
    const bool passes_on = status == report::kNoDevice || status == report::kUsageError ||
                           status == report::kNothingRan;
    return passes_on ? status : report::kInternalError;
}

// Runs also write a report if every case was skipped or failed.
bool wroteReport(const engine::ProgramEnd& end) {
    return !end.signaled && (end.status == report::kOk || end.status == report::kNothingRan);
}

std::string
failureText(const Side& side, const engine::ProgramEnd& end, const std::filesystem::path& log) {
    std::string text{side.name};
    text += " (" + side.text + ") ";
    text += end.signaled ? "was ended by signal " + std::to_string(end.status - 128)
                         : "ended with status " + std::to_string(end.status);
    if (end.status == 127 && !end.signaled) text += ": no such program";
    const std::string said = lastLines(log);
    return said.empty() ? text : text + ":\n" + said;
}

}  // namespace

void BlockRunner::play(const Side& side, std::uint32_t seed, const fs::path& report) {
    const fs::path folder = scratch_.path() / "block";
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    fs::remove(report, ignored);  // of an earlier process
    // It is in the block's folder, so that the leftovers of a killed run are removed with it.
    const fs::path temporary = folder / "temporary";
    fs::create_directories(temporary);
    const fs::path log = folder / "output.txt";
    const engine::ProgramEnd end =
        engine::runProgram(blockCommand(side, scene_, report, seed), log, temporary);
    if (!wroteReport(end))
        throw BlockFailed(failureText(side, end, log), exitStatusFor(end.status));
    if (fs::is_regular_file(report)) return;
    std::string text = std::string{side.name} + " (" + side.text + ") left no report";
    if (const std::string said = lastLines(log); !said.empty()) text += ":\n" + said;
    throw BlockFailed(text, end.status == report::kOk ? report::kUsageError : end.status);
}

BlockReport BlockRunner::run(const Side& side, std::uint32_t seed) {
    const fs::path report = scratch_.path() / "report.json";
    play(side, seed, report);
    try {
        return readBlock(report);
    } catch (const engine::Error& error) {
        std::string text = std::string{side.name} + " (" + side.text + ") left no report: ";
        text += error.what();
        throw BlockFailed(text, report::kUsageError);
    }
}

}  // namespace benchmarks::gate
