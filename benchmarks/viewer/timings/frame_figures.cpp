#include "benchmarks/viewer/timings/frame_figures.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>

#include <imgui.h>

#include "benchmarks/quantity_text.h"
#include "benchmarks/table.h"
#include "benchmarks/trust.h"
#include "benchmarks/viewer/timings/figure_table.h"
#include "benchmarks/viewer/timings/share_bar.h"

namespace benchmarks {

namespace {

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
    return text + ".\nOf the mean of the slowest 1 %: " + shortNumber(side.rate->low->mean) +
           "; of the frame at which the slowest reach 1 % of all the time: " +
           shortNumber(side.rate->low->integral);
}

void trustFigure(const ShownSide& side, const ShownSide* compared, FigureTable& table) {
    table.row(
        "Passes / frame",
        "The isolated passes' sum over the frame by the CPU's clock: 1 where the device's "
        "timestamps are right and nothing else is at work. 10 % off is a warning",
        side.metrics.trust.pass_sum_over_wall,
        compared ? compared->metrics.trust.pass_sum_over_wall : std::nullopt);
}

}  // namespace

void frameFigures(const ShownSide& side, const ShownSide* compared) {
    FigureTable table("##frame", columnsFor(compared));
    const auto row = [&](const char* name, const char* help, auto get) {
        table.row(name, help, ofRate(&side, get), ofRate(compared, get));
    };
    row("FPS",
        "Isolated frames over their total time, by the CPU's clock from submission to completion: "
        "one frame at a time, a pass at a time. 'Measure' gives the runner's: two frames in flight",
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
        "Their passes are timed by themselves, between full barriers. The last 300 are kept",
        &ShownSide::isolated);
    count(
        "Overlapped frames", "The device may overlap their passes. The last 300 are kept",
        &ShownSide::overlapped);
}

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
    row("Submission", "CPU: the call that submits them.",
        [](const FrameSplit& split) { return Known(split.submit); });
    row("Waiting", "CPU: from there until the device is done.",
        [](const FrameSplit& split) { return Known(split.wait); });
    row("CPU time",
        "What all threads of the program used of the CPU from recording to completion: on a "
        "software device what a frame costs, however busy the machine is.",
        [](const FrameSplit& split) { return split.cpu; });
    row("Device", "From the first to the last timestamp of an isolated frame.",
        [](const FrameSplit& split) { return Known(split.device); });
    row("Passes alone", "The isolated passes added up.",
        [](const FrameSplit& split) { return Known(split.pass_sum); });
    row("Overlapped",
        "From the first to the last timestamp of an overlapped frame, whose passes the device may "
        "overlap. Software devices stamp early, so that this may be too short there",
        [](const FrameSplit& split) { return split.device_overlapped; });
    row("Saved",
        "What overlap within a frame saves the device: the passes alone less the overlapped frame. "
        "The runner's frame.overlap also has what two frames in flight save",
        [](const FrameSplit& split) { return split.saved(); });
}

}  // namespace benchmarks
