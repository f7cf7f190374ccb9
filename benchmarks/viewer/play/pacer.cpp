#include "benchmarks/viewer/play/pacer.h"

#include <algorithm>
#include <cmath>

namespace benchmarks {

std::uint32_t Pacer::framesFor(double seconds, double frame_time, std::optional<double> speed) {
    if (!speed) {
        due_ = 0.0;
        return 1;
    }
    if (frame_time <= 0.0) return 0;
    due_ = std::min(due_ + seconds * *speed / frame_time, double{kMostFrames});
    const double whole = std::floor(due_);
    due_ -= whole;
    return static_cast<std::uint32_t>(whole);
}

}  // namespace benchmarks
