#include "benchmarks/report/change.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace benchmarks::report {
namespace {

// ---- Verdicts on pairs --------------------------------------------------------------------------

constexpr double kNormalDeviations = 1.4826;  // a normal distribution's sigma over its MAD

bool isAbove(std::span<const double> differences, double bound) {
    return signedRankP(differences, bound).greater <= signedRankP(differences, -bound).less;
}

// Two-sided p-value for the median lying outside the band: twice the smaller one-sided p-value, for
// above and below.
double outsideP(std::span<const double> differences, double bound) {
    const double above = signedRankP(differences, bound).greater;
    const double below = signedRankP(differences, -bound).less;
    return std::min(1.0, 2.0 * std::min(above, below));
}

Verdict verdictOf(
    std::span<const double> differences, const MedianInterval& interval, double bound,
    double adjusted_p, double level) {
    if (adjusted_p <= level)
        return isAbove(differences, bound) ? Verdict::regressed : Verdict::improved;
    if (interval.lower > -bound && interval.upper < bound) return Verdict::same;
    return Verdict::inconclusive;
}

}  // namespace

const char* verdictName(Verdict verdict) {
    switch (verdict) {
    case Verdict::regressed:
        return "regressed";
    case Verdict::improved:
        return "improved";
    case Verdict::same:
        return "same";
    case Verdict::inconclusive:
        return "inconclusive";
    case Verdict::mismatch:
        return "mismatch";
    }
    return "inconclusive";
}

double decisiveChange(double threshold, std::span<const double> calibration) {
    if (calibration.empty()) return threshold;
    return std::max(threshold, 3.0 * kNormalDeviations * summarize(calibration).mad);
}

std::vector<Comparison> compare(
    std::span<const std::vector<double>> differences, std::span<const double> decisive_changes,
    double alpha) {
    assert(differences.size() == decisive_changes.size());
    const double level = stageLevel(alpha);
    std::vector<double> p_values;
    for (std::size_t i = 0; i < differences.size(); ++i)
        p_values.push_back(outsideP(differences[i], std::log1p(decisive_changes[i])));
    const std::vector<double> adjusted = falseDiscoveryAdjusted(p_values);
    std::vector<Comparison> comparisons;
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const double bound = std::log1p(decisive_changes[i]);
        const MedianInterval interval = signedRankInterval(differences[i], level);
        comparisons.push_back(
            {.verdict = verdictOf(differences[i], interval, bound, adjusted[i], level),
             .change = std::expm1(interval.estimate),
             .lower = std::expm1(interval.lower),
             .upper = std::expm1(interval.upper),
             .decisive_change = decisive_changes[i],
             .p = adjusted[i]});
    }
    return comparisons;
}

namespace {

// ---- Texts, JSON, exit status -------------------------------------------------------------------

void putFinite(scene::Json& object, const char* key, double value) {
    if (std::isfinite(value)) object[key] = value;
}

// "+1.8 %"
std::string percentText(double share) {
    if (share == std::numeric_limits<double>::infinity()) return "from none";
    if (!std::isfinite(share)) return "-";
    char text[48];
    std::snprintf(text, sizeof text, "%+.*f %%", std::abs(share) < 0.1 ? 2 : 1, share * 100.0);
    return text;
}

std::string intervalText(const Comparison& comparison) {
    if (!std::isfinite(comparison.lower) || !std::isfinite(comparison.upper)) return "-";
    return percentText(comparison.lower) + " ... " + percentText(comparison.upper);
}

std::string quantityText(double value, const std::string& unit) {
    const bool whole = unit == "B" || unit == "count";
    return (whole ? std::to_string(std::llround(value)) : shortNumber(value)) + ' ' + unit;
}

// Counts only the changes that decide.
std::size_t countOf(std::span<const Change> changes, Verdict verdict) {
    return static_cast<std::size_t>(std::ranges::count_if(changes, [&](const Change& each) {
        return each.decides && each.comparison.verdict == verdict;
    }));
}

}  // namespace

scene::Json changeJson(const Change& change) {
    const Comparison& comparison = change.comparison;
    scene::Json object = {
        {"case", change.case_name}, {"metric", change.metric.name()}, {"unit", change.unit}};
    putFinite(object, "a", change.a);
    putFinite(object, "b", change.b);
    putFinite(object, "change", comparison.change);
    if (std::isfinite(comparison.upper)) {  // otherwise neither bound is known
        putFinite(object, "lower", comparison.lower);
        putFinite(object, "upper", comparison.upper);
    }
    object["decisive_change"] = comparison.decisive_change;
    object["p"] = comparison.p;
    object["verdict"] = verdictName(comparison.verdict);
    if (comparison.pairs > 0) object["pairs"] = comparison.pairs;
    if (!change.decides) object["decides"] = false;
    if (change.by_clock) object["by_clock"] = true;
    return object;
}

std::string changesTable(std::span<const Change> changes, ShowCases show_cases) {
    if (changes.empty()) return {};
    std::vector<Column> all{{"case", false}, {"metric", false}, {"A"},
                            {"B"},           {"change"},        {"interval", false},
                            {"counts from"}, {"verdict", false}};
    for (const Change& each : changes) {
        const Comparison& comparison = each.comparison;
        const std::array cells{
            each.case_name,
            each.metric.name(),
            quantityText(each.a, each.unit),
            quantityText(each.b, each.unit),
            percentText(comparison.change),
            intervalText(comparison),
            percentText(comparison.decisive_change),
            verdictName(comparison.verdict) + std::string(
                                                  each.by_clock  ? ", by the clock alone"
                                                  : each.decides ? ""
                                                                 : ", decides nothing")};
        for (std::size_t i = 0; i < all.size(); ++i) all[i].cells.push_back(cells[i]);
    }
    if (show_cases == ShowCases::no) all.erase(all.begin());
    std::string text;
    for (std::size_t row = 0; row <= changes.size(); ++row) text += columnsLine(all, row);
    return text;
}

std::string verdictCounts(std::span<const Change> changes) {
    std::string text;
    for (const Verdict verdict :
         {Verdict::regressed, Verdict::improved, Verdict::same, Verdict::inconclusive})
        text += (text.empty() ? "" : ", ") + std::to_string(countOf(changes, verdict)) + ' ' +
                verdictName(verdict);
    // Only probes have this verdict.
    if (const std::size_t otherwise = countOf(changes, Verdict::mismatch))
        text = std::to_string(otherwise) + " mismatch, " + text;
    return text;
}

Verdict overallVerdict(std::span<const Change> changes) {
    for (const Verdict verdict :
         {Verdict::regressed, Verdict::mismatch, Verdict::inconclusive, Verdict::improved})
        if (countOf(changes, verdict) > 0) return verdict;
    return Verdict::same;
}

int verdictStatus(Verdict verdict, bool fail_on_inconclusive) {
    switch (verdict) {
    case Verdict::regressed:
        return kRegressed;
    case Verdict::mismatch:
        return kMismatch;
    case Verdict::inconclusive:
        return fail_on_inconclusive ? kInconclusive : kOk;
    case Verdict::improved:
    case Verdict::same:
        break;
    }
    return kOk;
}

namespace {

// ---- Medians of two single processes ------------------------------------------------------------

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSmallestLevel = 1e-9;  // the bisection stops here

// Samples with their effective number, which is slow to compute.
struct Sample {
    std::span<const double> values;
    double effective;
};

Sample sampleOf(std::span<const double> values) { return {values, effectiveSamples(values)}; }

struct RatioInterval {
    double lower;  // ln(B/A)
    double upper;
};

// Returns the interval of ln of the ratio of the medians, as compareMedians() describes it;
// infinite where it is not known.
RatioInterval ratioInterval(const Sample& a, const Sample& b, double alpha) {
    const MedianInterval of_a = medianInterval(a.values, alpha / 2.0, a.effective);
    const MedianInterval of_b = medianInterval(b.values, alpha / 2.0, b.effective);
    if (!(of_a.lower > 0.0) || !(of_b.lower > 0.0) || !std::isfinite(of_a.upper) ||
        !std::isfinite(of_b.upper))
        return {-kInfinity, kInfinity};
    return {std::log(of_b.lower / of_a.upper), std::log(of_b.upper / of_a.lower)};
}

bool isOutside(const RatioInterval& interval, double bound) {
    return interval.lower > bound || interval.upper < -bound;
}

// Bisects for the smallest level at which the interval lies outside the band. A lower level always
// gives a wider interval.
double smallestLevel(const Sample& a, const Sample& b, double bound) {
    double outside = 1.0;
    if (!isOutside(ratioInterval(a, b, outside), bound)) return 1.0;
    double inside = kSmallestLevel;
    if (isOutside(ratioInterval(a, b, inside), bound)) return inside;
    while (outside > 1.01 * inside) {
        const double level = std::sqrt(inside * outside);
        (isOutside(ratioInterval(a, b, level), bound) ? outside : inside) = level;
    }
    return outside;
}

}  // namespace

Comparison compareMedians(
    std::span<const double> a, std::span<const double> b, double decisive_change, double alpha) {
    const Sample sample_a = sampleOf(a);
    const Sample sample_b = sampleOf(b);
    const RatioInterval interval = ratioInterval(sample_a, sample_b, alpha);
    const double middle_a = medianInterval(a, alpha).estimate;
    const double middle_b = medianInterval(b, alpha).estimate;
    return {
        .verdict = Verdict::inconclusive,
        .change = middle_a > 0.0 ? middle_b / middle_a - 1.0 : 0.0,
        .lower = std::expm1(interval.lower),
        .upper = std::expm1(interval.upper),
        .decisive_change = decisive_change,
        .p = smallestLevel(sample_a, sample_b, std::log1p(decisive_change))};
}

void passVerdicts(std::span<Comparison> comparisons, double alpha) {
    std::vector<double> p_values;
    for (const Comparison& each : comparisons) p_values.push_back(each.p);
    const std::vector<double> adjusted = falseDiscoveryAdjusted(p_values);
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
        Comparison& each = comparisons[i];
        each.p = adjusted[i];
        const double bound = std::log1p(each.decisive_change);
        if (each.p <= alpha)
            each.verdict = each.change > 0.0 ? Verdict::regressed : Verdict::improved;
        else if (std::log1p(each.lower) > -bound && std::log1p(each.upper) < bound)
            each.verdict = Verdict::same;
        else
            each.verdict = Verdict::inconclusive;
    }
}

}  // namespace benchmarks::report
