#include "benchmarks/viewer/tools/moment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmarks/viewer/play/pacer.h"

namespace benchmarks {

Moment momentAfter(std::uint32_t frame, double frame_time, double time_step) {
    const double step = frame_time > 0.0 ? frame_time : time_step;
    // The same product for the same frame whichever frame it is asked in: a key that was written
    // for a frame is at that frame's time, to the last bit.
    const auto after = [&](double frames) {
        if (frame_time > 0.0)
            return static_cast<float>((static_cast<double>(frame) + 1.0 + frames) * step);
        return static_cast<float>(frames * step);
    };
    const auto ascending = [](float before, float time) {
        return std::max(time, std::nextafter(before, std::numeric_limits<float>::max()));
    };
    Moment moment{.now = after(0.0)};
    moment.next = ascending(moment.now, after(1.0));
    moment.later = ascending(moment.next, after(1.0 + Pacer::kMostFrames));
    return moment;
}

Moment momentOf(const Player& player) {
    const hair::Settings& settings = player.settings();
    return momentAfter(
        player.frame(), double{settings.run.frame_time}, double{settings.simulation.time_step});
}

}  // namespace benchmarks
