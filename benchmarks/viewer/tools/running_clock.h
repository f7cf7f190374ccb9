#pragma once

#include <cstdint>
#include <map>

#include "benchmarks/viewer/play/player.h"

namespace benchmarks {

// Whether frames are being played: seen by their numbers, so that it holds for a pause as for a
// device that is too slow.
class RunningClock {
public:
    // `seconds` of the window's clock.
    bool runs(const Player& player, double seconds);

private:
    struct Seen {
        std::uint32_t frame = 0;
        double since = -1e9;  // when another frame came
    };
    std::map<const Player*, Seen> seen_;
};

}  // namespace benchmarks
