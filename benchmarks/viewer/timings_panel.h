#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/measure/measure.h"
#include "benchmarks/viewer/side.h"
#include "benchmarks/viewer/timings.h"

// The panels of timings: measurements as the runner makes them, and figures of the shown frames.
namespace benchmarks::viewer {

// A tooltip for the last item; nothing for an empty text.
void helpMarker(const char* help);

// Right-aligns text in the rest of a line or cell.
void rightText(const std::string& text);

// A table with rows "name  figure", or "name  A  B  B / A" when comparing. Long names wrap.
class FigureTable {
public:
    enum class Columns { one, compared };

    // Opens the table within the current Dear ImGui window, until this leaves its scope. `title`
    // describes all figures; it may be empty.
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

// A button that asks for a path, writes a file there, and reports the result.
class SaveBox {
public:
    explicit SaveBox(std::string button) : button_(std::move(button)) {}

    // Shows the button within the current Dear ImGui window. `suggested` is the initial path;
    // `write` may throw engine::Error.
    void show(
        const std::filesystem::path& suggested,
        const std::function<void(const std::filesystem::path&)>& write);

private:
    void save(const std::function<void(const std::filesystem::path&)>& write);

    std::string button_;
    std::string path_;
    std::string problem_;  // why the last try failed
    std::string told_;  // message about the written file
};

// Passes progress and cancellation between the window and the measuring thread. The window must not
// draw during a measurement, because that would distort the figures. So it draws one picture after
// each round, and the next round starts once that is done.
class MeasureLink {
public:
    // `told` is called on the measuring thread when there is progress to show.
    explicit MeasureLink(std::function<void()> told) : told_(std::move(told)) {}

    // For the measuring thread.
    measure::MeasureHooks hooks();

    // For the window: returns the state to show. The window then calls shown().
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
    bool waits_ = false;  // the measuring thread waits for the window
    std::atomic<bool> cancelled_ = false;
};

// Requests measurements of a side as the runner makes them, and shows and saves their results.
class MeasurePanel {
public:
    // `told`: see MeasureLink.
    MeasurePanel(const engine::Device& device, std::function<void()> told)
        : device_(device), link_(std::move(told)) {}

    // Shows, within the current Dear ImGui window, a measure button for each of one or two sides,
    // the results, and a button that saves them. During a measurement, shows progress and a cancel
    // button above everything else.
    void show(std::size_t sides, const ReportOrigin& origin);

    // Returns the side with a pressed button. The caller then calls begin(), shows one more picture
    // of the window before the measurement starts, and calls end() after it.
    std::optional<std::size_t> wanted() const { return wanted_; }
    measure::MeasureHooks begin();
    void end(std::optional<SideMeasurement> measured, const std::string& why_not);
    bool isMeasuring() const { return measuring_; }

    // Whether to show another picture during the measurement. The measurement continues after
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
    std::size_t side_ = 0;  // the measured side
    std::string kind_ = "viewer";  // kind of the last report, for its file name
    bool measuring_ = false;
    std::optional<measure::SamplingState> state_;
    std::optional<SideMeasurement> measured_;
    std::string told_;
    SaveBox save_{"Save report…"};
};

// ---- Timings ------------------------------------------------------------------------------------

// Figures of the window itself.
struct WindowFigures {
    double device = 0.0;  // ms, device time of its last picture; included in no other figure
    double slowest_answer = 0.0;  // ms, maximum from input to the picture that shows it
    double pictures_per_second = 0.0;  // of the scene; 0: none recently
    std::uint64_t memory = 0;  // B of its device
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
