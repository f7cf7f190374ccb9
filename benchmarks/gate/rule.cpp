#include "benchmarks/gate/rule.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include "benchmarks/report/statistics.h"
#include "engine/error.h"

namespace benchmarks::gate {
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

}  // namespace benchmarks::gate
