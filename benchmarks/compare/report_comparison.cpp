#include "benchmarks/compare/report_comparison.h"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/compare/environment_differences.h"
#include "benchmarks/compare/judged_metrics.h"
#include "benchmarks/compare/median_ratio.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

constexpr double kLevel = VerdictRule{}.alpha;

const Json* findCase(const Json& report, const std::string& name) {
    for (const Json& each : report.at("cases"))
        if (each.at("name").get_ref<const std::string&>() == name) return &each;
    return nullptr;
}

// Costs: larger is worse.
std::vector<double> costs(const Json& metric, const MetricReading& reading) {
    auto values = metric.at("samples").get<std::vector<double>>();
    if (reading.hint == "higher")
        for (double& value : values) value = 1.0 / value;
    return values;
}

// What is counted and not timed is known exactly, whatever the number of samples.
bool isExact(const MetricReading& reading) { return reading.unit == "B"; }

Comparison exactComparison(double a, double b, double decisive_change) {
    const double change = a > 0.0 ? b / a - 1.0 : 0.0;
    const bool outside = std::abs(std::log1p(change)) > std::log1p(decisive_change);
    return {
        .verdict = Verdict::inconclusive,
        .change = change,
        .lower = change,
        .upper = change,
        .decisive_change = decisive_change,
        .p = outside ? 0.0 : 1.0};
}

Clock clockFor(const Json& a, const Json& b) {
    std::vector<std::string> names;
    for (const Json& each : a.at("cases")) {
        const Json* const other = findCase(b, each.at("name"));
        if (!other || !each.contains("metrics") || !other->contains("metrics")) continue;
        for (const auto& [name, metric] : each.at("metrics").items())
            if (other->at("metrics").contains(name)) names.push_back(name);
    }
    return judgedClock(
        isSoftwareDevice(a.at("environment")) && isSoftwareDevice(b.at("environment")), names);
}

class Comparer {
public:
    Comparer(const Json& a, const Json& b, const VerdictOptions& options)
        : options_(options), judged_(options.metrics, clockFor(a, b)) {}

    void addCase(const Json& a, const Json& b) {
        ++found_.common_cases;
        const std::vector<Mismatch> differing = mismatches(caseOutcome(a), caseOutcome(b));
        found_.mismatches.insert(found_.mismatches.end(), differing.begin(), differing.end());
        if (!differing.empty() || a.at("status") != "ok") return;
        const std::string name = a.at("name");
        for (const auto& [metric, of_a] : a.at("metrics").items())
            if (const auto of_b = b.at("metrics").find(metric); of_b != b.at("metrics").end())
                addMetric(name, metric, of_a, *of_b);
    }

    ReportComparison finish() && {
        std::vector<Comparison> comparisons;
        for (const Change& each : found_.changes) comparisons.push_back(each.comparison);
        passVerdicts(comparisons, kLevel);
        for (std::size_t i = 0; i < comparisons.size(); ++i)
            found_.changes[i].comparison = comparisons[i];
        return std::move(found_);
    }

    ReportComparison& found() { return found_; }

private:
    void addMetric(
        const std::string& case_name, const std::string& metric, const Json& a, const Json& b) {
        const MetricReading of_a = readMetric(metric, a);
        const MetricReading of_b = readMetric(metric, b);
        const Judgement judgement = judged_.judge(of_a, of_b);
        if (judgement == Judgement::not_wanted) return;
        Change change{case_name, metric, of_a.unit, of_a.median, of_b.median, {}};
        if (judgement == Judgement::too_short) {
            found_.too_short.push_back(std::move(change));
            return;
        }
        if (of_a.mode != of_b.mode) {
            found_.warnings.push_back(
                case_name + ": " + metric +
                " is timed in two ways, and not compared: " + of_a.mode + " and " + of_b.mode);
            return;
        }
        change.comparison =
            isExact(of_a)
                ? exactComparison(of_a.median, of_b.median, options_.threshold)
                : compareMedians(costs(a, of_a), costs(b, of_b), options_.threshold, kLevel);
        found_.changes.push_back(std::move(change));
    }

    const VerdictOptions& options_;
    JudgedMetrics judged_;
    ReportComparison found_;
};

void addUnmatched(
    const Json& report, const Json& other, const char* which, std::vector<std::string>& unmatched) {
    for (const Json& each : report.at("cases"))
        if (const std::string name = each.at("name"); !findCase(other, name))
            unmatched.push_back(std::string("only in ") + which + ": " + name);
}

}  // namespace

ReportComparison compareReports(const Json& a, const Json& b, const VerdictOptions& options) {
    try {
        Comparer comparer(a, b, options);
        comparer.found().warnings = environmentDifferences(a, b);
        comparer.found().same_device = isSameDevice(a, b);
        for (const Json& each : a.at("cases"))
            if (const Json* const other = findCase(b, each.at("name")))
                comparer.addCase(each, *other);
        addUnmatched(a, b, "A", comparer.found().unmatched);
        addUnmatched(b, a, "B", comparer.found().unmatched);
        return std::move(comparer).finish();
    } catch (const Json::exception& error) {
        throw engine::Error("the reports can't be compared", error.what());
    }
}

Verdict overallVerdict(const ReportComparison& comparison) {
    return comparison.mismatches.empty() ? overallVerdict(comparison.changes) : Verdict::mismatch;
}

Json comparisonJson(
    const ReportComparison& comparison, const std::string& a, const std::string& b) {
    Json object = {{"schema", "hairbench-comparison/1.0.0"}, {"a", a}, {"b", b}};
    object["verdict"] = verdictName(overallVerdict(comparison));
    object["warnings"] = comparison.warnings;
    object["unmatched"] = comparison.unmatched;
    Json& differing = object["mismatches"] = Json::array();
    for (const Mismatch& each : comparison.mismatches) differing.push_back(mismatchJson(each));
    Json& changes = object["changes"] = Json::array();
    for (const Change& each : comparison.changes) changes.push_back(changeJson(each));
    Json& too_short = object["too_short"] = Json::array();
    for (const Change& each : comparison.too_short)
        too_short.push_back({{"case", each.case_name}, {"metric", each.metric}});
    object["caveat"] = kOneProcessCaveat;
    return object;
}

}  // namespace benchmarks
