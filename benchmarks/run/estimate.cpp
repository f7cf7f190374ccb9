#include "benchmarks/run/estimate.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "benchmarks/case.h"
#include "benchmarks/columns.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/progress.h"
#include "benchmarks/quantity_text.h"
#include "benchmarks/table.h"

namespace benchmarks {

namespace {

// Overlapped, isolated, and by the CPU's clock where timestamps are not trusted.
constexpr double kModes = 3;
// 16 pairs that test the timestamps (measure/check_timestamps.h), and pipeline statistics.
constexpr double kTestFrames = 33;

struct Estimate {
    double frame = 0.0;  // ms
    double seconds = 0.0;  // that measuring may take
    std::uint64_t bytes = 0;
    std::string problem;  // why there is none
};

// The second frame: the first one compiles pipelines.
double frameTime(const engine::Device& device, Case& test_case) {
    engine::FrameLoop loop(device, engine::Timing::isolated);
    for (int i = 0; i < 2; ++i) {
        checkInterrupted();
        loop.frame([&](engine::Passes& passes) { test_case.frame(passes); });
    }
    const engine::FrameRecord frame = loop.finish().back();
    return frame.record + frame.wall;
}

Estimate estimateCase(const engine::Device& device, const PlannedCase& planned) {
    try {
        const hair::Settings& settings = planned.spec.settings;
        Case test_case(device, settings, planned.directory);
        const double frame = frameTime(device, test_case);
        return {
            .frame = frame,
            .seconds = mostSeconds(settings.run, frame),
            .bytes = device.allocatedBytes(),
            .problem = {}};
    } catch (const engine::Error& error) {
        return {.problem = error.what()};
    }
}

void print(const RunPlan& plan, const std::vector<Estimate>& estimates) {
    std::vector<Column> columns(5);
    columns[0] = {.title = "case", .numeric = false};
    columns[1] = {.title = "memory"};
    columns[2] = {.title = "frame ms"};
    columns[3] = {.title = "at most s"};
    columns[4] = {.title = "", .numeric = false};
    double seconds = 0.0;
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        const Estimate& each = estimates[i];
        const bool known = each.problem.empty();
        columns[0].cells.push_back(plan.cases[i].spec.name);
        columns[1].cells.push_back(known ? sizeText(each.bytes) : "-");
        columns[2].cells.push_back(known ? shortNumber(each.frame) : "-");
        columns[3].cells.push_back(known ? shortNumber(each.seconds) : "-");
        columns[4].cells.push_back(each.problem);
        seconds += each.seconds;
        bytes = std::max(bytes, each.bytes);
    }
    for (std::size_t row = 0; row <= estimates.size(); ++row)
        std::cout << columnsLine(columns, row);
    std::cout << estimates.size() << (estimates.size() == 1 ? " case" : " cases") << ", at most "
              << sizeText(bytes) << " at a time, at most " << shortNumber(seconds / 60.0)
              << " min\n";
}

}  // namespace

int printNames(const RunPlan& plan) {
    for (const PlannedCase& each : plan.cases) std::cout << each.spec.name << '\n';
    std::cout << plan.cases.size() << (plan.cases.size() == 1 ? " case\n" : " cases\n");
    return kOk;
}

double mostSeconds(const hair::RunSettings& run, double frame_ms) {
    const double round = (run.warmup + run.frames + 1) * frame_ms / 1e3;
    // Rounds begin until max_time; the last one is played to its end.
    const double mode = double{run.max_time} + round;
    return kModes * mode + kTestFrames * frame_ms / 1e3;
}

int estimateRun(const RunPlan& plan, const engine::DeviceOptions& options) {
    std::optional<engine::Device> device;
    try {
        device.emplace(options);
    } catch (const engine::NoDevice& error) {
        std::cerr << "hairbench: no estimates: " << error.what() << '\n';
        return printNames(plan);
    }
    catchInterrupts();
    std::vector<Estimate> estimates;
    Progress progress(plan.cases.size());
    try {
        for (const PlannedCase& each : plan.cases) {
            progress.begin(each.spec.name);
            estimates.push_back(estimateCase(*device, each));
        }
    } catch (const Interrupted&) {
        progress.clear();
        print(plan, estimates);
        return kInterrupted;
    }
    progress.clear();
    print(plan, estimates);
    return kOk;
}

}  // namespace benchmarks
