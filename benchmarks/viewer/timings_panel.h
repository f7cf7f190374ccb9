#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/viewer/measure_panel.h"
#include "benchmarks/viewer/side.h"
#include "benchmarks/viewer/timings.h"

namespace benchmarks::viewer {

// Figures of the window itself.
struct WindowFigures {
    double device = 0.0;  // ms, device time of its last picture; included in no other figure
    double slowest_answer = 0.0;  // ms, maximum from input to the picture that shows it
    double pictures_per_second = 0.0;  // of the scene; 0: none recently
    std::uint64_t memory = 0;          // B of its device
};

// The panel of frame times: bars and history of each pass with median and 1 % low, CPU and device,
// overlap, pipeline statistics and memory.
class TimingsPanel {
public:
    // `told` is called on the measuring thread when there is progress to show.
    TimingsPanel(const engine::Device& device, std::function<void()> told)
        : device_(device), measure_(device, std::move(told)) {}

    // Shows the panel within the current Dear ImGui window. `compared` is the other side, with
    // figures beside; null: none. `origin` is for reports.
    void show(Side& side, Side* compared, const ReportOrigin& origin, const WindowFigures& window);

    // Facts about the device that draws the sides.
    void setMemory(const engine::MemoryLedger& memory) { memory_ = memory; }
    void setReplacedShaders(std::vector<std::string> replaced) { replaced_ = std::move(replaced); }

    // Returns the side with counts that the user requested; setCounts() answers.
    std::optional<std::uint64_t> wantsCounts() const { return wants_counts_; }
    void setCounts(report::CaseResult result, const Side& side);
    void forgetCounts() { wants_counts_.reset(); }  // for a side that is gone

    // The part of the panel that measures like the runner.
    MeasurePanel& measuring() { return measure_; }
    const MeasurePanel& measuring() const { return measure_; }

private:
    // Pipeline statistics, and their history and frame.
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
    std::vector<double> ui_;  // device time, ms, of the window's last pictures
    std::optional<FrozenSide> frozen_;
    std::optional<ShownSide> frozen_compared_;
    std::optional<std::uint64_t> wants_counts_;
    std::optional<Counted> counted_;
    engine::MemoryLedger memory_;
    std::vector<std::string> replaced_;  // shaders that differ from the build's
    SaveBox export_{"Export frozen…"};
};

}  // namespace benchmarks::viewer
