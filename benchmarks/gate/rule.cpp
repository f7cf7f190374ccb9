#include "benchmarks/gate/rule.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

#include "benchmarks/report/statistics.h"
#include "engine/error.h"

namespace benchmarks::gate {
namespace {

constexpr report::Comparison kNothingKnown{
    .verdict = report::Verdict::inconclusive,
    .change = std::numeric_limits<double>::quiet_NaN(),
    .lower = -1.0,  // a share: infinitely much faster
    .upper = std::numeric_limits<double>::infinity(),
    .decisive_change = 0.0,
    .p = 1.0};

}  // namespace

Gate::Gate(std::vector<GateMetric> metrics, const report::VerdictRule& rule)
    : metrics_(std::move(metrics)), rule_(rule), differences_(metrics_.size()),
      comparable_(metrics_.size(), 1) {
    assert(std::ranges::count(report::kStages, rule_.first_pairs) == 1);
}

bool Gate::isStage(std::size_t pairs) const {
    return pairs >= rule_.first_pairs && std::ranges::count(report::kStages, pairs) > 0;
}

Gate::Step Gate::next() const {
    const bool a_first = pairs_ % 2 == 0;
    if (waiting_) return a_first ? Step::run_b : Step::run_a;
    if (isStage(pairs_)) {
        if (pairs_ == *std::rbegin(report::kStages)) return Step::decided;
        const std::vector<report::Comparison> compared = comparisons();
        bool open = false;
        for (std::size_t i = 0; i < compared.size(); ++i)
            open |= comparable_[i] && compared[i].verdict == report::Verdict::inconclusive;
        if (!open) return Step::decided;
    }
    return a_first ? Step::run_a : Step::run_b;
}

void Gate::add(std::vector<double> medians) {
    const Step step = next();
    assert(step != Step::decided);
    if (medians.size() != metrics_.size())
        throw engine::Error("gate", "a process measured something else than the others");
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
}

std::size_t Gate::nextDecision() const {
    for (const std::size_t stage : report::kStages) {
        if (!isStage(stage)) continue;
        if (pairs_ < stage || (pairs_ == stage && next() == Step::decided)) return stage;
    }
    return *std::rbegin(report::kStages);
}

std::vector<report::Comparison> Gate::comparisons() const {
    std::vector<std::vector<double>> differences;
    std::vector<double> decisive_changes;
    for (std::size_t i = 0; i < metrics_.size(); ++i) {
        if (!comparable_[i] || pairs_ == 0) continue;
        differences.push_back(differences_[i]);
        decisive_changes.push_back(
            report::decisiveChange(rule_.threshold, metrics_[i].calibration));
    }
    const std::vector<report::Comparison> known =
        report::compare(differences, decisive_changes, rule_.alpha);
    std::vector<report::Comparison> comparisons(metrics_.size(), kNothingKnown);
    for (std::size_t i = 0, next_known = 0; i < metrics_.size(); ++i) {
        if (comparable_[i] && pairs_ > 0) comparisons[i] = known[next_known++];
        comparisons[i].decisive_change =
            report::decisiveChange(rule_.threshold, metrics_[i].calibration);
        if (!isStage(pairs_)) comparisons[i].verdict = report::Verdict::inconclusive;
    }
    return comparisons;
}

}  // namespace benchmarks::gate
