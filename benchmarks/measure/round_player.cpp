#include "benchmarks/measure/round_player.h"

#include <span>

#include "benchmarks/hash.h"

namespace benchmarks {

using engine::FrameRecord;

void playFrame(engine::FrameLoop& loop, const Play& play) {
    if (play.hooks.stop()) throw Interrupted();
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

std::vector<FrameRecord> RoundPlayer::round() {
    if (rounds_ == 1) firstEnd();
    play_.test_case.reset();
    playFrame(loop_, play_);
    if (rounds_ == 0) first_frame_ = loop_.finish().front().interval;
    for (std::uint32_t i = 1; i < play_.run.warmup; ++i) playFrame(loop_, play_);
    // The interval of the last frame contains the wait for it: one more frame is drawn than
    // measured.
    for (std::uint32_t i = 0; i <= play_.run.frames; ++i) playFrame(loop_, play_);
    const std::vector<FrameRecord> frames = loop_.finish();
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
    end.picture_hash = hashBytes(std::as_bytes(std::span(end.picture)));
    end.state_hash = play_.test_case.stateHash();
    return end;
}

}  // namespace benchmarks
