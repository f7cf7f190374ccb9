#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "benchmarks/viewer/measure_panel.h"
#include "benchmarks/viewer/timings.h"

namespace benchmarks::viewer {

// The panel that says where the time goes: bars and history of each pass with median and 1 % low,
// CPU and device, overlap, pipeline statistics and memory.
class TimingsPanel {
public:
    explicit TimingsPanel(const engine::Device& device) : device_(device), measure_(device) {}

    // Within the current window of Dear ImGui. `compared`: the other side, whose figures are shown
    // beside; null: none. `origin` is what reports quote. `ui_milliseconds`: what the window itself
    // took of the device, which is in no other figure.
    void show(Side& side, Side* compared, const ReportOrigin& origin, double ui_milliseconds);

    // The part of the panel that measures as the runner does.
    MeasurePanel& measuring() { return measure_; }

private:
    // Pipeline statistics, and the history and frame that they are of.
    struct Counted {
        report::CaseResult result;
        std::uint64_t revision = 0;
        std::uint32_t frame = 0;
    };

    bool frozen() const { return frozen_.has_value(); }
    void controls(Side& side, Side* compared, const ReportOrigin& origin);
    void statistics(Side& side);
    const report::CaseResult* countedOf(const Side& side) const;

    const engine::Device& device_;
    MeasurePanel measure_;
    std::vector<double> ui_;  // ms of the device for the last pictures of the window
    std::optional<FrozenSide> frozen_;
    std::optional<ShownSide> frozen_compared_;
    std::optional<Counted> counted_;
    SaveBox export_{"Export frozen…"};
};

}  // namespace benchmarks::viewer
