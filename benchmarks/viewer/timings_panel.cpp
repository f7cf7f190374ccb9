#include "benchmarks/viewer/timings_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <imgui.h>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/text.h"
#include "benchmarks/viewer/side.h"
#include "benchmarks/viewer/timings.h"
#include "engine/device.h"

namespace benchmarks::viewer {
namespace {

// ---- Bars ---------------------------------------------------------------------------------------

struct Share {
    std::string name;
    double amount = 0.0;
    ImU32 color = 0;
};

// Returns a distinct colour for each of the first eight, for dark and light backgrounds.
ImU32 seriesColor(std::size_t index) {
    // Okabe and Ito 2008, Color universal design, without black: distinguishable with any kind of
    // colour vision.
    static constexpr std::array<ImU32, 8> kColors{
        IM_COL32(86, 180, 233, 255), IM_COL32(230, 159, 0, 255),   IM_COL32(0, 158, 115, 255),
        IM_COL32(213, 94, 0, 255),   IM_COL32(204, 121, 167, 255), IM_COL32(0, 114, 178, 255),
        IM_COL32(200, 188, 40, 255), IM_COL32(140, 140, 140, 255)};
    return kColors[index % kColors.size()];
}

// A thin bar whose length is its share of the rest of a line or cell.
void shareBar(double share, ImU32 color) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 0.2f);
    const float length = static_cast<float>(std::clamp(share, 0.0, 1.0)) * size.x;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(
        corner, {corner.x + size.x, corner.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    draw.AddRectFilled(corner, {corner.x + length, corner.y + size.y}, color);
    ImGui::Dummy(size);
}

// Shows shares of a whole in one bar across the window. Tooltips have their name, amount and share.
void stackedBar(const char* id, std::span<const Share> shares, const char* unit) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 0.8f);
    ImGui::InvisibleButton(id, size);
    const bool hovered = ImGui::IsItemHovered();
    double sum = 0.0;
    for (const Share& share : shares) sum += share.amount;
    if (sum <= 0.0) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float mouse = ImGui::GetIO().MousePos.x;
    float left = corner.x;
    for (const Share& share : shares) {
        const float right = left + static_cast<float>(share.amount / sum) * size.x;
        draw.AddRectFilled({left, corner.y}, {right, corner.y + size.y}, share.color);
        if (hovered && mouse >= left && mouse < right)
            ImGui::SetTooltip(
                "%s: %s %s, %.0f %%", share.name.c_str(), report::shortNumber(share.amount).c_str(),
                unit, 100.0 * share.amount / sum);
        left = right;
    }
}

// ---- Figures of a frame -------------------------------------------------------------------------

FigureTable::Columns columnsFor(const ShownSide* compared) {
    return compared ? FigureTable::Columns::compared : FigureTable::Columns::one;
}

std::optional<double>
ofRate(const ShownSide* side, const std::function<std::optional<double>(const FrameRate&)>& get) {
    return side && side->rate ? get(*side->rate) : std::nullopt;
}

std::optional<double>
ofSplit(const ShownSide* side, const std::function<std::optional<double>(const FrameSplit&)>& get) {
    return side && side->split ? get(*side->split) : std::nullopt;
}

std::optional<double> lowOf(const FrameRate& rate) {
    if (!rate.low) return std::nullopt;
    return rate.low->percentile;
}

std::string lowHelp(const ShownSide& side) {
    std::string text = "the rate of the frame time at quantile 0.99";
    if (!side.rate || !side.rate->low)
        return text + "; known from 100 frames on: with fewer, it would be the slowest frame's";
    return text +
           ".\nBy the mean of the slowest 1 %: " + report::shortNumber(side.rate->low->mean) +
           "; by the frame at which the slowest reach 1 % of all the time: " +
           report::shortNumber(side.rate->low->integral);
}

void trustFigure(const ShownSide& side, const ShownSide* compared, FigureTable& table) {
    table.row(
        "Passes / frame",
        "Sum of the isolated passes divided by the frame's time on the CPU's clock: 1 if the "
        "device's timestamps "
        "are right and nothing else is running. A deviation of 10 % gives a warning",
        side.metrics.trust.pass_sum_over_wall,
        compared ? compared->metrics.trust.pass_sum_over_wall : std::nullopt);
}

// Shows the frame rate and the number of frames. `compared` may be null.
void frameFigures(const ShownSide& side, const ShownSide* compared) {
    FigureTable table("##frame", columnsFor(compared));
    const auto row = [&](const char* name, const char* help, auto get) {
        table.row(name, help, ofRate(&side, get), ofRate(compared, get));
    };
    row("FPS",
        "Number of isolated frames divided by their total time, by the CPU's clock from submission "
        "to completion. One frame and one pass run at a time. 'Measure' gives the runner's rate, "
        "with two frames in flight",
        [](const FrameRate& rate) { return std::optional(rate.fps); });
    row("1 % low FPS", lowHelp(side).c_str(), lowOf);
    row("Frame, ms", "Median of the isolated frames' time",
        [](const FrameRate& rate) { return std::optional(rate.median); });
    trustFigure(side, compared, table);
    const auto count = [&](const char* name, const char* help, auto member) {
        table.row(
            name, help, std::to_string(side.*member),
            compared ? std::to_string(compared->*member) : std::string());
    };
    count(
        "Isolated frames",
        "Frames whose passes are timed by themselves, between full barriers. The last 300 are kept",
        &ShownSide::isolated);
    count(
        "Overlapped frames", "Frames whose passes the device may overlap. The last 300 are kept",
        &ShownSide::overlapped);
}

// Shows the CPU and device times of a frame, and the time saved by overlap.
void splitFigures(const ShownSide& side, const ShownSide* compared) {
    if (!side.split) return;
    const std::array<Share, 3> cpu{
        Share{"recording", side.split->record, seriesColor(0)},
        Share{"submission", side.split->submit, seriesColor(3)},
        Share{"waiting for the device", side.split->wait, seriesColor(7)}};
    stackedBar("##cpu", cpu, "ms");
    FigureTable table("##split", columnsFor(compared), "median, ms");
    const auto row = [&](const char* name, const char* help, auto get) {
        const std::optional<double> a = ofSplit(&side, get), b = ofSplit(compared, get);
        if (a || b) table.row(name, help, a, b);
    };
    using Known = std::optional<double>;
    row("Recording", "CPU: recording the commands of an isolated frame.",
        [](const FrameSplit& split) { return Known(split.record); });
    row("Submission", "CPU: the call that submits the commands of an isolated frame.",
        [](const FrameSplit& split) { return Known(split.submit); });
    row("Waiting", "CPU: from submission until the device is done.",
        [](const FrameSplit& split) { return Known(split.wait); });
    row("CPU time",
        "CPU time of all threads of the program from recording to completion: on a software device "
        "the cost of a frame, however busy the machine is.",
        [](const FrameSplit& split) { return split.cpu; });
    row("Device", "From the first to the last timestamp of an isolated frame.",
        [](const FrameSplit& split) { return split.device; });
    row("Passes alone", "The isolated passes added up.",
        [](const FrameSplit& split) { return Known(split.pass_sum); });
    row("Overlapped",
        "From the first to the last timestamp of an overlapped frame, whose passes the device may "
        "overlap. Software devices write timestamps early, so this may be too short there",
        [](const FrameSplit& split) { return split.device_overlapped; });
    row("Saved",
        "Time that overlap within a frame saves the device: the passes alone minus the overlapped "
        "frame. The runner's frame.overlap also has the time that two frames in flight save",
        [](const FrameSplit& split) { return split.saved(); });
}

// ---- Memory and counts --------------------------------------------------------------------------

double bytesOf(const report::Metric& metric) { return metric.samples.front(); }

void line(
    const std::string& name, const char* help, double bytes, std::optional<double> share = {}) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name.c_str());
    helpMarker(help);
    if (share) shareBar(*share, seriesColor(0));
    ImGui::TableNextColumn();
    rightText(report::sizeText(static_cast<std::uint64_t>(bytes)));
}

// Shows device memory by purpose as bars, the largest first.
void memoryTable(const engine::MemoryLedger& ledger, double window) {
    std::vector<report::Metric> purposes = measure::memoryMetrics(ledger);
    double scene = 0.0;
    std::erase_if(purposes, [&](const report::Metric& metric) {
        if (metric.id.what != report::Measured::purpose) return true;
        scene += bytesOf(metric);
        return false;
    });
    std::ranges::sort(purposes, std::ranges::greater{}, bytesOf);
    if (!ImGui::BeginTable("##memory", 2, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    for (const report::Metric& metric : purposes)
        line(metric.id.part, "", bytesOf(metric), bytesOf(metric) / scene);
    line(
        "all of these",
        "Device memory that buffers and images hold, of both sides if two are compared", scene);
    line(
        "window",
        "Device memory that the window itself holds: its picture, and copies of the pictures in it",
        window);
    ImGui::EndTable();
}

// Shows the back end, and the counts "guides", "strands", "segments" and others.
void countTable(const report::CaseResult& shown, const report::CaseResult* compared) {
    FigureTable table(
        "##counts", compared ? FigureTable::Columns::compared : FigureTable::Columns::one);
    if (!shown.backend.name.empty())
        table.row(
            "drawn by", shown.backend.reason.c_str(), shown.backend.name,
            compared ? compared->backend.name : "");
    for (const auto& [name, count] : shown.counts) {
        std::string text = name, other;
        std::ranges::replace(text, '_', ' ');
        if (compared)
            for (const auto& [other_name, other_count] : compared->counts)
                if (other_name == name) other = report::countText(other_count);
        table.row(text.c_str(), "", report::countText(count), other);
    }
}

// ---- Line of a history --------------------------------------------------------------------------

// Draws a line through values as a Dear ImGui item, over the range of 0 and the values. Values that
// are not finite leave gaps. Returns the index of the value under the mouse.
std::optional<std::size_t>
sparkline(const char* id, std::span<const double> values, ImVec2 size, ImU32 color) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(id, size);
    if (values.empty()) return std::nullopt;
    double least = 0.0, most = 1e-9;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    const float line = std::max(1.0f, ImGui::GetFontSize() / 15.0f);
    const float step =
        values.size() > 1 ? (size.x - line) / static_cast<float>(values.size() - 1) : 0.0f;
    const auto point = [&](std::size_t i) {
        const double share = (values[i] - least) / (most - least);
        const float height = static_cast<float>(share) * (size.y - 2.0f * line);
        return ImVec2(
            corner.x + 0.5f * line + step * static_cast<float>(i),
            corner.y + size.y - line - height);
    };
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    std::vector<ImVec2> points;
    const auto end = [&] {
        draw.AddPolyline(
            points.data(), static_cast<int>(points.size()), color, ImDrawFlags_None, line);
        if (points.size() == 1) draw.AddCircleFilled(points.front(), line, color);
        points.clear();
    };
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i]))
            points.push_back(point(i));
        else
            end();
    }
    end();
    if (!ImGui::IsItemHovered()) return std::nullopt;

    const float place = step > 0.0f ? (ImGui::GetIO().MousePos.x - corner.x) / step : 0.0f;
    const auto last = static_cast<float>(values.size() - 1);
    const auto index = static_cast<std::size_t>(std::clamp(std::round(place), 0.0f, last));
    if (std::isfinite(values[index]))
        draw.AddCircleFilled(point(index), 2.5f * line, ImGui::GetColorU32(ImGuiCol_Text));
    return index;
}

// ---- Table of passes ----------------------------------------------------------------------------

constexpr float kLeastHistory = 4.0f;  // minimum width of a history, in letter heights

std::string percent(double share) {
    char text[16];
    std::snprintf(text, sizeof text, share < 0.0995 ? "%.1f %%" : "%.0f %%", 100.0 * share);
    return text;
}

// The columns that fit a table of passes.
struct PanelLayout {
    bool compared = false;
    bool history = false;
    bool share = false;

    int columns() const { return 2 + (compared ? 2 : 0) + (history ? 1 : 0) + (share ? 1 : 0); }
};

PanelLayout layoutFor(const PassRows& rows, bool compared) {
    const auto width = [](const char* text) {
        return ImGui::CalcTextSize(text).x + 2.0f * ImGui::GetStyle().CellPadding.x;
    };
    float name = width(rows.sum.name.c_str());
    for (const TimeSeries& pass : rows.passes) name = std::max(name, width(pass.name.c_str()));
    float room = ImGui::GetContentRegionAvail().x - name - width("0.0000");
    if (compared) room -= width("0.0000") + width("B / A");
    PanelLayout layout{.compared = compared};
    const float history = std::max(kLeastHistory * ImGui::GetFontSize(), width("history"));
    layout.history = room >= history;
    if (layout.history) room -= history;
    layout.share = room >= width("100 %");
    return layout;
}

std::string seriesText(const TimeSeries& series) {
    const report::Summary& times = series.summary;
    std::string text =
        "median " + report::shortNumber(times.median) + " ms of " + std::to_string(times.count) +
        " frames, MAD " + report::shortNumber(times.mad) + " ms\nfrom " +
        report::shortNumber(times.minimum) + " to " + report::shortNumber(times.maximum) + " ms";
    text += series.high ? "\n1 % high: 1 % of the frames took longer than " +
                              report::shortNumber(*series.high) + " ms"
                        : "\n1 % high: known from 100 frames on";
    return text;
}

void history(const TimeSeries& series, ImU32 color) {
    const ImVec2 size(
        std::max(ImGui::GetContentRegionAvail().x, 1.0f), ImGui::GetTextLineHeight() * 1.2f);
    const std::optional<std::size_t> at =
        sparkline(("##history of " + series.name).c_str(), series.times, size, color);
    if (!at) return;
    std::string text = series.name;
    if (!series.numbers.empty()) text += ", frame " + std::to_string(series.numbers[*at]);
    text += ": " + report::shortNumber(series.times[*at]) + " ms\n" + seriesText(series);
    ImGui::SetTooltip("%s", text.c_str());
}

struct Row {
    const TimeSeries& series;
    const TimeSeries* compared;
    std::optional<double> share;
    ImU32 color;
    std::string help;
};

void show(const Row& row, const PanelLayout& layout) {
    const double median = row.series.summary.median;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.series.name.c_str());
    std::string help = row.help + seriesText(row.series);
    if (row.share) help += "\n" + percent(*row.share) + " of all passes";
    helpMarker(help.c_str());
    if (row.share) shareBar(*row.share, row.color);
    if (layout.history) {
        ImGui::TableNextColumn();
        history(row.series, row.color);
    }
    ImGui::TableNextColumn();
    rightText(report::shortNumber(median));
    if (layout.share) {
        ImGui::TableNextColumn();
        if (row.share) rightText(percent(*row.share));
    }
    if (!layout.compared) return;
    ImGui::TableNextColumn();
    if (row.compared) rightText(report::shortNumber(row.compared->summary.median));
    ImGui::TableNextColumn();
    if (row.compared && median > 0.0)
        rightText(report::shortNumber(row.compared->summary.median / median));
}

void titles(const PanelLayout& layout) {
    ImGui::TableNextRow();
    const auto title = [](const char* text) {
        ImGui::TableNextColumn();
        rightText(text);
    };
    ImGui::TableNextColumn();
    ImGui::TextDisabled("pass");
    if (layout.history) title("history");
    title(layout.compared ? "A ms" : "ms");
    if (layout.share) title("share");
    if (!layout.compared) return;
    title("B ms");
    title("B / A");
}

bool beginTable(const char* id, const PanelLayout& layout) {
    if (!ImGui::BeginTable(id, layout.columns(), ImGuiTableFlags_SizingFixedFit)) return false;
    // Beside a history, which takes the rest of the width, names have their own width.
    ImGui::TableSetupColumn(
        "", layout.history ? ImGuiTableColumnFlags_WidthFixed : ImGuiTableColumnFlags_WidthStretch);
    if (layout.history) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

void bar(const PassRows& rows) {
    std::vector<Share> shares;
    for (std::size_t i = 0; i < rows.passes.size(); ++i)
        shares.push_back({rows.passes[i].name, rows.passes[i].summary.median, seriesColor(i)});
    stackedBar("##passes", shares, "ms");
}

// Shows a bar of all passes, and for each its median, share, history and, when comparing, the other
// side's median and the ratio. Below them, and in no sum, `ui` is the window itself; null: not
// known yet. Columns without room are left out, the share first; the name's tooltip has everything.
void passTable(const PassRows& rows, const PassRows* compared, const TimeSeries* ui) {
    bar(rows);
    const PanelLayout layout = layoutFor(rows, compared != nullptr);
    const ImU32 plain = ImGui::GetColorU32(ImGuiCol_Text);
    if (!beginTable("##pass table", layout)) return;
    titles(layout);
    for (std::size_t i = 0; i < rows.passes.size(); ++i) {
        const TimeSeries& pass = rows.passes[i];
        show(
            {pass, compared ? compared->find(pass.name) : nullptr, rows.share(pass), seriesColor(i),
             "by itself, between full barriers\n"},
            layout);
    }
    show(
        {rows.sum, compared ? &compared->sum : nullptr, std::nullopt, plain,
         "the passes of each frame added up\n"},
        layout);
    if (ui) {
        ImGui::TableNextRow(ImGuiTableRowFlags_None, ImGui::GetFontSize() * 0.4f);
        ImGui::TableNextColumn();
        ImGui::Separator();
        show(
            {*ui, nullptr, std::nullopt, ImGui::GetColorU32(ImGuiCol_TextDisabled),
             "the device's time for the window itself: widgets and copies of the pictures. No "
             "other figure includes it\n"},
            layout);
    }
    ImGui::EndTable();
}

// ---- Probes -------------------------------------------------------------------------------------

std::string_view unitOf(const report::MetricId& metric) {
    for (const report::MetricKind& kind : report::metricKinds())
        if (kind.of == metric.of && kind.what == metric.what) return kind.unit;
    return {};
}

// Shows each probe's last value, beside the other side's when comparing, and below it its values
// over time.
void probePlots(const measure::PlayedProbes& probes, const measure::PlayedProbes* compared) {
    if (probes.names.empty()) ImGui::TextDisabled("none: search the settings for probes");
    constexpr std::string_view kPrefix = "probe.";
    const auto last = [](const measure::PlayedProbes& played, const std::string& name) {
        const auto place = std::ranges::find(played.names, name);
        if (place == played.names.end()) return std::string("-");
        const std::vector<double>& values =
            played.values[static_cast<std::size_t>(place - played.names.begin())];
        return values.empty() ? std::string("-") : report::shortNumber(values.back());
    };
    for (std::size_t i = 0; i < probes.names.size(); ++i) {
        const std::string& name = probes.names[i];
        const std::vector<double>& values = probes.values[i];
        const std::string unit(unitOf(report::metricNamed(name)));
        std::string text = last(probes, name);
        if (compared) text = "A " + text + "  B " + last(*compared, name);
        if (unit != "1") text += " " + unit;
        const char* const shown = name.c_str() + kPrefix.size();
        const float room = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x;
        const bool fits = ImGui::CalcTextSize(shown).x + ImGui::CalcTextSize(text.c_str()).x < room;
        ImGui::TextUnformatted(shown);
        if (fits) ImGui::SameLine();
        rightText(text);
        const ImVec2 size(
            std::max(ImGui::GetContentRegionAvail().x, 1.0f), ImGui::GetTextLineHeight() * 2.0f);
        if (const auto at = sparkline(("##" + name).c_str(), values, size, seriesColor(i)))
            ImGui::SetTooltip(
                "%s at %s s: %s %s", name.c_str(), report::shortNumber(probes.times[*at]).c_str(),
                report::shortNumber(values[*at]).c_str(), unit.c_str());
    }
}

// ---- Pipeline statistics ------------------------------------------------------------------------

// Colours that are readable on dark and light backgrounds.
constexpr ImU32 kRight = IM_COL32(46, 160, 67, 255);
constexpr ImU32 kWrong = IM_COL32(218, 54, 51, 255);

void verdict(const report::Statistic& statistic) {
    if (!statistic.expected) return;
    const bool right = *statistic.expected == statistic.measured;
    ImGui::PushStyleColor(ImGuiCol_Text, right ? kRight : kWrong);
    ImGui::TextUnformatted(right ? "=" : "!=");
    ImGui::PopStyleColor();
    helpMarker(
        right ? "the count that follows from the settings"
              : "not the count that follows from the settings");
}

void show(const report::Statistic& statistic) {
    std::string name = statistic.name;
    std::ranges::replace(name, '_', ' ');
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(name.c_str());
    if (!statistic.note.empty()) ImGui::TextDisabled("%s", statistic.note.c_str());
    ImGui::PopTextWrapPos();
    ImGui::TableNextColumn();
    rightText(report::countText(statistic.measured));
    if (statistic.expected && *statistic.expected != statistic.measured)
        rightText("not " + report::countText(*statistic.expected));
    ImGui::TableNextColumn();
    verdict(statistic);
}

// Shows pipeline statistics: each count, whether it equals its expected count if there is one, and
// notes.
void statisticsTable(const std::vector<report::Statistic>& statistics) {
    if (!ImGui::BeginTable("##statistics", 3, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    for (const report::Statistic& statistic : statistics) show(statistic);
    ImGui::EndTable();
}

bool section(const char* name, ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_DefaultOpen) {
    return ImGui::CollapsingHeader(name, flags);
}

void remember(std::vector<double>& times, double time) {
    if (time <= 0.0) return;  // the window has no finished picture yet
    if (times.size() == TimingHistory::kFrames) times.erase(times.begin());
    times.push_back(time);
}

// ---- Figures of a side --------------------------------------------------------------------------

// Returns shownTimings() with the side's counts and its back end.
ShownSide shownSide(const Side& side, engine::DeviceType device_type) {
    ShownSide shown = shownTimings(side.timings(), device_type);
    shown.metrics.counts = side.shown().counts;
    shown.metrics.backend = side.shown().backend;
    return shown;
}

}  // namespace

// ---- The panel ----------------------------------------------------------------------------------

void TimingsPanel::show(
    Side& side, Side* compared, const ReportOrigin& origin, const WindowFigures& window) {
    if (!frozen_) remember(ui_, window.device);
    controls(side, compared, origin);
    const engine::DeviceType type = device_.info().type;
    const ShownSide a = frozen_ ? frozen_->shown : shownSide(side, type);
    std::optional<ShownSide> b = frozen_compared_;
    if (!frozen_ && compared) b = shownSide(*compared, type);
    const ShownSide* const other = b ? &*b : nullptr;

    frameFigures(a, other);
    if (side.shown().level > 0 && !frozen_)
        ImGui::TextWrapped("Pictures of a preview are not timed. With View > Preview what moves "
                           "(P) switched off, all pictures are complete.");
    if (section("Passes") && a.passes) {
        std::optional<TimeSeries> ui;
        if (!ui_.empty()) ui = timeSeries("ui", ui_, {});
        passTable(
            *a.passes, other && other->passes ? &*other->passes : nullptr, ui ? &*ui : nullptr);
    }
    if (section("Probes"))
        probePlots(side.shown().probes, compared ? &compared->shown().probes : nullptr);
    if (section("CPU and device")) {
        splitFigures(a, other);
        FigureTable table("##window", FigureTable::Columns::one);
        table.row(
            "Panels answer in, ms",
            "Longest time of the last 300 pictures of the window, from reading mouse and keys "
            "until the picture with their effect was given to the desktop",
            window.slowest_answer);
        table.row(
            "Pictures / s",
            "Pictures of the scene in the last 2 s, including previews and all work between them",
            window.pictures_per_second > 0.0 ? std::optional(window.pictures_per_second)
                                             : std::nullopt);
    }
    for (const std::string& warning : a.metrics.trust.warnings)
        ImGui::TextWrapped("Warning: %s", warning.c_str());
    if (section("Pipeline statistics")) statistics(side);
    if (section("Memory and counts")) {
        memoryTable(memory_, static_cast<double>(window.memory));
        countTable(a.metrics, other ? &other->metrics : nullptr);
    }
    if (section("As the runner measures")) measure_.show(compared ? 2 : 1, origin);
}

void TimingsPanel::controls(Side& side, Side* compared, const ReportOrigin& origin) {
    bool freeze = frozen();
    if (ImGui::Checkbox("Freeze", &freeze)) {
        frozen_.reset();
        frozen_compared_.reset();
        const engine::DeviceType type = device_.info().type;
        if (freeze) {
            frozen_ = frozenSide(side.shown(), shownSide(side, type));
            warnOfChangedShaders(replaced_, frozen_->shown.metrics.trust);
        }
        if (freeze && compared) frozen_compared_ = shownSide(*compared, type);
    }
    helpMarker("Holds these figures. The scene continues to play");
    ImGui::SameLine();
    if (ImGui::Button("Clear")) {
        side.timings().clear();
        if (compared) compared->timings().clear();
        ui_.clear();
    }
    helpMarker("Forgets the frames so far");
    ImGui::SameLine();
    ImGui::BeginDisabled(!frozen());
    export_.show(reportPath(origin, "frozen"), [&](const std::filesystem::path& file) {
        const report::CaseResult* const counted = countedOf(side);
        saveReport(
            viewerReport(
                device_, origin, frozen_->settings,
                frozenResult(*frozen_, counted ? *counted : report::CaseResult())),
            frozen_->settings.render, {}, file);
    });
    ImGui::EndDisabled();
}

const report::CaseResult* TimingsPanel::countedOf(const Side& side) const {
    const bool fits =
        counted_ && counted_->side == side.id() && counted_->revision == side.timings().revision();
    return fits ? &counted_->result : nullptr;
}

void TimingsPanel::setCounts(report::CaseResult result, const Side& side) {
    wants_counts_.reset();
    counted_ = Counted{
        .result = std::move(result),
        .side = side.id(),
        .revision = side.timings().revision(),
        .frame = side.shown().frame};
}

void TimingsPanel::statistics(Side& side) {
    ImGui::BeginDisabled(!device_.hasPipelineStatistics());
    if (ImGui::Button("Count")) wants_counts_ = side.id();
    ImGui::EndDisabled();
    helpMarker("Draws the frame that is shown once more, untimed, with pipeline statistics of the "
               "strands pass, and compares them with the counts that follow from the settings");
    if (!device_.hasPipelineStatistics()) {
        ImGui::TextWrapped("This device has no pipeline statistics.");
        return;
    }
    if (const report::CaseResult* const counted = countedOf(side)) {
        ImGui::SameLine();
        ImGui::TextDisabled("of frame %u", counted_->frame);
        if (counted->statistics.empty()) ImGui::TextWrapped("No hair is drawn.");
        statisticsTable(counted->statistics);
    }
}

}  // namespace benchmarks::viewer
