#include "benchmarks/viewer/timings/changed_shaders.h"
#include "benchmarks/viewer/timings/timings_panel.h"

#include <imgui.h>

#include "benchmarks/viewer/timings/count_statistics.h"
#include "benchmarks/viewer/timings/figure_table.h"
#include "benchmarks/viewer/timings/frame_figures.h"
#include "benchmarks/viewer/timings/memory_table.h"
#include "benchmarks/viewer/timings/pass_table.h"
#include "benchmarks/viewer/timings/statistics_table.h"

namespace benchmarks {

namespace {

bool section(const char* name, ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_DefaultOpen) {
    return ImGui::CollapsingHeader(name, flags);
}

void remember(std::vector<double>& times, double time) {
    if (time <= 0.0) return;  // no picture of the window is done yet
    if (times.size() == TimingHistory::kFrames) times.erase(times.begin());
    times.push_back(time);
}

}  // namespace

void TimingsPanel::show(
    Side& side, Side* compared, const ReportOrigin& origin, double ui_milliseconds) {
    if (!frozen_) remember(ui_, ui_milliseconds);
    controls(side, compared, origin);
    const std::string& type = device_.info().type;
    const ShownSide a = frozen_ ? frozen_->shown : shownSide(side, type);
    std::optional<ShownSide> b = frozen_compared_;
    if (!frozen_ && compared) b = shownSide(*compared, type);
    const ShownSide* const other = b ? &*b : nullptr;

    frameFigures(a, other);
    if (section("Passes") && a.passes) {
        std::optional<TimeSeries> ui;
        if (!ui_.empty()) ui = timeSeries("ui", ui_, {});
        passTable(
            *a.passes, other && other->passes ? &*other->passes : nullptr, ui ? &*ui : nullptr);
    }
    if (section("CPU and device")) splitFigures(a, other);
    for (const std::string& warning : a.metrics.trust.warnings)
        ImGui::TextWrapped("Warning: %s", warning.c_str());
    if (section("Pipeline statistics")) statistics(side);
    if (section("Memory and counts")) {
        memoryTable(device_.memory());
        countTable(a.metrics.counts, other ? &other->metrics.counts : nullptr);
    }
    if (section("As the runner measures")) measure_.show(compared ? 2 : 1, origin);
}

void TimingsPanel::controls(Side& side, Side* compared, const ReportOrigin& origin) {
    bool freeze = frozen();
    if (ImGui::Checkbox("Freeze", &freeze)) {
        frozen_.reset();
        frozen_compared_.reset();
        const std::string& type = device_.info().type;
        if (freeze) {
            frozen_ = frozenSide(side, shownSide(side, type));
            warnOfChangedShaders(device_, frozen_->shown.metrics.trust);
        }
        if (freeze && compared) frozen_compared_ = shownSide(*compared, type);
    }
    helpMarker("Holds these figures. The scene plays on");
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
        const CaseResult* const counted = countedOf(side);
        saveReport(
            viewerReport(
                device_, origin, frozen_->settings,
                frozenResult(*frozen_, counted ? *counted : CaseResult())),
            frozen_->settings.render, {}, file);
    });
    ImGui::EndDisabled();
}

const CaseResult* TimingsPanel::countedOf(const Side& side) const {
    const bool fits = counted_ && counted_->revision == side.timings().revision();
    return fits ? &counted_->result : nullptr;
}

void TimingsPanel::statistics(Side& side) {
    ImGui::BeginDisabled(!device_.hasPipelineStatistics());
    if (ImGui::Button("Count"))
        counted_ = Counted{
            .result = countStatistics(device_, side.player().played()),
            .revision = side.timings().revision(),
            .frame = side.player().frame()};
    ImGui::EndDisabled();
    helpMarker(
        "Draws the frame that is shown once more, untimed, with pipeline statistics of the strands "
        "pass, and holds them against the counts that follow from the settings");
    if (!device_.hasPipelineStatistics()) {
        ImGui::TextWrapped("This device has no pipeline statistics.");
        return;
    }
    if (const CaseResult* const counted = countedOf(side)) {
        ImGui::SameLine();
        ImGui::TextDisabled("of frame %u", counted_->frame);
        if (counted->statistics.empty()) ImGui::TextWrapped("No hair is drawn.");
        statisticsTable(counted->statistics);
    }
}

}  // namespace benchmarks
