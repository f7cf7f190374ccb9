#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "benchmarks/viewer/play/side.h"
#include "benchmarks/viewer/timings/save_box.h"
#include "benchmarks/viewer/timings/side_measurement.h"
#include "benchmarks/viewer/timings/viewer_report.h"

namespace benchmarks {

// How the window lives on while something is measured.
struct MeasuringWindow {
    // Draws a picture of the window in which nothing is played. Between rounds: what the device
    // does beside frames would be in their times.
    std::function<void()> picture;
    // Looks at what happened to the window, and says whether it is to close. Between frames, a few
    // times a second.
    std::function<bool()> closes;
};

// The runner's measurement of what a side shows, at a button: within a window of Dear ImGui, but
// for the measurement itself.
class MeasurePanel {
public:
    explicit MeasurePanel(const engine::Device& device) : device_(device) {}

    // A button for each of one or two sides, what was measured and the button that saves it. While
    // it is measured: how far it is, in front of everything else, and a button that ends it.
    void show(std::size_t sides, const ReportOrigin& origin);

    // The side whose button was pressed: then measure() is to be called, outside of Dear ImGui's
    // picture.
    std::optional<std::size_t> wanted() const { return wanted_; }
    void measure(const Side& side, const ReportOrigin& origin, const MeasuringWindow& window);

private:
    void buttons(std::size_t sides);
    void progress();

    const engine::Device& device_;
    std::optional<std::size_t> wanted_;
    std::string kind_ = "viewer";  // of report that the last one is
    bool measuring_ = false;
    bool cancelled_ = false;
    std::optional<SamplingState> state_;
    std::optional<SideMeasurement> measured_;
    std::string told_;
    SaveBox save_{"Save report…"};
};

}  // namespace benchmarks
