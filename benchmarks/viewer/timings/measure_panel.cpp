#include "benchmarks/viewer/timings/measure_panel.h"

#include <algorithm>
#include <chrono>

#include <imgui.h>

#include "benchmarks/progress.h"
#include "benchmarks/quantity_text.h"
#include "benchmarks/table.h"
#include "benchmarks/viewer/timings/figure_table.h"
#include "benchmarks/viewer/timings/measured_table.h"
#include "engine/device_lost.h"

namespace benchmarks {

namespace {

constexpr const char* kPopup = "Measuring";
// Between two looks at the window's events. A look takes some microseconds, of which a frame's time
// then has no share that matters.
constexpr std::chrono::milliseconds kLook{100};

}  // namespace

void MeasurePanel::buttons(std::size_t sides) {
    static constexpr const char* kNames[] = {"Measure A", "Measure B"};
    for (std::size_t i = 0; i < sides; ++i) {
        if (i > 0) ImGui::SameLine();
        if (ImGui::Button(sides > 1 ? kNames[i] : "Measure")) wanted_ = i;
        helpMarker(
            "Measures the settings as 'hairbench run' does: rounds of /run/warmup and /run/frames "
            "frames from the first frame on, in each mode until the median is known to "
            "/run/precision or /run/max_time is over. What is shown waits meanwhile, and is then "
            "as "
            "it was");
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
            (samplingText(*state_) + ", " + countText(state_->rounds, "round")).c_str());
        const double share =
            state_->max_seconds > 0.0 ? state_->seconds / state_->max_seconds : 1.0;
        const std::string text =
            shortNumber(state_->seconds) + " of at most " + shortNumber(state_->max_seconds) + " s";
        ImGui::ProgressBar(static_cast<float>(std::min(share, 1.0)), bar, text.c_str());
    } else {
        ImGui::TextUnformatted("the first round");
        ImGui::ProgressBar(0.0f, bar, "");
    }
    if (ImGui::Button("Cancel")) cancelled_ = true;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", cancelled_ ? "ends" : "heeded after each round");
    ImGui::EndPopup();
}

void MeasurePanel::measure(
    const Side& side, const ReportOrigin& origin, const MeasuringWindow& window) {
    using Clock = std::chrono::steady_clock;
    // The window may give the side up while it is drawn.
    const hair::Settings settings = side.player().settings();
    const std::filesystem::path directory = side.player().directory();
    const std::string kind = wanted_ == std::size_t{1} ? "viewer-b" : "viewer";
    wanted_.reset();
    cancelled_ = false;
    measuring_ = true;
    state_.reset();
    told_.clear();
    bool closes = false;
    Clock::time_point looked = Clock::now();
    const MeasureHooks hooks{
        .stop =
            [&] {
                if (Clock::now() - looked >= kLook) {
                    closes = window.closes();
                    looked = Clock::now();
                }
                return cancelled_ || closes;
            },
        .progress =
            [&](const SamplingState& state) {
                state_ = state;
                window.picture();
            }};
    try {
        window.picture();
        measured_ = measureSide(device_, settings, directory, origin.name, hooks);
        kind_ = kind;
    } catch (const Interrupted&) {
        told_ = "Cancelled: nothing was measured.";
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (const engine::Error& error) {
        told_ = error.what();
    }
    measuring_ = false;
}

}  // namespace benchmarks
