#include "benchmarks/measure/sampling.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <iterator>
#include <utility>

#include "benchmarks/report/statistics.h"

namespace benchmarks::measure {

using engine::FrameRecord;
using engine::Timing;

// ---- Plays of one mode --------------------------------------------------------------------------

RoundPlayer::RoundPlayer(
    std::unique_ptr<Player> player, const hair::RunSettings& run, Counts counts,
    std::uint32_t queue)
    : player_(std::move(player)), warmup_(run.warmup), frames_(run.frames), counts_(counts),
      queue_(queue) {}

std::vector<FrameRecord> RoundPlayer::round() {
    if (plays_ == 1) firstEnd();
    player_->reset();
    std::uint32_t next = 0;
    if (plays_ == 0) {
        player_->frame();
        first_frame_ = player_->finish().front().interval;
        next = 1;
    }
    if (warmup_ < queue_ + next) {
        for (std::uint32_t i = warmup_; i < queue_; ++i) player_->frame();
        player_->reset();
        next = 0;
    }
    const bool counts = plays_ == 0 && counts_ == Counts::last_frame;
    // The interval of the last frame contains the wait for it, so one more frame is drawn than
    // measured.
    const std::uint32_t timed = warmup_ + frames_ + (counts ? 0 : 1);
    for (std::uint32_t i = next; i < timed; ++i) player_->frame();
    std::vector<FrameRecord> frames = player_->finish();
    if (counts)
        player_->count();
    else
        frames.pop_back();
    ++plays_;
    // The return value excludes the very first frame, which an earlier finish() returned.
    return {frames.end() - frames_, frames.end()};
}

std::vector<FrameRecord> RoundPlayer::more() {
    for (std::uint32_t i = 0; i < frames_; ++i) player_->frame();
    return player_->finish();
}

void RoundPlayer::play() {
    player_->reset();
    // As many frames as in round(), so that all plays end with the same frame.
    for (std::uint32_t i = 0; i < warmup_ + frames_ + 1; ++i) player_->frame();
    std::ranges::move(player_->completed(), std::back_inserter(complete_));
    ++plays_;
}

std::vector<FrameRecord> RoundPlayer::stream(std::uint32_t plays) {
    const std::size_t length = std::size_t{warmup_} + frames_ + 1;
    while (complete_.size() < plays * length) play();
    std::vector<FrameRecord> counted;
    for (std::size_t i = 0; i < plays * length; ++i)
        if (i % length >= warmup_ && i % length < warmup_ + frames_)
            counted.push_back(std::move(complete_[i]));
    complete_.erase(
        complete_.begin(), complete_.begin() + static_cast<std::ptrdiff_t>(plays * length));
    return counted;
}

void RoundPlayer::drain() {
    player_->finish();
    complete_.clear();
}

const RoundEnd& RoundPlayer::firstEnd() {
    if (!first_end_) first_end_ = player_->end();
    return *first_end_;
}

RoundEnd RoundPlayer::lastEnd() { return plays_ == 1 ? firstEnd() : player_->end(); }

namespace {

// ---- Rounds until the median is known -----------------------------------------------------------

// Assesses the times again when their number has grown by a twentieth, because an assessment takes
// time too.
constexpr std::size_t kLookShare = 20;

class Series {
public:
    explicit Series(const SamplingRule& rule, const report::HighestClocks& held_before)
        : rule_(rule), held_before_(held_before) {}

    // Returns true if the round was throttled, by the knowledge so far.
    bool add(std::vector<FrameRecord> frames, report::Conditions conditions) {
        std::vector<double> times;
        for (const FrameRecord& frame : frames)
            times.push_back(rule_.passes && frame.device ? *frame.device : frame.*rule_.time);
        times_.push_back(std::move(times));
        frames_.push_back(std::move(frames));
        held_.raise(conditions);
        conditions_.push_back(std::move(conditions));
        const std::size_t clean = cleanRounds().size();
        if (clean >= looked_at_ + std::max<std::size_t>(looked_at_ / kLookShare, 1)) look();
        return report::isThrottled(conditions_.back(), held_, held_before_);
    }

    std::vector<std::size_t> cleanRounds() const {
        std::vector<std::size_t> clean;
        for (std::size_t i = 0; i < conditions_.size(); ++i)
            if (!report::isThrottled(conditions_[i], held_, held_before_)) clean.push_back(i);
        return clean;
    }

    // The last assessment; null before the first one has finished.
    const Assessment* assessment() {
        if (looking_.valid() &&
            looking_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
            assessment_ = looking_.get();
        return assessment_ ? &*assessment_ : nullptr;
    }

    // Assesses the whole series and moves its frames out.
    SampledRounds take() {
        if (looking_.valid()) looking_.wait();
        std::vector<std::size_t> counted = cleanRounds();
        SampledRounds result;
        result.sampling.mode = rule_.mode;
        result.sampling.throttled_rounds =
            static_cast<std::uint32_t>(conditions_.size() - counted.size());
        result.all_throttled = counted.empty();
        if (counted.empty())
            for (std::size_t i = 0; i < conditions_.size(); ++i) counted.push_back(i);
        const Assessment assessment =
            assessed(rule_.precision, timesOf(counted), [&] { return passesOf(counted); });
        std::vector<report::Conditions> of_counted;
        for (std::size_t i = assessment.settling; i < counted.size(); ++i) {
            std::ranges::move(frames_[counted[i]], std::back_inserter(result.frames));
            of_counted.push_back(conditions_[counted[i]]);
        }
        result.clock_mhz = medianConditions(of_counted).clock_mhz;
        result.power = meanPower(of_counted);
        result.sampling.rounds = static_cast<std::uint32_t>(counted.size() - assessment.settling);
        result.sampling.warmup_rounds = static_cast<std::uint32_t>(assessment.settling);
        result.sampling.steady = assessment.steady;
        result.sampling.precision = assessment.relative_half_width;
        result.conditions = std::move(conditions_);
        return result;
    }

    const report::HighestClocks& held() const { return held_; }

private:
    RoundTimes timesOf(const std::vector<std::size_t>& rounds) const {
        RoundTimes times;
        for (const std::size_t i : rounds) times.push_back(times_[i]);
        return times;
    }

    // The times of each pass that all frames have; empty if passes do not decide.
    std::vector<RoundTimes> passesOf(const std::vector<std::size_t>& rounds) const {
        std::vector<RoundTimes> passes;
        if (!rule_.passes) return passes;
        for (const std::string& pass : passNames(frames_[rounds.front()])) {
            RoundTimes times;
            for (const std::size_t i : rounds) times.push_back(passTimes(frames_[i], pass));
            const std::size_t frames = frames_[rounds.front()].size();
            if (std::ranges::all_of(
                    times, [&](const auto& round) { return round.size() == frames; }))
                passes.push_back(std::move(times));
        }
        return passes;
    }

    // A pass takes as long to assess as the frames, and matters only once the frames are known.
    template <class Passes>
    static Assessment assessed(double precision, const RoundTimes& times, Passes&& passes) {
        const Assessment whole = assess(times);
        return isEnough(whole, precision) ? assess(times, passes()) : whole;
    }

    void look() {
        assessment();
        if (looking_.valid()) return;  // the last assessment is still running
        const std::vector<std::size_t> clean = cleanRounds();
        looked_at_ = clean.size();
        if (rule_.overlaps_assessment) {
            looking_ = std::async(
                std::launch::async,
                [precision = rule_.precision, times = timesOf(clean), passes = passesOf(clean)] {
                    return assessed(precision, times, [&] { return passes; });
                });
        } else {
            assessment_ =
                assessed(rule_.precision, timesOf(clean), [&] { return passesOf(clean); });
        }
    }

    const SamplingRule& rule_;
    report::HighestClocks held_before_;
    report::HighestClocks held_;
    RoundTimes times_;
    std::vector<std::vector<FrameRecord>> frames_;  // [round][frame]
    std::vector<report::Conditions> conditions_;  // [round]
    std::optional<Assessment> assessment_;
    std::future<Assessment> looking_;
    std::size_t looked_at_ = 0;  // number of clean rounds in the last assessment
};

}  // namespace

SampledRounds
sampleRounds(const SamplingRule& rule, const SamplingTools& tools, report::HighestClocks* held) {
    Series series(rule, held ? *held : report::HighestClocks());
    const double begin = tools.seconds();
    double seconds = 0.0;
    std::uint32_t played = 0;
    bool rested = true;
    for (bool more = true; more;) {
        if (std::exchange(rested, false) && tools.begin) tools.begin();
        std::vector<FrameRecord> frames = tools.play();
        ++played;
        if (series.add(std::move(frames), tools.conditions())) {
            tools.pause(kThrottlePause);
            rested = true;
        }
        seconds = tools.seconds() - begin;
        const std::size_t clean = series.cleanRounds().size();
        more = seconds < rule.max_time;
        if (clean == 0) {
            more = more || played < kThrottledTries;
            continue;
        }
        const Assessment* now = series.assessment();
        more = more && clean < rule.most_rounds && !(now && isEnough(*now, rule.precision));
        if (tools.progress && now) {
            tools.progress(
                {.mode = rule.mode,
                 .rounds = static_cast<std::uint32_t>(clean),
                 .median = now->median,
                 .relative_half_width = now->relative_half_width,
                 .seconds = seconds,
                 .max_seconds = rule.max_time});
        }
    }
    SampledRounds result = series.take();
    result.sampling.seconds = seconds;
    if (held && report::isFullyLoaded(medianConditions(result.conditions)))
        held->raise(series.held());
    return result;
}

// ---- Warm-up ------------------------------------------------------------------------------------

namespace {

constexpr double kWindow = 0.05;  // s
constexpr double kSteadyShare = 0.01;

}  // namespace

WarmUp
warmUp(RoundPlayer& player, Stage& stage, double FrameRecord::* time, double least, double most) {
    const double begin = stage.seconds();
    WarmUp result;
    // ms, in the last window: the judged time and the device's time. If the host is slower, the
    // judged time is steady long before the clock is.
    double before = 0.0;
    double device_before = 0.0;
    while (!result.steady && result.seconds < most) {
        const double window = stage.seconds();
        std::vector<double> times;
        std::vector<double> device_times;
        std::uint32_t plays = 0;
        double counted = 0.0;
        do {
            for (const FrameRecord& frame : player.stream(1)) {
                times.push_back(frame.*time);
                device_times.push_back(frame.device.value_or(0.0));
                counted += frame.*time;
            }
            ++plays;
        } while (stage.seconds() - window < kWindow);
        const double now = report::quantile(times, 0.5);
        result.seconds = stage.seconds() - begin;
        result.play = (stage.seconds() - window) / plays;
        result.counted = counted / plays;
        const double device_now = report::quantile(device_times, 0.5);
        result.steady = result.seconds >= least && std::abs(now - before) <= kSteadyShare * now &&
                        std::abs(device_now - device_before) <= kSteadyShare * device_now;
        before = now;
        device_before = device_now;
    }
    return result;
}

namespace {

// ---- A mode of a case ---------------------------------------------------------------------------

// Number of overlapped frames to start before an interval is as long as a frame: nothing waits
// until slots are reused. On lavapipe, a wait for one frame ends only when all submitted frames are
// done. If two frames may be in flight, its first wait is therefore for both.
std::uint32_t queueOf(const Stage& stage, engine::Timing timing, const hair::RunSettings& run) {
    if (timing != engine::Timing::overlapped) return 0;
    return run.frames_in_flight + (stage.isProcessor() ? 1 : 0);
}

report::Mode modeOf(engine::Timing timing) {
    switch (timing) {
    case engine::Timing::overlapped:
        return report::Mode::overlapped;
    case engine::Timing::isolated:
        return report::Mode::isolated;
    case engine::Timing::wall_clock:
        return report::Mode::wall_clock;
    case engine::Timing::statistics:
        break;
    }
    return report::Mode::other;
}

// Largest shares of max_time for a warm-up and for a round.
constexpr double kMostWarmUp = 0.25;
constexpr double kMostRound = 0.125;

// Returns the number of plays that measure for /run/round_time, and a little longer because the
// device's clock may still rise.
std::uint32_t playsOfRound(const WarmUp& found, const hair::RunSettings& run) {
    const double measured = found.counted * 1e-3;
    const double wanted = 1.05 * double{run.round_time} / std::max(measured, 1e-9);
    const double most = kMostRound * double{run.max_time} / std::max(found.play, 1e-9);
    return static_cast<std::uint32_t>(std::clamp(std::ceil(std::min(wanted, most)), 1.0, 1e6));
}

}  // namespace

SamplingRule samplingRule(engine::Timing timing, const hair::RunSettings& run) {
    return {
        .mode = report::modeName(modeOf(timing)),
        .time = timing == engine::Timing::overlapped ? &engine::FrameRecord::interval
                                                     : &engine::FrameRecord::wall,
        .precision = double{run.precision},
        .max_time = double{run.max_time}};
}

SampledMode sampleMode(
    Stage& stage, engine::Timing timing, const SamplingRule& rule, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result) {
    using Counts = RoundPlayer::Counts;
    RoundPlayer player(
        stage.player(timing), run, rule.counts ? Counts::last_frame : Counts::nothing,
        queueOf(stage, timing, run));
    const bool follows = timing == Timing::wall_clock && rule.max_time <= 0.0;
    const bool streams = !stage.isProcessor() && rule.max_time > 0.0 && run.round_time > 0.0f;
    SamplingRule this_rule = rule;
    this_rule.overlaps_assessment = streams && stage.overlapsAssessment();
    std::optional<std::uint32_t> plays;  // per round, in a stream
    if (streams) {
        player.round();
        player.firstEnd();
    }
    const SamplingTools tools{
        .play =
            [&] {
                if (follows) return player.more();
                return streams ? player.stream(*plays) : player.round();
            },
        .begin =
            [&] {
                if (streams) {
                    const WarmUp found = warmUp(
                        player, stage, rule.time, double{run.warmup_time},
                        std::max(double{run.warmup_time}, kMostWarmUp * rule.max_time));
                    // Every round has as many frames as the first.
                    if (!plays) plays = playsOfRound(found, run);
                }
                stage.beginWatch();
            },
        .conditions = [&] { return stage.conditions(); },
        .seconds = [&] { return stage.seconds(); },
        .pause =
            [&](double seconds) {
                if (streams) player.drain();
                stage.pause(seconds);
            },
        .progress = hooks.progress};
    report::HighestClocks* const held =
        hooks.known ? &hooks.known->held_clocks[run.clocks] : nullptr;
    SampledMode mode{sampleRounds(this_rule, tools, held), player.firstFrame(), {}};
    if (streams) player.drain();
    mode.sampling.plays = plays.value_or(1);
    if (!follows) {
        mode.end = player.lastEnd();
        const RoundEnd& first = player.firstEnd();
        if (mode.end.picture_hash != first.picture_hash)
            result.trust.warnings.push_back(rule.mode + " rounds made different pictures");
        if (mode.end.state_hash != first.state_hash)
            result.trust.warnings.push_back(rule.mode + " rounds made different states");
    }
    result.sampling.push_back(mode.sampling);
    return mode;
}

}  // namespace benchmarks::measure
