#include "benchmarks/report/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "benchmarks/report/table.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/scene/pattern.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::report {
namespace {

// ---- What differs between machines and builds ---------------------------------------------------

struct Place {
    const char* name;
    const char* pointer;
};

constexpr Place kPlaces[] = {
    {"device", "/environment/device/name"},
    {"kind of device", "/environment/device/type"},
    {"board", "/environment/device/board"},
    {"PCI address", "/environment/device/pci_address"},
    {"board's power limit in W", "/environment/device/power_limit_w"},
    {"driver", "/environment/device/driver"},
    {"driver's version", "/environment/device/driver_version"},
    {"processor", "/environment/host/processor"},
    {"number of processors", "/environment/host/processor_count"},
    {"build type", "/environment/build/type"},
    {"scene", "/scene/hash"},
};

bool isTrue(const scene::Json& report, const char* pointer) {
    return scene::textAt(report, pointer) == "true";
}

// Compares the device's name and type only; its driver may have changed.
bool isSameDevice(const scene::Json& a, const scene::Json& b) {
    for (const char* const pointer : {"/environment/device/name", "/environment/device/type"})
        if (scene::textAt(a, pointer) != scene::textAt(b, pointer)) return false;
    return true;
}

}  // namespace

std::vector<std::string> environmentDifferences(const scene::Json& a, const scene::Json& b) {
    std::vector<std::string> differences;
    for (const Place& place : kPlaces) {
        const std::string of_a = scene::textAt(a, place.pointer);
        const std::string of_b = scene::textAt(b, place.pointer);
        if (!of_a.empty() && !of_b.empty() && of_a != of_b)
            differences.push_back(std::string(place.name) + ": " + of_a + " and " + of_b);
    }
    for (const auto& [report, name] : {std::pair{&a, "A"}, std::pair{&b, "B"}}) {
        if (isTrue(*report, "/environment/validation"))
            differences.push_back(std::string(name) + " ran under the validation layer");
        if (isTrue(*report, "/interrupted"))
            differences.push_back(std::string(name) + " was interrupted: some cases are missing");
    }
    return differences;
}

// ---- Metrics that are judged --------------------------------------------------------------------

Clock judgedClock(bool software_device, std::span<const MetricId> metrics) {
    return software_device && std::ranges::any_of(metrics, isOfProcessor) ? Clock::processor
                                                                          : Clock::wall;
}

MetricChoice metricsNamed(const std::string& regex) {
    if (regex.empty()) return {};
    try {
        return
            [wanted = scene::Pattern(regex)](const MetricId& id) { return wanted.isIn(id.name()); };
    } catch (const engine::Error& error) {
        throw engine::Error("--metrics", regex + ": " + error.what());
    }
}

MetricChoice usualMetrics(bool software_device, std::span<const MetricId> metrics) {
    if (std::ranges::none_of(metrics, isFrameOrPassCost))
        return [](const MetricId& id) { return id.of == MetricOf::shader; };
    const bool by_processor = judgedClock(software_device, metrics) == Clock::processor;
    return by_processor ? isOfProcessor : isFrameOrPassTime;
}

Judgement judgementOf(
    const MetricChoice& chosen, const MetricReading& a, const MetricReading& b, double shortest) {
    const bool judgeable = a.better != Better::neither || isProbe(a.id);
    if (!chosen(a.id) || !judgeable || a.unit != b.unit) return Judgement::not_wanted;
    if (a.unit == "ms" && std::max(a.median, b.median) < shortest) return Judgement::too_short;
    return Judgement::judged;
}

double costOf(const Metric& metric, double value) {
    return metric.better == Better::higher ? 1.0 / value : value;
}

namespace {

// ---- Mismatches of cases ------------------------------------------------------------------------

std::string statusText(const CaseOutcome& outcome) {
    return outcome.reason.empty() ? outcome.status : outcome.status + ": " + outcome.reason;
}

bool differ(const std::string& a, const std::string& b) {
    return !a.empty() && !b.empty() && a != b;
}

}  // namespace

CaseOutcome caseOutcome(const scene::Json& result) {
    return {
        .name = result.at("name").get<std::string>(),
        .status = result.at("status").get<std::string>(),
        .reason = result.value("reason", ""),
        .image_hash = result.value("image_hash", ""),
        .state_hash = result.value("state_hash", "")};
}

std::vector<Mismatch> mismatches(const CaseOutcome& a, const CaseOutcome& b) {
    const bool a_ok = a.status == "ok";
    const bool b_ok = b.status == "ok";
    if (!a_ok && !b_ok) return {};
    if (a_ok != b_ok) return {{a.name, "status", statusText(a), statusText(b)}};
    std::vector<Mismatch> found;
    if (differ(a.image_hash, b.image_hash))
        found.push_back({a.name, "picture", a.image_hash, b.image_hash});
    if (differ(a.state_hash, b.state_hash))
        found.push_back({a.name, "state", a.state_hash, b.state_hash});
    return found;
}

std::string mismatchText(const Mismatch& mismatch) {
    const std::string plural = mismatch.what == "status" ? "outcomes" : mismatch.what + 's';
    return mismatch.case_name + ": the " + plural + " differ: " + mismatch.a + " and " + mismatch.b;
}

scene::Json mismatchJson(const Mismatch& mismatch) {
    return {
        {"case", mismatch.case_name},
        {"what", mismatch.what},
        {"a", mismatch.a},
        {"b", mismatch.b}};
}

// ---- Compiled code ------------------------------------------------------------------------------

void addCodeChange(
    const MetricReading& a, const MetricReading& b, std::vector<CodeChange>& changes) {
    if (a.id.of != MetricOf::shader || a.median == b.median) return;
    const auto found = std::ranges::find_if(changes, [&](const CodeChange& each) {
        return each.metric == a.id && each.a == a.median && each.b == b.median;
    });
    if (found == changes.end())
        changes.push_back({.metric = a.id, .unit = a.unit, .a = a.median, .b = b.median});
    else
        ++found->cases;
}

std::string codeChangesText(std::span<const CodeChange> changes) {
    if (changes.empty()) return {};
    std::vector<Column> columns{
        {"compiled shader", false}, {"figure", false}, {"A"}, {"B"}, {"cases"}};
    for (const CodeChange& each : changes) {
        const std::string name = each.metric.name();
        const std::string figure = name.substr(name.rfind('.') + 1);
        const std::string cells[] = {
            each.metric.part, figure + (each.unit == "1" ? "" : ", " + each.unit),
            plainNumber(each.a), plainNumber(each.b), std::to_string(each.cases)};
        for (std::size_t i = 0; i < columns.size(); ++i) columns[i].cells.push_back(cells[i]);
    }
    return "\nchanged code of shaders, which may explain times and decides nothing:\n" +
           columnsText(columns);
}

scene::Json codeChangesJson(std::span<const CodeChange> changes) {
    scene::Json array = scene::Json::array();
    for (const CodeChange& each : changes)
        array.push_back(
            {{"metric", each.metric.name()},
             {"unit", each.unit},
             {"a", each.a},
             {"b", each.b},
             {"cases", each.cases}});
    return array;
}

namespace {

// ---- Two reports --------------------------------------------------------------------------------

constexpr double kLevel = VerdictRule{}.alpha;

const scene::Json* findCase(const scene::Json& report, const std::string& name) {
    for (const scene::Json& each : report.at("cases"))
        if (each.at("name").get_ref<const std::string&>() == name) return &each;
    return nullptr;
}

std::vector<double> costs(const MetricReading& metric) {
    if (metric.samples.empty())
        throw engine::Error(
            "the reports can't be compared", metric.name() + "  has no samples in one of them");
    std::vector<double> values;
    for (const double sample : metric.samples) values.push_back(costOf(metric, sample));
    return values;
}

MetricChoice probesAmong(MetricChoice chosen) {
    return [chosen = std::move(chosen)](const MetricId& id) {
        return isProbe(id) && (!chosen || chosen(id));
    };
}

// The largest absolute value of a probe. Components of a vector share that of the whole vector.
double scaleOf(const MetricReading& probe, std::span<const MetricReading> all) {
    double scale = 0.0;
    for (const MetricReading& each : all)
        if (each.id == probe.id || (isProbe(each.id) && probe.id.what == Measured::momentum &&
                                    each.id.what == probe.id.what))
            for (const double sample : each.samples) scale = std::max(scale, std::abs(sample));
    return scale;
}

// The frame in which two series of a probe differ most: the first in which one is not a number, if
// there is one. Throws if they have unequal numbers of frames.
std::size_t farthestApart(const MetricReading& a, const MetricReading& b) {
    if (a.samples.size() != b.samples.size() || a.samples.empty())
        throw engine::Error(
            "the reports can't be compared", a.name() + " has " + std::to_string(a.samples.size()) +
                                                 " frames in A and " +
                                                 std::to_string(b.samples.size()) + " in B");
    std::size_t farthest = 0;
    const auto apart = [&](std::size_t i) { return std::abs(b.samples[i] - a.samples[i]); };
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
        if (!std::isfinite(apart(i))) return i;
        if (apart(i) > apart(farthest)) farthest = i;
    }
    return farthest;
}

// Counts of bytes and figures of compiled code are the same in each run of a build.
bool isExact(const MetricReading& reading) {
    return reading.unit == "B" || reading.id.of == MetricOf::shader;
}

// A difference as a share of a value. Anything is infinitely more than none.
double changeOf(double difference, double value) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    if (value > 0.0) return difference / value;
    return difference > 0.0 ? kInfinite : difference < 0.0 ? -kInfinite : 0.0;
}

// Compares costs without noise.
Comparison exactComparison(double a, double b, double decisive_change) {
    const double change = changeOf(b - a, a);
    const bool outside = std::abs(std::log1p(change)) > std::log1p(decisive_change);
    return {
        .verdict = Verdict::inconclusive,
        .change = change,
        .lower = change,
        .upper = change,
        .decisive_change = decisive_change,
        .p = outside ? 0.0 : 1.0};
}

MetricChoice choiceFor(const scene::Json& a, const scene::Json& b) {
    std::vector<MetricId> metrics;
    for (const scene::Json& each : a.at("cases")) {
        const scene::Json* const other = findCase(b, each.at("name"));
        if (!other || !each.contains("metrics") || !other->contains("metrics")) continue;
        for (const auto& [name, metric] : each.at("metrics").items())
            if (other->at("metrics").contains(name)) metrics.push_back(metricNamed(name));
    }
    return usualMetrics(
        isSoftwareDevice(a.at("environment")) && isSoftwareDevice(b.at("environment")), metrics);
}

class Comparer {
public:
    Comparer(const scene::Json& a, const scene::Json& b, const VerdictOptions& options)
        : options_(options), judged_(metricsNamed(options.metrics)) {
        if (options.probes) judged_ = probesAmong(std::move(judged_));
        if (!judged_) judged_ = choiceFor(a, b);
        const bool software =
            isSoftwareDevice(a.at("environment")) || isSoftwareDevice(b.at("environment"));
        shortest_ = software ? kShortestTime : kShortestTimestamped;
    }

    void addCase(const scene::Json& a, const scene::Json& b) {
        ++found_.common_cases;
        std::vector<Mismatch> differing = mismatches(caseOutcome(a), caseOutcome(b));
        if (options_.probes)
            std::erase_if(differing, [](const Mismatch& each) { return each.what != "status"; });
        found_.mismatches.insert(found_.mismatches.end(), differing.begin(), differing.end());
        if (!differing.empty() || a.at("status") != "ok") return;
        const std::string name = a.at("name");
        const std::vector<MetricReading> metrics_of_b = readMetrics(b);
        const std::vector<MetricReading> metrics_of_a = readMetrics(a);
        for (const MetricReading& of_a : metrics_of_a)
            if (const MetricReading* const of_b = findMetric(metrics_of_b, of_a.id))
                addMetric(name, of_a, *of_b, metrics_of_a);
        if (options_.probes) addMissingProbes(name, metrics_of_a, metrics_of_b);
        countPassesOf("A", metrics_of_a, metrics_of_b);
        countPassesOf("B", metrics_of_b, metrics_of_a);
    }

    ReportComparison finish() && {
        std::vector<Comparison> comparisons;
        for (const Change& each : found_.changes) comparisons.push_back(each.comparison);
        passVerdicts(comparisons, kLevel);
        for (std::size_t i = 0; i < comparisons.size(); ++i) {
            found_.changes[i].comparison = comparisons[i];
            if (const auto found = probes_.find(i); found != probes_.end())
                found_.changes[i].comparison.verdict = found->second;
        }
        for (const auto& [metric, cases] : only_)
            found_.unmatched.push_back(
                "only in " + metric + ", of " + std::to_string(cases) +
                (cases == 1 ? " case" : " cases"));
        return std::move(found_);
    }

    ReportComparison& found() { return found_; }

private:
    // Passes differ between versions: a pass of one version may be part of another pass in the
    // next.
    void countPassesOf(
        const char* which, const std::vector<MetricReading>& metrics,
        const std::vector<MetricReading>& others) {
        for (const MetricReading& each : metrics)
            if (each.id.of == MetricOf::pass && !findMetric(others, each.id) &&
                judgementOf(judged_, each, each, 0.0) != Judgement::not_wanted)
                ++only_[std::string(which) + ": " + each.name()];
    }

    // A probe that only one report has had no finite value in the other, or was not asked for
    // there.
    void addMissingProbes(
        const std::string& case_name, const std::vector<MetricReading>& metrics_of_a,
        const std::vector<MetricReading>& metrics_of_b) {
        for (const MetricReading& each : metrics_of_a)
            if (judged_(each.id) && !findMetric(metrics_of_b, each.id))
                found_.mismatches.push_back({case_name, "probe", each.name(), "none"});
        for (const MetricReading& each : metrics_of_b)
            if (judged_(each.id) && !findMetric(metrics_of_a, each.id))
                found_.mismatches.push_back({case_name, "probe", "none", each.name()});
    }

    // The change of a probe is the largest difference between frames of the same number, as a share
    // of its largest value in A.
    void addProbe(Change change, const MetricReading& a, const MetricReading& b, double scale) {
        const std::size_t frame = farthestApart(a, b);
        change.a = a.samples[frame];
        change.b = b.samples[frame];
        const double difference = change.b - change.a;
        const bool is_number = std::isfinite(difference);
        const double share = is_number ? changeOf(difference, scale) : difference;
        const bool counts = !is_number || std::abs(share) > options_.threshold;
        change.comparison = {
            .verdict = Verdict::inconclusive,
            .change = share,
            .lower = share,
            .upper = share,
            .decisive_change = options_.threshold,
            .p = counts ? 0.0 : 1.0};
        // Hair that moves otherwise is neither better nor worse.
        const Verdict verdict = a.better == Better::neither || !is_number ? Verdict::mismatch
                                : share > 0.0                             ? Verdict::regressed
                                                                          : Verdict::improved;
        probes_[found_.changes.size()] = counts ? verdict : Verdict::same;
        found_.changes.push_back(std::move(change));
    }

    void addMetric(
        const std::string& case_name, const MetricReading& a, const MetricReading& b,
        std::span<const MetricReading> all_of_a) {
        const Judgement judgement = judgementOf(judged_, a, b, shortest_);
        if (judgement == Judgement::not_wanted) return addCodeChange(a, b, found_.code);
        Change change{case_name, a.id, a.unit, a.median, b.median, {}};
        if (judgement == Judgement::too_short) {
            found_.too_short.push_back(std::move(change));
            return;
        }
        if (isProbe(a.id)) return addProbe(std::move(change), a, b, scaleOf(a, all_of_a));
        if (!a.isTimedAs(b)) {
            found_.warnings.push_back(
                case_name + ": " + a.name() + " is timed in two ways, and not compared: " +
                modeName(a.mode) + " and " + modeName(b.mode));
            return;
        }
        change.comparison =
            isExact(a)
                ? exactComparison(costOf(a, a.median), costOf(b, b.median), options_.threshold)
                : compareMedians(costs(a), costs(b), options_.threshold, kLevel);
        found_.changes.push_back(std::move(change));
    }

    const VerdictOptions& options_;
    MetricChoice judged_;
    double shortest_ = kShortestTime;  // ms
    ReportComparison found_;
    std::map<std::size_t, Verdict> probes_;  // by the index of their change
    std::map<std::string, std::size_t> only_;  // "A: pass.wind.time" -> number of cases
};

void addUnmatched(
    const scene::Json& report, const scene::Json& other, const char* which,
    std::vector<std::string>& unmatched) {
    for (const scene::Json& each : report.at("cases"))
        if (const std::string name = each.at("name"); !findCase(other, name))
            unmatched.push_back(std::string("only in ") + which + ": " + name);
}

}  // namespace

ReportComparison
compareReports(const scene::Json& a, const scene::Json& b, const VerdictOptions& options) {
    try {
        Comparer comparer(a, b, options);
        comparer.found().warnings = environmentDifferences(a, b);
        comparer.found().same_device = isSameDevice(a, b);
        for (const scene::Json& each : a.at("cases"))
            if (const scene::Json* const other = findCase(b, each.at("name")))
                comparer.addCase(each, *other);
        addUnmatched(a, b, "A", comparer.found().unmatched);
        addUnmatched(b, a, "B", comparer.found().unmatched);
        return std::move(comparer).finish();
    } catch (const scene::Json::exception& error) {
        throw engine::Error("the reports can't be compared", scene::jsonReason(error));
    }
}

Verdict overallVerdict(const ReportComparison& comparison) {
    return comparison.mismatches.empty() ? overallVerdict(comparison.changes) : Verdict::mismatch;
}

scene::Json
comparisonJson(const ReportComparison& comparison, const std::string& a, const std::string& b) {
    scene::Json object = {{"schema", "hairbench-comparison/1.1.0"}, {"a", a}, {"b", b}};
    object["verdict"] = verdictName(overallVerdict(comparison));
    object["warnings"] = comparison.warnings;
    object["unmatched"] = comparison.unmatched;
    scene::Json& differing = object["mismatches"] = scene::Json::array();
    for (const Mismatch& each : comparison.mismatches) differing.push_back(mismatchJson(each));
    scene::Json& changes = object["changes"] = scene::Json::array();
    for (const Change& each : comparison.changes) changes.push_back(changeJson(each));
    scene::Json& too_short = object["too_short"] = scene::Json::array();
    for (const Change& each : comparison.too_short)
        too_short.push_back({{"case", each.case_name}, {"metric", each.metric.name()}});
    object["code"] = codeChangesJson(comparison.code);
    object["caveat"] = kOneProcessCaveat;
    return object;
}

// ---- Baselines ----------------------------------------------------------------------------------

namespace {

std::filesystem::path baselineFolder() {
    const char* const folder = std::getenv("HAIRBENCH_BASELINES");
    return folder && *folder ? folder : "results/local/baselines";
}

// Throws engine::Error unless the name is a valid folder name on every system. It must not lead out
// of the baselines' folder.
void checkName(const std::string& name) {
    if (name.empty() || name.starts_with('.') || name.starts_with('-'))
        throw engine::Error(
            "baseline",
            "'" + name + "' is not a name: it must not be empty or begin with '.' or '-'");
    for (const char each : name)
        if (std::string_view("/\\:*?\"<>|").find(each) != std::string_view::npos ||
            static_cast<unsigned char>(each) < 32)
            throw engine::Error(
                "baseline", "'" + name +
                                "' is not a name: it must be one of a single folder, without '/' "
                                "or control characters");
}

}  // namespace

std::filesystem::path baselineFile(const std::string& name, const std::string& scene) {
    checkName(name);
    return baselineFolder() / name / (scene + ".json");
}

std::string sceneNameOf(const scene::Json& report) {
    const std::string path = scene::textAt(report, "/scene/path");
    if (path.empty()) throw engine::Error("/scene/path", "the report names no scene");
    return std::filesystem::path(path).stem().string();
}

void saveBaseline(const std::string& name, const std::filesystem::path& report) {
    scene::Json copy = readReport(report);
    for (scene::Json& each : copy.at("cases"))
        each.erase("picture");  // its path is relative to the report
    // Texts from drivers and the command line need not be UTF-8.
    engine::writeFileAtomically(
        baselineFile(name, sceneNameOf(copy)),
        copy.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n');
}

}  // namespace benchmarks::report
