#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/viewer/measure_panel.h"
#include "benchmarks/viewer/timings.h"

namespace benchmarks::viewer {

// What is known of the window itself.
struct WindowFigures {
    double device = 0.0;  // ms on its device that its last picture took; in no other figure
    double slowest_answer = 0.0;  // ms from input to the picture that shows it, at most
    double pictures_per_second = 0.0;  // of the scene; 0: none came of late
    std::uint64_t memory = 0;          // B of its device
};

// The panel that says where the time goes: bars and history of each pass with median and 1 % low,
// CPU and device, overlap, pipeline statistics and memory.
class TimingsPanel {
public:
    // `told`: called on the thread that measures when there is something to show of it.
    TimingsPanel(const engine::Device& device, std::function<void()> told)
        : device_(device), measure_(device, std::move(told)) {}

    // Within the current window of Dear ImGui. `compared`: the other side, whose figures are shown
    // beside; null: none. `origin` is what reports quote.
    void show(Side& side, Side* compared, const ReportOrigin& origin, const WindowFigures& window);

    // What is known of the device on which the sides are drawn.
    void setMemory(const engine::MemoryLedger& memory) { memory_ = memory; }
    void setReplacedShaders(std::vector<std::string> replaced) { replaced_ = std::move(replaced); }

    // The side whose counts the user asked for; setCounts() answers.
    std::optional<std::uint64_t> wantsCounts() const { return wants_counts_; }
    void setCounts(report::CaseResult result, const Side& side);
    void forgetCounts() { wants_counts_.reset(); }  // of a side that is gone

    // The part of the panel that measures as the runner does.
    MeasurePanel& measuring() { return measure_; }
    const MeasurePanel& measuring() const { return measure_; }

private:
    // Pipeline statistics, and the history and frame that they are of.
    struct Counted {
        report::CaseResult result;
        std::uint64_t side = 0;
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
    std::optional<std::uint64_t> wants_counts_;
    std::optional<Counted> counted_;
    engine::MemoryLedger memory_;
    std::vector<std::string> replaced_;  // shaders that are not those of the build
    SaveBox export_{"Export frozen…"};
};

}  // namespace benchmarks::viewer
