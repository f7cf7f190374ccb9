// Tests `hairbench ablate` as a user runs it.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/doctor/reports.h"
#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class AblateCli : public testing::Test {
protected:
    void SetUp() override {
        if (hairbench("devices").status != 0) return skipWithout(Need::device, "no Vulkan device");
        folder_.write("small.json", R"({
            "base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json",
            "render": {"width": 64, "height": 48},
            "strands": {"density": 4},
            "run": {"warmup": 2, "frames": 1},
            "sweep": {"/render/msaa": null, "/strands/backend": ["tessellation", "pulling_geometry"]}
        })");
    }

    Outcome ablate(const std::string& more) const {
        return hairbench(
            "ablate '" + folder_.file("small.json").string() + "' --passes 2 -o '" +
            folder_.file("report.json").string() + "' " + more);
    }

    TemporaryFolder folder_;
};

TEST_F(AblateCli, WritesAReport) {
    const Outcome outcome = ablate("");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("tessellation 2"));
    EXPECT_THAT(outcome.output, HasSubstr("skipped: /strands/backend: "));
    const std::string text = textOf(folder_.file("report.json"));
    EXPECT_THAT(
        benchmarks::report::schemaErrors(
            textOf(HAIRBENCH_SCENES_DIR "/../results/ablation.schema.json"), text),
        IsEmpty());
    const nlohmann::json cases = nlohmann::json::parse(text).at("cases");
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases[0].at("status"), "ok");
    EXPECT_EQ(cases[0].at("frame"), 3);  // frames 0 and 1 warm up; of the two played frames, 3 is
                                         // the second
    EXPECT_EQ(cases[0].at("rungs").size(), 7u);
    EXPECT_EQ(cases[0].at("rungs")[2].at("time").at("laps").size(), 2u);
    EXPECT_EQ(cases[1].at("status"), "skipped");
}

TEST_F(AblateCli, FailsWhereNothingCanBeAblated) {
    const Outcome outcome = ablate("--filter pulling");
    EXPECT_EQ(outcome.status, 14) << outcome.output;
    EXPECT_EQ(ablate("--filter nosuchcase").status, 14);
}

}  // namespace
