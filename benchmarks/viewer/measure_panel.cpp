#include "benchmarks/viewer/measure_panel.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "benchmarks/run/case.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/viewer/timings_panel.h"
#include "engine/device.h"
#include "engine/error.h"
#include "engine/frame_loop.h"
#include "engine/shaders.h"

namespace benchmarks::viewer {

// ---- Changed shaders ----------------------------------------------------------------------------

void warnOfChangedShaders(const engine::Device& device, report::Trust& trust) {
    std::string names;
    for (const auto& [path, code] : device.shaders().replacements())
        names += (names.empty() ? "" : ", ") + path;
    if (names.empty()) return;
    trust.warnings.push_back("shaders that are not those of the build: " + names);
}

// ---- Count statistics ---------------------------------------------------------------------------

report::CaseResult countStatistics(const engine::Device& device, measure::Case& shown) {
    report::CaseResult result;
    if (!device.hasPipelineStatistics()) return result;
    device.runOnce([](engine::Commands&) {});  // the window may still be copying the picture
    engine::FrameLoop loop(device, engine::Timing::statistics);
    loop.frame([&](engine::Passes& passes) { shown.draw(passes); });
    measure::addStatistics(loop.finish().front(), device, shown, result);
    return result;
}

// ---- Frozen side --------------------------------------------------------------------------------

FrozenSide frozenSide(const Side& side, ShownSide shown) {
    const Player& player = side.player();
    measure::addTransparency(player.played(), shown.metrics);
    if (!player.previews()) {
        shown.metrics.image_hash = player.played().pictureHash();
        shown.metrics.state_hash = player.played().stateHash();
    }
    return {.shown = std::move(shown), .settings = player.settings(), .frame = player.frame()};
}

report::CaseResult frozenResult(const FrozenSide& frozen, const report::CaseResult& statistics) {
    report::CaseResult result = frozen.shown.metrics;
    result.statistics = statistics.statistics;
    std::vector<std::string>& warnings = result.trust.warnings;
    std::ranges::copy(statistics.trust.warnings, std::back_inserter(warnings));
    std::string frames = report::countText(frozen.shown.isolated, "isolated frame") + " and " +
                         report::countText(frozen.shown.overlapped, "overlapped frame");
    if (const auto& range = frozen.shown.range)
        frames +=
            " between " + std::to_string(range->first) + " and " + std::to_string(range->second);
    warnings.push_back(
        "taken in the viewer: " + frames +
        ", one at a time and with the window's pictures between them, in no rounds; their "
        "timestamps were not held against the CPU's clock");
    if (!result.image_hash.empty())
        warnings.push_back("the hashes are of frame " + std::to_string(frozen.frame));
    return result;
}

namespace {

// ---- Measured table -----------------------------------------------------------------------------

constexpr double kAlpha = 0.05;

void sampling(const report::Sampling& mode) {
    std::string text = mode.mode + ": " + report::countText(mode.rounds, "round") + ", " +
                       report::shortNumber(mode.seconds) + " s";
    if (mode.precision && std::isfinite(*mode.precision))
        text += ", +-" + report::shortNumber(100.0 * *mode.precision) + " %";
    if (mode.steady && !*mode.steady) text += ", not steady";
    ImGui::TextWrapped("%s", text.c_str());
}

// "12.3 (12.1 to 12.6)": the median, and where it lies with 95 % confidence; without an interval
// where there are too few samples for one.
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

// Medians of a measured case's times and rates with the intervals that its report has, how many
// rounds it took, and its warnings.
void measuredTable(const report::CaseResult& result) {
    for (const report::Sampling& mode : result.sampling) sampling(mode);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled(
        "Medians in ms, rates in 1/s; in brackets where they lie with 95 %% confidence");
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

}  // namespace

// ---- Save box -----------------------------------------------------------------------------------

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
            ImGui::TextDisabled("This file is there already and will be replaced.");
        if (!problem_.empty()) {
            ImGui::PushTextWrapPos(ImGui::GetFontSize() * 22.0f);
            ImGui::TextUnformatted(problem_.c_str());
            ImGui::PopTextWrapPos();
        }
        ImGui::EndPopup();
    }
    if (!told_.empty()) ImGui::TextWrapped("%s", told_.c_str());
}

namespace {

// ---- Own memory ---------------------------------------------------------------------------------

// What one thing holds of the device's memory while others hold some too: what has joined since the
// beginning, but for what others did meanwhile.
class OwnMemory {
public:
    explicit OwnMemory(const engine::MemoryLedger& all) : all_(all), others_(all.bytes()) {}

    // Does what is not the thing's.
    void others(const std::function<void()>& action);

    // memory.device and memoryMetrics(), of it alone.
    std::vector<report::Metric> metrics() const;

private:
    const engine::MemoryLedger& all_;
    std::map<engine::MemoryLedger::Entry, std::uint64_t> others_;
};

void OwnMemory::others(const std::function<void()>& action) {
    const auto before = all_.bytes();
    action();
    for (const auto& [entry, bytes] : all_.bytes()) others_[entry] += bytes;
    // What was there before is counted already. Sums are taken modulo 2^64, so that it may shrink.
    for (const auto& [entry, bytes] : before) others_[entry] -= bytes;
}

std::vector<report::Metric> OwnMemory::metrics() const {
    engine::MemoryLedger own;
    std::vector<engine::MemoryLedger::Line> lines;
    std::uint64_t sum = 0;
    for (const auto& [entry, bytes] : all_.bytes()) {
        const auto found = others_.find(entry);
        const std::uint64_t rest = bytes - (found == others_.end() ? 0 : found->second);
        if (rest > 0) lines.emplace_back(own, entry, rest);
        sum += rest;
    }
    std::vector<report::Metric> metrics{
        {report::ofMemory(report::Measured::allocated), {static_cast<double>(sum)}}};
    std::ranges::move(measure::memoryMetrics(own), std::back_inserter(metrics));
    return metrics;
}

}  // namespace

// ---- Side measurement ---------------------------------------------------------------------------

SideMeasurement measureSide(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, const std::string& name,
    const measure::MeasureHooks& hooks) {
    SideMeasurement measured{.settings = settings, .result = {.name = name}, .picture = {}};
    report::CaseResult& result = measured.result;
    result.index = result.order = 0;
    OwnMemory memory(device.memory());
    const measure::MeasureHooks own_hooks{
        .stop = hooks.stop, .progress = [&](const measure::SamplingState& state) {
            if (hooks.progress) memory.others([&] { hooks.progress(state); });
            device.runOnce([](engine::Commands&) {});  // waits for all that was submitted
        }};
    measure::Case test_case(device, settings, directory);
    measured.picture = measure::measure(device, test_case, settings.run, own_hooks, result);
    std::erase_if(result.metrics, [](const report::Metric& metric) {
        const report::Measured what = metric.id.what;
        return what == report::Measured::allocated || what == report::Measured::heap ||
               what == report::Measured::purpose;
    });
    std::ranges::move(memory.metrics(), std::back_inserter(result.metrics));
    if (!settings.run.reference.empty()) {
        reference::ReferenceComparison references;
        references.add(
            directory / settings.run.reference, settings.render.width, settings.render.height,
            measured.picture, result);
    }
    warnOfChangedShaders(device, result.trust);
    result.trust.warnings.push_back(
        "measured in the viewer: pipelines and files were warm, and the window's pictures were "
        "drawn between rounds");
    return measured;
}

// ---- Viewer report ------------------------------------------------------------------------------

report::Report viewerReport(
    const engine::Device& device, const ReportOrigin& origin, const hair::Settings& settings,
    report::CaseResult result) {
    scene::Document document(scene::writeSettings(settings));
    report::Report report;
    report.environment =
        report::describeEnvironment(device, origin.command, settings.seed, origin.validation);
    report.scene.path = origin.scene.string();
    report.scene.hash = report::hashText(document.text());
    report.scene.document = std::move(document);
    report.case_count = 1;
    result.name = origin.name;
    result.index = result.order = 0;
    report.cases.push_back(std::move(result));
    return report;
}

std::filesystem::path reportPath(const ReportOrigin& origin, const std::string& kind) {
    return std::filesystem::path("results/local") / (origin.name + '-' + kind + ".json");
}

void saveReport(
    report::Report report, const hair::RenderSettings& render,
    std::span<const std::uint8_t> picture, const std::filesystem::path& file) {
    if (!picture.empty())
        report.cases.front().picture =
            run::writeCasePicture(picture, render.width, render.height, file, 0);
    report::writeReport(report::reportJson(report), file);
}

namespace {

// ---- Measure panel ------------------------------------------------------------------------------

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
    const measure::MeasureHooks hooks{
        .stop =
            [&] {
                if (Clock::now() - looked >= kLook) {
                    closes = window.closes();
                    looked = Clock::now();
                }
                return cancelled_ || closes;
            },
        .progress =
            [&](const measure::SamplingState& state) {
                state_ = state;
                window.picture();
            }};
    try {
        window.picture();
        measured_ = measureSide(device_, settings, directory, origin.name, hooks);
        kind_ = kind;
    } catch (const engine::Interrupted&) {
        told_ = "Cancelled: nothing was measured.";
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (const engine::Error& error) {
        told_ = error.what();
    }
    measuring_ = false;
}

}  // namespace benchmarks::viewer
