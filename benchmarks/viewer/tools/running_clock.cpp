#include "benchmarks/viewer/tools/running_clock.h"

namespace benchmarks {

namespace {

constexpr double kPause = 0.5;  // s without a new frame: longer than a slow device takes for one

}  // namespace

bool RunningClock::runs(const Player& player, double seconds) {
    const auto [entry, is_new] = seen_.try_emplace(&player, Seen{.frame = player.frame()});
    Seen& seen = entry->second;
    if (seen.frame != player.frame()) seen = {player.frame(), seconds};
    return seconds - seen.since < kPause;
}

}  // namespace benchmarks
