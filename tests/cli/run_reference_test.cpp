// Tests /run/reference as a user runs it.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/reference_python.h"
#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

using testing::HasSubstr;
using testing::Not;

class RunReferenceCli : public testing::Test {
protected:
    void SetUp() override {
        if (hairbench("devices").status != 0) return skipWithout(Need::device, "no Vulkan device");
        folder_.write("still.json", R"({
            "base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json",
            "render": {"width": 64, "height": 48},
            "run": {"warmup": 2, "frames": 1, "frame_time": 0, "reference": "truth.png"},
            "sweep": {"/render/msaa": null, "/strands/density": [4, 8]}
        })");
    }

    std::string quoted(std::string_view name) const {
        return "'" + folder_.file(name).string() + "' ";
    }

    // Draws the first case's picture, with further options in `more`, e.g. another size.
    void drawTruth(const std::string& more = "") const {
        const Outcome outcome = hairbench(
            "render " + quoted("still.json") + "-a /strands/density=4 " + more + "-o " +
            quoted("truth.png"));
        ASSERT_EQ(outcome.status, 0) << outcome.output;
    }

    Outcome run(const std::string& before = "") const {
        return hairbench("run " + quoted("still.json") + "--out " + quoted("report.json"), before);
    }

    nlohmann::json cases() const {
        return nlohmann::json::parse(textOf(folder_.file("report.json"))).at("cases");
    }

    TemporaryFolder folder_;
};

TEST_F(RunReferenceCli, ReportsTheErrorOfEachCase) {
    if (!hasReferencePython()) GTEST_SKIP() << kNoReference;
    drawTruth();
    const Outcome outcome = run();
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("FLIP"));
    const nlohmann::json same = cases().at(0).at("metrics");
    EXPECT_EQ(same.at("image.rmse").at("median"), 0.0);
    EXPECT_EQ(same.at("image.flip").at("median"), 0.0);
    EXPECT_EQ(same.at("image.ssim").at("median"), 1.0);
    EXPECT_FALSE(same.contains("image.psnr"));  // it is infinite
    const nlohmann::json other = cases().at(1).at("metrics");
    EXPECT_GT(other.at("image.flip").at("median"), 0.0);
    EXPECT_EQ(other.at("image.psnr").at("unit"), "dB");
}

TEST_F(RunReferenceCli, FailsCasesOfAnotherSize) {
    if (!hasReferencePython()) GTEST_SKIP() << kNoReference;
    drawTruth("-a /render/width=32 ");
    run();
    EXPECT_EQ(cases().at(0).at("status"), "failed");
    EXPECT_THAT(cases().at(0).at("reason"), HasSubstr("32 x 48 px"));
}

TEST_F(RunReferenceCli, WarnsOnceWhereTheEnvironmentIsMissing) {
    drawTruth();
    const Outcome outcome = run("HAIRBENCH_REFERENCE_PYTHON=/no/such/python ");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, Not(HasSubstr("FLIP")));
    int warned = 0;
    for (int i = 0; i < 2; ++i) {
        EXPECT_FALSE(cases().at(i).at("metrics").contains("image.flip"));
        const std::string warnings = cases().at(i).at("trust").at("warnings").dump();
        if (warnings.find("run scripts/setup --reference") == std::string::npos) continue;
        ++warned;
        EXPECT_EQ(cases().at(i).at("order"), 0);  // the case that ran first
    }
    EXPECT_EQ(warned, 1);
}

TEST_F(RunReferenceCli, NamesAReferenceThatIsNotThere) {
    const Outcome outcome = run();
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr("/run/reference: "));
    EXPECT_THAT(outcome.output, HasSubstr("truth.png: is not a file"));
}

}  // namespace
