#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/run_hairbench.h"
#include "tests/compare/made_report.h"
#include "tests/decide/noise.h"
#include "tests/temporary_folder.h"

namespace benchmarks::gate {

// Two programs that measure nothing. The n-th process of the gate, from 0, copies a report that the
// test made earlier, and logs its run and its arguments.
class FakeBuilds {
public:
    // Two for warm-up and 48 pairs, twice because of calibration.
    static constexpr int kProcesses = 2 + 4 * 48;

    // `report(side, n)` returns the report of 'A' or 'B' if it is the n-th process.
    explicit FakeBuilds(const std::function<scene::Json(char, int)>& report) {
        for (int n = 0; n < kProcesses; ++n)
            for (const char side : {'A', 'B'})
                folder_.write(
                    std::string{side} + std::to_string(n) + ".json", report(side, n).dump());
        folder_.write("count", "0\n");
        for (const char side : {'A', 'B'}) writeProgram(side, "");
    }

    // Adds shell commands to the program. "$n" is the process's number and "$4" is the report's
    // path.
    void writeProgram(char side, const std::string& also) {
        const std::string folder = folder_.path().string();
        const auto path = folder_.write(
            std::string{side}, "#!/bin/sh\nread -r n < " + folder + "/count\necho $((n + 1)) > " +
                                   folder + "/count\n" + "echo " + side + " \"$@\" >> " + folder +
                                   "/log\ncp " + folder + '/' + side + "$n.json \"$4\"\n" + also +
                                   '\n');
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    }

    std::string program(char side) const { return folder_.file(std::string{side}).string(); }
    std::filesystem::path reportFile() const { return folder_.file("gate.json"); }
    const TemporaryFolder& folder() const { return folder_; }

    std::string arguments() const {
        return "gate --a '" + program('A') + "' --b '" + program('B') + "' --scene made.json -o '" +
               reportFile().string() + "' ";
    }
    Outcome gate(const std::string& more = "") const { return hairbench(arguments() + more); }
    scene::Json report() const { return scene::Json::parse(textOf(reportFile())); }

    // Returns one line for each process that ran.
    std::vector<std::string> calls() const {
        std::vector<std::string> lines;
        std::ifstream log(folder_.file("log"));
        for (std::string line; std::getline(log, line);) lines.push_back(line);
        return lines;
    }

    // Returns for example "ABABBA...".
    std::string order() const {
        std::string sides;
        for (const std::string& line : calls()) sides += line.front();
        return sides;
    }

private:
    TemporaryFolder folder_;
};

// One case with a frame of 10 ms, which is longer by a share in B. Processes differ by 0.4 %, and
// the machine's speed drifts (docs/comparing.md).
class FakeMachine {
public:
    explicit FakeMachine(double slowdown, double block_noise = 0.004) : slowdown_(slowdown) {
        Noise noise(21);
        double walked = 0.0;
        for (int n = 0; n < FakeBuilds::kProcesses; ++n) {
            walked += 0.015 / std::sqrt(24.0) * noise.normal();
            off_.push_back(walked + block_noise * noise.normal());
        }
    }

    double frameTime(char side, int n) const {
        const double cost = side == 'B' ? std::log1p(slowdown_) : 0.0;
        return 10.0 * std::exp(cost + off_[static_cast<std::size_t>(n)]);
    }

    scene::Json operator()(char side, int n) const {
        scene::Json report = report::madeReport();
        report["cases"].push_back(report::madeCase(
            "made", {{"frame.time", {frameTime(side, n)}, "ms", "lower", "overlapped"}}));
        return report;
    }

private:
    double slowdown_;
    std::vector<double> off_;
};

}  // namespace benchmarks::gate
