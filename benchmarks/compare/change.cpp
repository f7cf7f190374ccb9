#include "benchmarks/compare/change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/columns.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/table.h"

namespace benchmarks {

namespace {

void putFinite(Json& object, const char* key, double value) {
    if (std::isfinite(value)) object[key] = value;
}

std::string intervalText(const Comparison& comparison) {
    if (!std::isfinite(comparison.lower) || !std::isfinite(comparison.upper)) return "-";
    return percentText(comparison.lower) + " ... " + percentText(comparison.upper);
}

std::string quantityText(double value, const std::string& unit) {
    const bool whole = unit == "B" || unit == "count";
    return (whole ? std::to_string(std::llround(value)) : shortNumber(value)) + ' ' + unit;
}

}  // namespace

Json changeJson(const Change& change) {
    const Comparison& comparison = change.comparison;
    Json object = {
        {"case", change.case_name}, {"metric", change.metric.name()}, {"unit", change.unit}};
    putFinite(object, "a", change.a);
    putFinite(object, "b", change.b);
    putFinite(object, "change", comparison.change);
    if (std::isfinite(comparison.upper)) {  // else nothing is known of either end
        putFinite(object, "lower", comparison.lower);
        putFinite(object, "upper", comparison.upper);
    }
    object["decisive_change"] = comparison.decisive_change;
    object["p"] = comparison.p;
    object["verdict"] = verdictName(comparison.verdict);
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
            std::string(verdictName(comparison.verdict))};
        for (std::size_t i = 0; i < all.size(); ++i) all[i].cells.push_back(cells[i]);
    }
    if (show_cases == ShowCases::no) all.erase(all.begin());
    std::string text;
    for (std::size_t row = 0; row <= changes.size(); ++row) text += columnsLine(all, row);
    return text;
}

std::size_t countOf(std::span<const Change> changes, Verdict verdict) {
    return static_cast<std::size_t>(std::ranges::count(
        changes, verdict, [](const Change& each) { return each.comparison.verdict; }));
}

std::string verdictCounts(std::span<const Change> changes) {
    std::string text;
    for (const Verdict verdict :
         {Verdict::regressed, Verdict::improved, Verdict::same, Verdict::inconclusive})
        text += (text.empty() ? "" : ", ") + std::to_string(countOf(changes, verdict)) + ' ' +
                verdictName(verdict);
    return text;
}

Verdict overallVerdict(std::span<const Change> changes) {
    for (const Verdict verdict : {Verdict::regressed, Verdict::inconclusive, Verdict::improved})
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

std::string percentText(double share) {
    if (!std::isfinite(share)) return "-";
    char text[48];
    std::snprintf(text, sizeof text, "%+.*f %%", std::abs(share) < 0.1 ? 2 : 1, share * 100.0);
    return text;
}

}  // namespace benchmarks
