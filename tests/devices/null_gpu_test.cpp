// Tests drivers of GPUs that the machine lacks: scripts/null-gpu. They compile and validate, and
// execute nothing.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/extensions.h"
#include "engine/system/child.h"
#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class NullGpu : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const Outcome outcome = run("devices");
        if (outcome.output.find("there is no usr/lib/*/libvulkan_nouveau.so") != std::string::npos)
            GTEST_SKIP() << outcome.output;  // Debian 12 does not package NVK
        if (outcome.status != 0) return skipWithout(Need::null_gpus, outcome.output);
        ASSERT_THAT(outcome.output, HasSubstr("runs hairbench"));
    }

    static Outcome run(const std::string& arguments) {
        return hairbench(
            arguments,
            "'" HAIRBENCH_SOURCE_DIR "/scripts/null-gpu' " + std::string(GetParam()) + ' ');
    }

    fs::path file(const std::string& name) const { return folder_.path() / name; }

    nlohmann::json casesOf(const std::string& report) const {
        return nlohmann::json(nlohmann::json::parse(std::ifstream(file(report))).at("cases"));
    }

    // Expects no spills in the cases of a report, and figures of them. NVK tells spilled registers
    // as scratch memory, with the arrays of shape_serial, which no GPU's registers hold.
    void expectNoSpills(const std::string& report, const std::string& scene) const {
        const std::string figure = GetParam() == std::string("ga102") ? ".scratch" : ".spills";
        int found = 0;
        for (const nlohmann::json& each : casesOf(report)) {
            if (!each.contains("metrics")) continue;
            for (const auto& [name, metric] : each["metrics"].items()) {
                if (!name.ends_with(figure) || name.find("shape_serial") != std::string::npos)
                    continue;
                ++found;
                EXPECT_EQ(metric["median"], 0) << scene << ' ' << each["name"] << ' ' << name;
            }
        }
        EXPECT_GT(found, 0) << scene;
    }

    TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Amd, NullGpu, testing::Values("polaris10", "navi21", "navi31"));
INSTANTIATE_TEST_SUITE_P(Nvidia, NullGpu, testing::Values("ga102"));

// The lines of a table, without those about the run.
std::string tableIn(const std::string& output) {
    std::istringstream lines(output);
    std::string table;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("shader ") || (!table.empty() && !line.starts_with("report: ")))
            table += line + '\n';
    return table;
}

// results/shaders-GPU.txt holds the tables, after a line that names the driver. A changed table is
// a changed cost: look at the difference, and commit it with its reason. Another release of a
// driver has another compiler.
TEST_P(NullGpu, CompilesShadersToTheCostsOfTheCommittedTable) {
    std::string tables, output;
    for (const std::string scene :
         {"backends --filter guides:86/density:4/",
          "solvers_scale --filter 'guides:10000/.*repulsion'"}) {
        const Outcome outcome =
            run("shaders " + scene + " --out '" + file("shaders.json").string() + "'");
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        output = outcome.output;
        tables += tableIn(outcome.output);
        expectNoSpills("shaders.json", scene);
    }
    const fs::path committed = fs::path(HAIRBENCH_SOURCE_DIR) / "results" /
                               ("shaders-" + std::string(GetParam()) + ".txt");
    std::ifstream text(committed);
    std::string driver;
    std::getline(text, driver);
    if (!driver.empty() && output.find(driver) == std::string::npos)
        GTEST_SKIP() << committed << " is by " << driver;
    std::ostringstream expected;
    expected << text.rdbuf();
    EXPECT_EQ(tables, expected.str()) << committed;
}

// Three minutes for each driver: scripts/test --device radv or nvk.
TEST_P(NullGpu, CompilesEveryShippedSceneWithoutSpills) {
    if (!std::getenv("HAIRBENCH_EVERY_SCENE")) GTEST_SKIP() << "HAIRBENCH_EVERY_SCENE is not set";
    for (const std::string& scene : benchmarks::scene::shippedScenes()) {
        const Outcome outcome =
            run("shaders " + scene + " --out '" + file("shaders.json").string() + "'");
        ASSERT_EQ(outcome.status, 0) << scene << '\n' << outcome.output;
        expectNoSpills("shaders.json", scene);
    }
}

// Two queues, where the driver has them.
TEST_P(NullGpu, RecordsFramesThatValidationAccepts) {
    const Outcome outcome =
        run("run " + shippedScene("smoke.json") +
            (run("devices").output.find("second queue") == std::string::npos
                 ? "--set /run/async_compute=true "
                 : "") +
            "--frames 2 --max-time 0 --validate --out '" + file("run.json").string() + "'");
    EXPECT_THAT(outcome.output, HasSubstr("the device did not write a timestamp"));
    // A failed case has this member only for its warnings.
    const nlohmann::json cases = casesOf("run.json");
    EXPECT_FALSE(cases.empty());
    for (const nlohmann::json& each : cases) EXPECT_FALSE(each.contains("trust")) << each["trust"];
}

// The driver answers nothing that a frame computes, so that the cases fail, but compiles them.
TEST_P(NullGpu, TellsARunTheCostsOfItsShaders) {
    const std::string scene = shippedScene("smoke.json");
    run("run " + scene + "--frames 2 --max-time 0 --out '" + file("run.json").string() + "'");
    run("run " + scene + "--frames 2 --max-time 0 --no-shader-costs --out '" +
        file("without.json").string() + "'");
    ASSERT_EQ(run("shaders " + scene + "--out '" + file("shaders.json").string() + "'").status, 0);
    const nlohmann::json cases = casesOf("run.json"), without = casesOf("without.json"),
                         compiled = casesOf("shaders.json");
    ASSERT_EQ(cases.size(), compiled.size());
    ASSERT_EQ(without.size(), compiled.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ASSERT_FALSE(compiled[i]["shaders"].empty());
        EXPECT_EQ(cases[i]["shaders"], compiled[i]["shaders"]);
        EXPECT_FALSE(without[i].contains("shaders"));
    }
}

// The interrupt comes once a case is compiled, and long before the last one is.
TEST_P(NullGpu, InterruptedShadersSaveTheCasesThatAreCompiled) {
    setenv("HAIRBENCH_PROGRESS_SECONDS", "0.1", 1);
    engine::system::Program program(
        {HAIRBENCH_SOURCE_DIR "/scripts/null-gpu", GetParam(), HAIRBENCH_PROGRAM, "shaders",
         "backends", "--out", file("shaders.json").string()},
        file("output"), folder_.path());
    unsetenv("HAIRBENCH_PROGRESS_SECONDS");
    const auto ended = [&](const auto& meanwhile) {  // within minutes, or the test has failed
        for (int i = 0; i < 18'000; ++i) {
            if (const auto end = program.end()) return end;
            if (meanwhile()) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return program.end();
    };
    const std::regex later(R"(\[([2-9]|[0-9]{2,})/)");  // "[2/54] 0:01": the second case
    ASSERT_FALSE(
        ended([&] { return std::regex_search(textOf(file("output")), later); }).has_value())
        << textOf(file("output"));
    program.interrupt();
    const auto end = ended([] { return false; });
    const std::string output = textOf(file("output"));
    ASSERT_TRUE(end.has_value()) << output;
    EXPECT_FALSE(end->signaled) << output;
    EXPECT_EQ(end->status, 130) << output;

    const auto report = nlohmann::json::parse(textOf(file("shaders.json")));
    const nlohmann::json& cases = report.at("cases");
    EXPECT_EQ(report.at("interrupted"), true);
    EXPECT_FALSE(cases.empty());
    EXPECT_LT(cases.size(), report.at("case_count").get<std::size_t>());
    for (const nlohmann::json& each : cases)
        EXPECT_TRUE(each.at("status") != "ok" || each.contains("shaders")) << each["name"];
    EXPECT_THAT(
        output, HasSubstr(
                    "interrupted after " + std::to_string(cases.size()) + " of " +
                    report.at("case_count").dump() + " cases"));
    EXPECT_THAT(output, HasSubstr("instructions"));  // of the table
}

// A shading model that keeps more numbers than there are registers.
TEST_P(NullGpu, GateCallsAPlantedSpillARegression) {
    std::ofstream(file("plain.glsl"))
        << "vec3 shadeHair(HairPoint point) { return point.color; }\n";
    std::ofstream(file("spilling.glsl"))
        << "vec3 shadeHair(HairPoint point) {\n"
           "    vec4 kept[96];\n"
           "    for (int i = 0; i < 96; ++i)\n"
           "        kept[i] = sin(vec4(point.position, point.across) * float(i + 1));\n"
           "    vec4 sum = vec4(0.0);\n"
           "    for (int i = 0; i < 96; ++i)\n"
           "        sum += kept[i] * kept[int(abs(kept[i].x) * 95.0)];\n"
           "    return point.color * sum.rgb;\n"
           "}\n";
    std::ofstream(file("mine.json")) << R"({"base": ")" HAIRBENCH_SCENES_DIR
                                        R"(/rest.json", "shading": {"model": "plain.glsl"}})";
    const std::string program = "'" HAIRBENCH_PROGRAM "'";
    const std::string gate = "gate --shaders --allow-outside --a " + program + " --b " + program +
                             " --scene '" + file("mine.json").string() + "' --out '" +
                             file("gate.json").string() + "'";
    const Outcome same = run(gate);
    EXPECT_EQ(same.status, 0) << same.output;
    EXPECT_THAT(same.output, HasSubstr("0 regressed"));
    const Outcome worse = run(gate + " --set-b /shading/model=spilling.glsl");
    EXPECT_EQ(worse.status, 10) << worse.output;
    EXPECT_THAT(worse.output, testing::ContainsRegex("frag.scratch +0 B +[1-9]"));
}

}  // namespace
