#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
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

// What passes between the window and the thread that measures: how far it is, and whether it is to
// go on. The window holds still meanwhile, for what it draws would be in the figures: it draws one
// picture after each round, and the next round begins when that is done.
class MeasureLink {
public:
    // `told` is called on the thread that measures when there is something to show.
    explicit MeasureLink(std::function<void()> told) : told_(std::move(told)) {}

    // For the thread that measures.
    measure::MeasureHooks hooks();

    // For the window: the state that it is to show, after which it calls shown().
    std::optional<measure::SamplingState> take();
    void shown();
    void cancel();
    bool isCancelled() const { return cancelled_; }
    void restart();  // for another measurement

private:
    void tell(const measure::SamplingState& state);

    std::function<void()> told_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<measure::SamplingState> state_;
    bool waits_ = false;  // the thread that measures, for the window
    std::atomic<bool> cancelled_ = false;
};

// Asks for measurements of what a side shows as the runner measures it, and shows and saves what
// came of them.
class MeasurePanel {
public:
    // `told` as MeasureLink.
    MeasurePanel(const engine::Device& device, std::function<void()> told)
        : device_(device), link_(std::move(told)) {}

    // Shows, within the current window of Dear ImGui, a button for each of one or two sides, what
    // was measured and the button that saves it. While it is measured: how far it is, in front of
    // everything else, and a button that ends it.
    void show(std::size_t sides, const ReportOrigin& origin);

    // The side whose button was pressed; begin() is to be called, with the window's next picture
    // shown before the measurement begins, and end() once it is over.
    std::optional<std::size_t> wanted() const { return wanted_; }
    measure::MeasureHooks begin();
    void end(std::optional<SideMeasurement> measured, const std::string& why_not);
    bool isMeasuring() const { return measuring_; }

    // Whether another picture is to be shown while it is measured; the measurement goes on after
    // shown().
    bool wantsPicture();
    void shown() { link_.shown(); }
    void cancel() { link_.cancel(); }

private:
    void buttons(std::size_t sides);
    void progress();

    const engine::Device& device_;
    MeasureLink link_;
    std::optional<std::size_t> wanted_;
    std::size_t side_ = 0;  // that is measured
    std::string kind_ = "viewer";  // kind of the last report, for its file name
    bool measuring_ = false;
    std::optional<measure::SamplingState> state_;
    std::optional<SideMeasurement> measured_;
    std::string told_;
    SaveBox save_{"Save report…"};
};

}  // namespace benchmarks::viewer
