#include "benchmarks/viewer/timings_panel.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <system_error>

#include <imgui.h>

#include "benchmarks/measure/progress.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "benchmarks/viewer/player.h"
#include "engine/device.h"
#include "engine/error.h"

namespace benchmarks::viewer {
namespace {

// Returns a number's text; "-" if it is unknown.
std::string numberText(std::optional<double> number) {
    return number ? report::shortNumber(*number) : "-";
}

// ---- Results of a measurement -------------------------------------------------------------------

constexpr double kAlpha = 0.05;

void sampling(const report::Sampling& mode) {
    std::string text = mode.mode + ": " + report::countText(mode.rounds, "round") + ", " +
                       report::shortNumber(mode.seconds) + " s";
    if (mode.precision && std::isfinite(*mode.precision))
        text += ", +-" + report::shortNumber(100.0 * *mode.precision) + " %";
    if (mode.steady && !*mode.steady) text += ", not steady";
    ImGui::TextWrapped("%s", text.c_str());
}

// "12.3 (12.1 to 12.6)": the median and its 95 % interval, or only the median with too few samples.
std::string medianText(const report::Metric& metric) {
    std::string text = report::shortNumber(report::summarize(metric.samples).median);
    if (metric.samples.size() < 2) return text;
    const report::MedianInterval interval =
        report::medianInterval(metric.samples, kAlpha, report::effectiveSamples(metric.samples));
    if (std::isfinite(interval.lower) && std::isfinite(interval.upper))
        text += " (" + report::shortNumber(interval.lower) + " to " +
                report::shortNumber(interval.upper) + ")";
    return text;
}

// Shows medians of a measured case's times and rates with their intervals, the number of rounds,
// and warnings.
void measuredTable(const report::CaseResult& result) {
    for (const report::Sampling& mode : result.sampling) sampling(mode);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("Medians in ms, rates in 1/s; in brackets the 95 %% confidence intervals");
    ImGui::PopTextWrapPos();
    {
        FigureTable table("##measured", FigureTable::Columns::one);
        for (const report::Metric& metric : result.metrics) {
            if (metric.samples.empty() || (metric.unit != "ms" && metric.unit != "1/s")) continue;
            std::string help = report::modeName(metric.mode);
            if (!help.empty()) help += ", ";
            help += "median in " + metric.unit + " of " +
                    report::countText(metric.samples.size(), "sample");
            table.row(metric.name().c_str(), help.c_str(), medianText(metric));
        }
    }
    for (const std::string& warning : result.trust.warnings)
        ImGui::TextWrapped("Warning: %s", warning.c_str());
}

constexpr const char* kPopup = "Measuring";
// Time between two checks of the window's events. A check takes some microseconds, a negligible
// share of a frame's time.
constexpr std::chrono::milliseconds kLook{100};

}  // namespace

// ---- Widgets for figures ------------------------------------------------------------------------

void helpMarker(const char* help) {
    if (*help == 0) return;
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayShort) && ImGui::BeginTooltip()) {
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0f);
        ImGui::TextUnformatted(help);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
}

void rightText(const std::string& text) {
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (room > 0.0f) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    ImGui::TextUnformatted(text.c_str());
}

FigureTable::FigureTable(const char* id, Columns columns, const char* title) : columns_(columns) {
    const int count = columns == Columns::compared ? 4 : 2;
    open_ = ImGui::BeginTable(id, count, ImGuiTableFlags_SizingFixedFit);
    if (!open_) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    for (int i = 1; i < count; ++i) ImGui::TableSetupColumn("");
    if (columns == Columns::one && *title == 0) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", title);
    if (columns == Columns::one) return;
    for (const char* side : {"A", "B", "B / A"}) {
        ImGui::TableNextColumn();
        rightText(side);
    }
}

FigureTable::~FigureTable() {
    if (open_) ImGui::EndTable();
}

void FigureTable::row(
    const char* name, const char* help, std::optional<double> a, std::optional<double> b) {
    row(name, help, numberText(a), numberText(b));
    if (!open_ || columns_ == Columns::one) return;
    ImGui::TableNextColumn();
    rightText(a && b && *a > 0.0 ? report::shortNumber(*b / *a) : "-");
}

void FigureTable::row(
    const char* name, const char* help, const std::string& a, const std::string& b) {
    if (!open_) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(name);
    ImGui::PopTextWrapPos();
    helpMarker(help);
    ImGui::TableNextColumn();
    rightText(a);
    if (columns_ == Columns::one) return;
    ImGui::TableNextColumn();
    rightText(b);
}

// ---- The box that asks for a file ---------------------------------------------------------------

void SaveBox::save(const std::function<void(const std::filesystem::path&)>& write) {
    try {
        write(path_);
        told_ = "Written: " + path_;
        problem_.clear();
        ImGui::CloseCurrentPopup();
    } catch (const engine::Error& error) {
        problem_ = error.what();
    }
}

void SaveBox::show(
    const std::filesystem::path& suggested,
    const std::function<void(const std::filesystem::path&)>& write) {
    const std::string popup = "Save##" + button_;
    if (ImGui::Button(button_.c_str())) {
        path_ = suggested.string();
        problem_.clear();
        ImGui::OpenPopup(popup.c_str());
    }
    if (ImGui::BeginPopup(popup.c_str())) {
        char text[1024] = {};
        path_.copy(text, sizeof text - 1);
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 22.0f);
        const bool entered =
            ImGui::InputText("##path", text, sizeof text, ImGuiInputTextFlags_EnterReturnsTrue);
        path_ = text;
        if (ImGui::Button("Save") || entered) save(write);
        ImGui::SameLine();
        if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
        std::error_code ignored;
        if (std::filesystem::exists(path_, ignored))
            ImGui::TextDisabled("This file exists and will be replaced.");
        if (!problem_.empty()) {
            ImGui::PushTextWrapPos(ImGui::GetFontSize() * 22.0f);
            ImGui::TextUnformatted(problem_.c_str());
            ImGui::PopTextWrapPos();
        }
        ImGui::EndPopup();
    }
    if (!told_.empty()) ImGui::TextWrapped("%s", told_.c_str());
}

// ---- The panel ----------------------------------------------------------------------------------

void MeasurePanel::buttons(std::size_t sides) {
    static constexpr const char* kNames[] = {"Measure A", "Measure B"};
    for (std::size_t i = 0; i < sides; ++i) {
        if (i > 0) ImGui::SameLine();
        if (ImGui::Button(sides > 1 ? kNames[i] : "Measure")) wanted_ = i;
        helpMarker("Measures the settings as 'hairbench run' does: rounds of /run/warmup and "
                   "/run/frames frames from the first frame on, in each mode until the median is "
                   "known to /run/precision or /run/max_time is over. The shown scene waits "
                   "meanwhile and then continues unchanged");
    }
}

void MeasurePanel::show(std::size_t sides, const ReportOrigin& origin) {
    buttons(sides);
    if (measured_) {
        ImGui::SameLine();
        save_.show(reportPath(origin, kind_), [&](const std::filesystem::path& file) {
            saveReport(
                viewerReport(device_, origin, measured_->settings, measured_->result),
                measured_->settings.render, measured_->picture, file);
        });
    }
    if (!told_.empty()) ImGui::TextWrapped("%s", told_.c_str());
    if (measured_) measuredTable(measured_->result);
    progress();
}

void MeasurePanel::progress() {
    if (measuring_ && !ImGui::IsPopupOpen(kPopup)) ImGui::OpenPopup(kPopup);
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(
            kPopup, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
        return;
    if (!measuring_) ImGui::CloseCurrentPopup();
    const ImVec2 bar(ImGui::GetFontSize() * 18.0f, 0.0f);
    if (state_) {
        ImGui::TextUnformatted(
            (measure::samplingText(*state_) + ", " + report::countText(state_->rounds, "round"))
                .c_str());
        const double share =
            state_->max_seconds > 0.0 ? state_->seconds / state_->max_seconds : 1.0;
        const std::string text = report::shortNumber(state_->seconds) + " of at most " +
                                 report::shortNumber(state_->max_seconds) + " s";
        ImGui::ProgressBar(static_cast<float>(std::min(share, 1.0)), bar, text.c_str());
    } else {
        ImGui::TextUnformatted("the first round");
        ImGui::ProgressBar(0.0f, bar, "");
    }
    if (ImGui::Button("Cancel")) link_.cancel();
    ImGui::SameLine();
    ImGui::TextDisabled(
        "%s", link_.isCancelled() ? "ending" : "takes effect after the current round");
    ImGui::EndPopup();
}

measure::MeasureHooks MeasurePanel::begin() {
    side_ = wanted_.value_or(0);
    wanted_.reset();
    measuring_ = true;
    state_.reset();
    told_.clear();
    link_.restart();
    return link_.hooks();
}

void MeasurePanel::end(std::optional<SideMeasurement> measured, const std::string& why_not) {
    measuring_ = false;
    told_ = why_not;
    if (!measured) return;
    measured_ = std::move(measured);
    kind_ = side_ == 1 ? "viewer-b" : "viewer";
}

bool MeasurePanel::wantsPicture() {
    const std::optional<measure::SamplingState> state = link_.take();
    if (state) state_ = state;
    return state.has_value();
}

// ---- Between the window and the thread that measures --------------------------------------------

measure::MeasureHooks MeasureLink::hooks() {
    return {
        .stop = [this] { return cancelled_.load(); },
        .progress = [this](const measure::SamplingState& state) { tell(state); }};
}

void MeasureLink::tell(const measure::SamplingState& state) {
    std::unique_lock lock(mutex_);
    state_ = state;
    waits_ = true;
    lock.unlock();
    told_();
    lock.lock();
    changed_.wait(lock, [this] { return !waits_ || cancelled_; });
}

std::optional<measure::SamplingState> MeasureLink::take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(state_, std::nullopt);
}

void MeasureLink::shown() {
    const std::scoped_lock lock(mutex_);
    waits_ = false;
    changed_.notify_all();
}

void MeasureLink::cancel() {
    const std::scoped_lock lock(mutex_);
    cancelled_ = true;
    changed_.notify_all();
}

void MeasureLink::restart() {
    const std::scoped_lock lock(mutex_);
    state_.reset();
    waits_ = false;
    cancelled_ = false;
}

}  // namespace benchmarks::viewer
