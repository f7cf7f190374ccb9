#include "benchmarks/viewer/picture/frame_time_caption.h"

#include <vector>

#include "benchmarks/statistics.h"
#include "benchmarks/table.h"

namespace benchmarks {

std::string frameTimeCaption(const TimingHistory& history) {
    std::vector<double> times;
    for (const engine::FrameRecord& frame : history.isolated().records) times.push_back(frame.wall);
    return times.empty() ? "" : shortNumber(summarize(times).median) + " ms";
}

}  // namespace benchmarks
