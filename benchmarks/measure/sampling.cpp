#include "benchmarks/measure/sampling.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <span>
#include <thread>
#include <utility>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/steady_state.h"
#include "benchmarks/report/environment.h"
#include "engine/error.h"

namespace benchmarks::measure {

using engine::FrameRecord;
using engine::Timing;

// ---- Rounds of one mode -------------------------------------------------------------------------

void playFrame(engine::FrameLoop& loop, const Play& play) {
    if (play.hooks.stop()) throw engine::Interrupted();
    loop.frame([&](engine::Passes& passes) {
        if (!play.busy) {
            play.test_case.frame(passes);
            return;
        }
        BusyPasses slowed(passes, *play.busy);
        play.test_case.frame(slowed);
    });
}

RoundPlayer::RoundPlayer(const Play& play, engine::Timing timing)
    : play_(play), loop_(play.device, timing) {}

std::vector<engine::FrameRecord> RoundPlayer::round() {
    if (rounds_ == 1) firstEnd();
    play_.test_case.reset();
    playFrame(loop_, play_);
    if (rounds_ == 0) first_frame_ = loop_.finish().front().interval;
    for (std::uint32_t i = 1; i < play_.run.warmup; ++i) playFrame(loop_, play_);
    // The interval of the last frame contains the wait for it: one more frame is drawn than
    // measured.
    for (std::uint32_t i = 0; i <= play_.run.frames; ++i) playFrame(loop_, play_);
    const std::vector<engine::FrameRecord> frames = loop_.finish();
    ++rounds_;
    return {frames.end() - 1 - play_.run.frames, frames.end() - 1};
}

const RoundEnd& RoundPlayer::firstEnd() {
    if (!first_end_) first_end_ = readEnd();
    return *first_end_;
}

RoundEnd RoundPlayer::lastEnd() { return rounds_ == 1 ? firstEnd() : readEnd(); }

RoundEnd RoundPlayer::readEnd() const {
    RoundEnd end{.picture = play_.test_case.picture(), .picture_hash = {}, .state_hash = {}};
    end.picture_hash = report::hashBytes(std::as_bytes(std::span(end.picture)));
    end.state_hash = play_.test_case.stateHash();
    return end;
}

namespace {

// ---- Rounds until the median is known -----------------------------------------------------------

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
    std::vector<report::Conditions> conditions;
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

namespace {

// ---- A mode of a case ---------------------------------------------------------------------------

using Seconds = std::chrono::duration<double>;

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
    const Play& play, engine::Timing timing, const SamplingRule& rule, MachineWatch& watch,
    report::CaseResult& result) {
    RoundPlayer player(play, timing);
    const SamplingTools tools{
        .play =
            [&] {
                std::vector<engine::FrameRecord> frames = player.round();
                if (play.busy) play.busy->checkThatItRan();
                return frames;
            },
        .begin_watch = [&] { watch.begin(); },
        .end_watch = [&] { return watch.end(); },
        .seconds =
            [] { return Seconds(std::chrono::steady_clock::now().time_since_epoch()).count(); },
        .pause = [](double seconds) { std::this_thread::sleep_for(Seconds(seconds)); },
        .progress = play.hooks.progress};
    SampledMode mode{sampleRounds(rule, tools), player.firstFrame(), player.lastEnd()};
    const RoundEnd& first = player.firstEnd();
    if (mode.end.picture_hash != first.picture_hash)
        result.trust.warnings.push_back(rule.mode + " rounds made different pictures");
    if (mode.end.state_hash != first.state_hash)
        result.trust.warnings.push_back(rule.mode + " rounds made different states");
    result.sampling.push_back(mode.sampling);
    return mode;
}

}  // namespace benchmarks::measure
