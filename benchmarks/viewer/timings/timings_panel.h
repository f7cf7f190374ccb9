#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "benchmarks/viewer/play/side.h"
#include "benchmarks/viewer/timings/frozen_side.h"
#include "benchmarks/viewer/timings/measure_panel.h"
#include "benchmarks/viewer/timings/save_box.h"
#include "benchmarks/viewer/timings/viewer_report.h"

namespace benchmarks {

// Where the time goes, within the current window of Dear ImGui: bars and history of each pass with
// median and 1 % low, CPU and device, overlap, pipeline statistics and memory.
class TimingsPanel {
public:
    explicit TimingsPanel(const engine::Device& device) : device_(device), measure_(device) {}

    // `ui_milliseconds`: of the device, for the window itself, which is in no other figure.
    // `compared`: the other side's, shown beside; null: none. `origin`: what reports say of it.
    void show(Side& side, Side* compared, const ReportOrigin& origin, double ui_milliseconds);

    bool frozen() const { return frozen_.has_value(); }

    // The runner's measurement, where its button was pressed: see measure_panel.h.
    MeasurePanel& measuring() { return measure_; }

private:
    // What was counted, of which history.
    struct Counted {
        CaseResult result;
        std::uint64_t revision = 0;
        std::uint32_t frame = 0;
    };

    void controls(Side& side, Side* compared, const ReportOrigin& origin);
    void statistics(Side& side);
    const CaseResult* countedOf(const Side& side) const;

    const engine::Device& device_;
    MeasurePanel measure_;
    std::vector<double> ui_;  // ms, of the last pictures of the window
    std::optional<FrozenSide> frozen_;
    std::optional<ShownSide> frozen_compared_;
    std::optional<Counted> counted_;
    SaveBox export_{"Export frozen…"};
};

}  // namespace benchmarks
