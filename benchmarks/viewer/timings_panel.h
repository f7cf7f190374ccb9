#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/viewer/measure_panel.h"
#include "benchmarks/viewer/player.h"

namespace benchmarks::viewer {

// The text for something that may not be known: "-".
std::string numberText(std::optional<double> number);

// Explains the item before it to the mouse that rests on it.
void helpMarker(const char* help);

// Text at the right end of the room that is left in a line or cell.
void rightText(const std::string& text);

// Lines "what  figure", and where two sides are compared "what  A  B  B / A". Names that have no
// room in a line take two.
class FigureTable {
public:
    enum class Columns { one, compared };

    // Within the current window of Dear ImGui, until it leaves its scope. `title`: what all figures
    // are; empty: nothing is said.
    FigureTable(const char* id, Columns columns, const char* title = "");
    ~FigureTable();
    FigureTable(const FigureTable&) = delete;
    FigureTable& operator=(const FigureTable&) = delete;

    void
    row(const char* name, const char* help, std::optional<double> a,
        std::optional<double> b = std::nullopt);
    void row(const char* name, const char* help, const std::string& a, const std::string& b = {});

private:
    Columns columns_;
    bool open_ = false;
};

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
        report::CaseResult result;
        std::uint64_t revision = 0;
        std::uint32_t frame = 0;
    };

    void controls(Side& side, Side* compared, const ReportOrigin& origin);
    void statistics(Side& side);
    const report::CaseResult* countedOf(const Side& side) const;

    const engine::Device& device_;
    MeasurePanel measure_;
    std::vector<double> ui_;  // ms, of the last pictures of the window
    std::optional<FrozenSide> frozen_;
    std::optional<ShownSide> frozen_compared_;
    std::optional<Counted> counted_;
    SaveBox export_{"Export frozen…"};
};

}  // namespace benchmarks::viewer
