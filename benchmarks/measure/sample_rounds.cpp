#include "benchmarks/measure/sample_rounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "benchmarks/machine/machine_watch.h"
#include "benchmarks/measure/assessment.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

// Times are looked at again when there is a twentieth more of them: looking takes time too.
constexpr std::size_t kLookShare = 20;

class Series {
public:
    explicit Series(const SamplingRule& rule) : rule_(rule) {}

    void add(std::vector<engine::FrameRecord> frames) {
        std::vector<double> times;
        for (const engine::FrameRecord& frame : frames) times.push_back(frame.*rule_.time);
        times_.push_back(std::move(times));
        frames_.push_back(std::move(frames));
        if (rounds() >= looked_at_ + std::max<std::size_t>(looked_at_ / kLookShare, 1)) look();
    }

    std::size_t rounds() const { return times_.size(); }
    const Assessment& assessment() const { return assessment_; }

    // Looked at as a whole, and its frames moved out.
    SampledRounds take() {
        if (looked_at_ != rounds()) look();
        SampledRounds result;
        for (std::size_t i = assessment_.settling; i < frames_.size(); ++i)
            std::ranges::move(frames_[i], std::back_inserter(result.frames));
        result.sampling.mode = rule_.mode;
        result.sampling.rounds = static_cast<std::uint32_t>(rounds() - assessment_.settling);
        result.sampling.warmup_rounds = static_cast<std::uint32_t>(assessment_.settling);
        result.sampling.steady = assessment_.steady;
        result.sampling.precision = assessment_.relative_half_width;
        return result;
    }

private:
    void look() {
        assessment_ = assess(times_);
        looked_at_ = rounds();
    }

    const SamplingRule& rule_;
    RoundTimes times_;
    std::vector<std::vector<engine::FrameRecord>> frames_;  // [round][frame]
    Assessment assessment_;
    std::size_t looked_at_ = 0;  // rounds that the assessment is of
};

}  // namespace

SampledRounds sampleRounds(const SamplingRule& rule, const SamplingTools& tools) {
    Series series(rule);
    std::vector<Conditions> conditions;
    std::uint32_t throttled = 0;
    const double begin = tools.seconds();
    double seconds = 0.0;
    for (bool more = true; more;) {
        tools.begin_watch();
        std::vector<engine::FrameRecord> frames = tools.play();
        conditions.push_back(tools.end_watch());
        if (isThrottled(conditions.back())) {
            ++throttled;
            tools.pause(kThrottlePause);
        } else {
            series.add(std::move(frames));
        }
        seconds = tools.seconds() - begin;
        more = seconds < rule.max_time;
        if (series.rounds() == 0) {
            more = more || throttled < kThrottledTries;
            continue;
        }
        const Assessment& now = series.assessment();
        more = more && series.rounds() < rule.most_rounds && !isEnough(now, rule.precision);
        if (tools.progress) {
            tools.progress(
                {.mode = rule.mode,
                 .rounds = static_cast<std::uint32_t>(series.rounds()),
                 .median = now.median,
                 .relative_half_width = now.relative_half_width,
                 .seconds = seconds,
                 .max_seconds = rule.max_time});
        }
    }
    if (series.rounds() == 0) {
        throw engine::Error(
            rule.mode, "the device's clock was below " +
                           std::to_string(std::lround(100.0 * kThrottledShare)) +
                           " % of its base in all " + std::to_string(throttled) + " rounds");
    }
    SampledRounds result = series.take();
    result.sampling.throttled_rounds = throttled;
    result.sampling.seconds = seconds;
    result.conditions = std::move(conditions);
    return result;
}

}  // namespace benchmarks
