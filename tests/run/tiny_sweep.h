#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "benchmarks/run/record.h"
#include "benchmarks/scene/json.h"
#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/run/child_process.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {

// A sweep of eight cases that takes about a second, and its runs. The last two are skipped on
// lavapipe, which doesn't support two samples per pixel.
class TinySweep : public testing::Test {
protected:
    static constexpr std::size_t kCases = 8;

    void SetUp() override {
        static const bool has_device = hairbench("devices").status == 0;
        if (!has_device) return skipWithout(Need::device, "no Vulkan device");
        scene_ = folder_.write("tiny.json", R"({
            "base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json",
            "groom": {"guides": 40},
            "strands": {"tessellation": 1, "root_width": 0.01},
            "camera": {"field_of_view": 40},
            "render": {"width": 64, "height": 64},
            "run": {"warmup": 2, "frames": 2, "max_time": 0},
            "sweep": {
                "/render/msaa": [1, 2],
                "/strands/density": [1, 2, 3, 4, 5, 6],
                "exclude": [{"/render/msaa": [2], "/strands/density": [1, 2, 3, 4]}]}})");
    }

    std::vector<std::string>
    arguments(const std::filesystem::path& out, std::vector<std::string> more = {}) const {
        more.insert(
            more.begin(), {"run", scene_.string(), "--order-seed", "5", "--out", out.string()});
        return more;
    }

    // Runs to the end and returns the status and output.
    Outcome run(const std::filesystem::path& out, const std::vector<std::string>& more = {}) const {
        ChildProcess process(arguments(out, more), log_);
        const int status = process.wait();
        return {status, textOf(log_)};
    }

    // Returns the number of cases in the journal, or -1 while it has no header. Reading it must
    // always work.
    static long journalled(const std::filesystem::path& out) {
        const std::string text = textOf(journalFile(out));
        long lines = 0;
        for (std::size_t start = 0, end; (end = text.find('\n', start)) != std::string::npos;
             start = end + 1, ++lines)
            EXPECT_TRUE(scene::Json::accept(text.substr(start, end - start))) << text;
        return lines - 1;
    }

    // Returns the report without parts that differ between runs: times, values that depend on them,
    // the command line and output paths.
    static scene::Json lasting(scene::Json report) {
        for (scene::Json& each : report["cases"]) {
            for (const char* member : {"sampling", "conditions", "trust"}) each.erase(member);
            if (!each.contains("metrics")) continue;
            if (each.contains("picture"))
                each["picture"] =
                    std::filesystem::path(each["picture"].get<std::string>()).filename().string();
            for (auto& [name, metric] : each["metrics"].items()) {
                scene::Json kept = {{"unit", metric["unit"]}, {"count", metric["samples"].size()}};
                if (metric["unit"] == "B") kept["samples"] = metric["samples"];
                metric = std::move(kept);
            }
        }
        scene::Json& path = report["scene"]["path"];
        path = std::filesystem::path(path.get<std::string>()).filename().string();
        report.erase("methods");  // counts warnings, too
        report["environment"].erase("started");
        report["environment"].erase("command");
        return report;
    }

    // Returns the JSON Patch from `a` to `b`: "[]" if they are equal.
    static std::string difference(const scene::Json& a, const scene::Json& b) {
        return scene::Json::diff(a, b).dump();
    }

    // Returns the lasting report of the uninterrupted sweep, which is run once.
    scene::Json whole() const {
        static const scene::Json report = [&] {
            const std::filesystem::path out = folder_.file("whole.json");
            const Outcome outcome = run(out);
            EXPECT_EQ(outcome.status, 0) << outcome.output;
            return lasting(report::readReport(out));
        }();
        return report;
    }

    TemporaryFolder folder_;
    std::filesystem::path scene_;
    std::filesystem::path log_ = folder_.file("log");
};

}  // namespace benchmarks::run
