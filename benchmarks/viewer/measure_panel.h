#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "benchmarks/measure/measure.h"
#include "benchmarks/viewer/timings.h"

// The runner's measurement at a button, with the widgets for figures and files that the panel of
// timings has too.
namespace benchmarks::viewer {

// A tooltip for the last item; none for an empty text.
void helpMarker(const char* help);

// Text at the right end of the room that is left in a line or cell.
void rightText(const std::string& text);

// A table of lines "what  figure", and where two sides are compared "what  A  B  B / A". Long names
// take several lines.
class FigureTable {
public:
    enum class Columns { one, compared };

    // Within the current window of Dear ImGui, until the table leaves its scope. `title` says what
    // all figures are; it may be empty.
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

// A button that asks for a path and writes a file there, and says what came of it.
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
    std::string problem_;  // why the last try failed
    std::string told_;  // what was written
};

// How the window lives on while something is measured.
struct MeasuringWindow {
    // Draws a picture of the window in which nothing is played. Called between rounds: what the
    // device does beside frames would be in their times.
    std::function<void()> picture;
    // Looks at the window's events, and says whether it is to close. Called between frames, a few
    // times a second.
    std::function<bool()> closes;
};

// Measures what a side shows as the runner does, and shows and saves what came of it.
class MeasurePanel {
public:
    explicit MeasurePanel(const engine::Device& device) : device_(device) {}

    // Shows, within the current window of Dear ImGui, a button for each of one or two sides, what
    // was measured and the button that saves it. While it is measured: how far it is, in front of
    // everything else, and a button that ends it.
    void show(std::size_t sides, const ReportOrigin& origin);

    // The side whose button was pressed: measure() is to be called next, between two pictures of
    // the window.
    std::optional<std::size_t> wanted() const { return wanted_; }
    void measure(const Side& side, const ReportOrigin& origin, const MeasuringWindow& window);

private:
    void buttons(std::size_t sides);
    void progress();

    const engine::Device& device_;
    std::optional<std::size_t> wanted_;
    std::string kind_ = "viewer";  // kind of the last report, for its file name
    bool measuring_ = false;
    bool cancelled_ = false;
    std::optional<measure::SamplingState> state_;
    std::optional<SideMeasurement> measured_;
    std::string told_;
    SaveBox save_{"Save report…"};
};

}  // namespace benchmarks::viewer
