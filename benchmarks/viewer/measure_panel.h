#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/report/report.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/timings.h"
#include "engine/device.h"
#include "hair/settings.h"

namespace benchmarks::viewer {

// Adds a warning where shaders are not those that the program was built with: a report of them is
// none of the build that it names.
void warnOfChangedShaders(const engine::Device& device, report::Trust& trust);

// Draws the frame that a case shows once more, untimed, and counts with pipeline statistics as the
// runner does: result.statistics, and a warning for each count that is not as expected. The frame
// and its picture stay what they were. Nothing where the device counts none.
report::CaseResult countStatistics(const engine::Device& device, measure::Case& shown);

// What was shown of a side when the user froze it.
struct FrozenSide {
    ShownSide shown;
    hair::Settings settings;
    std::uint32_t frame = 0;  // that the hashes are of
};

// With what reading back from the device tells: hashes of the picture and the guides, unless the
// side shows no frame of its settings, and what blended fragments took.
FrozenSide frozenSide(const Side& side, ShownSide shown);

// What a report has of it: the metrics in their modes, `statistics` (countStatistics(), or
// nothing), and warnings that say how it was all measured.
report::CaseResult frozenResult(const FrozenSide& frozen, const report::CaseResult& statistics);

// A button that asks where a file is to go and writes it there, and what came of it.
class SaveBox {
public:
    explicit SaveBox(std::string button) : button_(std::move(button)) {}

    // Within the current window of Dear ImGui. `suggested` is asked for when the box opens; `write`
    // throws engine::Error.
    void show(
        const std::filesystem::path& suggested,
        const std::function<void(const std::filesystem::path&)>& write);

private:
    void save(const std::function<void(const std::filesystem::path&)>& write);

    std::string button_;
    std::string path_;
    std::string problem_;  // of the last try
    std::string told_;  // what was written
};

// What the runner found out of settings.
struct SideMeasurement {
    hair::Settings settings;
    report::CaseResult result;
    std::vector<std::uint8_t> picture;  // [row][column] RGBA, top row first: that which is hashed
};

// Measures settings as `hairbench run` does, with a case of its own, so that what is shown stays as
// it is. The memory in the result is that case's. What `hooks.progress` does to the device, such as
// a picture of the window, is done before the next round begins. Throws as Case and measure().
SideMeasurement measureSide(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, const std::string& name,
    const measure::MeasureHooks& hooks);

// Where what the viewer shows came from.
struct ReportOrigin {
    std::filesystem::path scene;
    std::string name;  // of the scene
    std::vector<std::string> command;  // line that the viewer was started with
    engine::Validation validation = engine::Validation::off;
};

// The report of one case, as the runner's of a scene that has these settings and no sweep.
report::Report viewerReport(
    const engine::Device& device, const ReportOrigin& origin, const hair::Settings& settings,
    report::CaseResult result);

// results/local/<scene>-<kind>.json
std::filesystem::path reportPath(const ReportOrigin& origin, const std::string& kind);

// Writes it, with the case's picture beside it where there is one: [row][column] RGBA, top row
// first. Throws engine::Error "<path>: <reason>".
void saveReport(
    report::Report report, const hair::RenderSettings& render,
    std::span<const std::uint8_t> picture, const std::filesystem::path& file);

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
    std::optional<measure::SamplingState> state_;
    std::optional<SideMeasurement> measured_;
    std::string told_;
    SaveBox save_{"Save report…"};
};

}  // namespace benchmarks::viewer
