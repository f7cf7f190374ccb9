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

std::vector<double> costs(const MetricReading& metric) {
    if (metric.samples.empty())
        throw engine::Error(
            "the reports can't be compared", metric.name() + " has no samples in one");
    std::vector<double> values;
    for (const double sample : metric.samples) values.push_back(costOf(metric, sample));
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
    std::vector<MetricId> metrics;
    for (const Json& each : a.at("cases")) {
        const Json* const other = findCase(b, each.at("name"));
        if (!other || !each.contains("metrics") || !other->contains("metrics")) continue;
        for (const auto& [name, metric] : each.at("metrics").items())
            if (other->at("metrics").contains(name)) metrics.push_back(metricNamed(name));
    }
    return judgedClock(
        isSoftwareDevice(a.at("environment")) && isSoftwareDevice(b.at("environment")), metrics);
}

class Comparer {
public:
    Comparer(const Json& a, const Json& b, const VerdictOptions& options)
        : options_(options), judged_(metricsNamed(options.metrics)) {
        if (!judged_) judged_ = timesBy(clockFor(a, b));
    }

    void addCase(const Json& a, const Json& b) {
        ++found_.common_cases;
        const std::vector<Mismatch> differing = mismatches(caseOutcome(a), caseOutcome(b));
        found_.mismatches.insert(found_.mismatches.end(), differing.begin(), differing.end());
        if (!differing.empty() || a.at("status") != "ok") return;
        const std::string name = a.at("name");
        const std::vector<MetricReading> metrics_of_b = readMetrics(b);
        for (const MetricReading& of_a : readMetrics(a))
            if (const MetricReading* const of_b = findMetric(metrics_of_b, of_a.id))
                addMetric(name, of_a, *of_b);
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
    void addMetric(const std::string& case_name, const MetricReading& a, const MetricReading& b) {
        const Judgement judgement = judgementOf(judged_, a, b);
        if (judgement == Judgement::not_wanted) return;
        Change change{case_name, a.id, a.unit, a.median, b.median, {}};
        if (judgement == Judgement::too_short) {
            found_.too_short.push_back(std::move(change));
            return;
        }
        if (!a.isTimedAs(b)) {
            found_.warnings.push_back(
                case_name + ": " + a.name() + " is timed in two ways, and not compared: " +
                modeName(a.mode) + " and " + modeName(b.mode));
            return;
        }
        change.comparison = isExact(a)
                                ? exactComparison(a.median, b.median, options_.threshold)
                                : compareMedians(costs(a), costs(b), options_.threshold, kLevel);
        found_.changes.push_back(std::move(change));
    }

    const VerdictOptions& options_;
    MetricChoice judged_;
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
        too_short.push_back({{"case", each.case_name}, {"metric", each.metric.name()}});
    object["caveat"] = kOneProcessCaveat;
    return object;
}

}  // namespace benchmarks
