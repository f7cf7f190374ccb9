#include <gmock/gmock.h>

#include "tests/cli/run_hairbench.h"
#include "tests/compare/made_report.h"
#include "tests/temporary_folder.h"

// Tests `hairbench compare` as a user runs it.
namespace benchmarks::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<double> nearly(double middle) {
    std::vector<double> samples(41, middle);
    for (int i = 0; i < 41; ++i) samples[static_cast<std::size_t>(i)] *= 1.0 + 0.0001 * (i % 3 - 1);
    samples[20] = middle;
    return samples;
}

class CompareCommand : public testing::Test {
protected:
    std::string file(const std::string& name, const scene::Json& report) const {
        return folder_.write(name, report.dump()).string();
    }
    static scene::Json report(double time, const std::string& image = "aaaa") {
        scene::Json made = madeReport();
        made["cases"].push_back(madeCase(
            "made", {{"frame.time", nearly(time)}, {"pass.wind.time", nearly(1.0)}}, image));
        return made;
    }
    const TemporaryFolder& folder() const { return folder_; }

private:
    TemporaryFolder folder_;

protected:
    const std::string a_ = file("a.json", report(10.0));
};

TEST_F(CompareCommand, ShowsWhatChanged) {
    const Outcome slower = hairbench("compare " + a_ + ' ' + file("b.json", report(12.0)));
    EXPECT_EQ(slower.status, 10) << slower.output;
    EXPECT_THAT(slower.output, HasSubstr("frame.time"));
    EXPECT_THAT(slower.output, Not(HasSubstr("pass.wind.time")));
    EXPECT_THAT(slower.output, HasSubstr("1 regressed, 0 improved, 1 same, 0 inconclusive"));
    EXPECT_THAT(slower.output, HasSubstr("hairbench gate decides"));
    const Outcome all = hairbench("compare --all " + a_ + ' ' + file("b.json", report(8.0)));
    EXPECT_EQ(all.status, 0) << all.output;
    EXPECT_THAT(all.output, HasSubstr("pass.wind.time"));
    EXPECT_THAT(all.output, HasSubstr("improved"));
}

TEST_F(CompareCommand, SaysNothingChanged) {
    const Outcome same = hairbench("compare " + a_ + ' ' + a_);
    EXPECT_EQ(same.status, 0) << same.output;
    EXPECT_THAT(same.output, HasSubstr("2 same"));
}

TEST_F(CompareCommand, FailsOnInconclusiveWhereAskedTo) {
    scene::Json few = madeReport();
    few["cases"].push_back(madeCase("made", {{"frame.time", {10.0, 11.0, 12.0}}}, "aaaa"));
    const std::string b = file("b.json", few);
    const Outcome unknown = hairbench("compare " + a_ + ' ' + b);
    EXPECT_EQ(unknown.status, 0);
    EXPECT_THAT(unknown.output, HasSubstr("1 of 1 changes can't be known"));
    EXPECT_EQ(hairbench("compare --fail-on inconclusive " + a_ + ' ' + b).status, 11);
}

TEST_F(CompareCommand, FailsWherePicturesDiffer) {
    const Outcome other = hairbench("compare " + a_ + ' ' + file("b.json", report(10.0, "bbbb")));
    EXPECT_EQ(other.status, 12) << other.output;
    EXPECT_THAT(other.output, HasSubstr("made: the pictures differ: aaaa and bbbb"));
}

TEST_F(CompareCommand, SaysThatNothingIsInCommon) {
    EXPECT_EQ(hairbench("compare " + a_ + ' ' + file("b.json", madeReport())).status, 14);
    EXPECT_EQ(hairbench("compare " + a_ + " nowhere.json").status, 2);
    EXPECT_EQ(hairbench("compare " + a_).status, 2);
}

TEST_F(CompareCommand, WritesJson) {
    const Outcome outcome = hairbench("compare --json " + a_ + ' ' + file("b.json", report(12.0)));
    EXPECT_EQ(outcome.status, 10);
    const scene::Json json = scene::Json::parse(outcome.output);
    EXPECT_EQ(json["verdict"], "regressed");
    EXPECT_EQ(json["changes"].size(), 2u);
    EXPECT_EQ(json["changes"][0]["verdict"], "regressed");
    EXPECT_NEAR(json["changes"][0]["change"].get<double>(), 0.2, 1e-9);
}

TEST_F(CompareCommand, ComparesWithABaseline) {
    const std::string before = "HAIRBENCH_BASELINES='" + folder().path().string() + "' ";
    const std::string b = file("b.json", report(12.0));
    const Outcome missing = hairbench("compare --baseline old " + b, before);
    EXPECT_EQ(missing.status, 13) << missing.output;
    file("old/made.json", report(10.0));
    const Outcome slower = hairbench("compare --baseline old " + b, before);
    EXPECT_EQ(slower.status, 10) << slower.output;
    scene::Json elsewhere = report(10.0);
    elsewhere["environment"]["device"]["name"] = "Other";
    file("old/made.json", elsewhere);
    const Outcome incompatible = hairbench("compare --baseline old " + b, before);
    EXPECT_EQ(incompatible.status, 13);
    EXPECT_THAT(incompatible.output, HasSubstr("comes from another device"));
    file("old/made.json", scene::Json{{"schema", "hairbench-report/9.0.0"}});
    EXPECT_EQ(hairbench("compare --baseline old " + b, before).status, 13);
    EXPECT_EQ(hairbench("compare --baseline ../old " + b, before).status, 2);
    EXPECT_EQ(hairbench("compare --baseline old " + a_ + ' ' + b, before).status, 2);
}

}  // namespace
}  // namespace benchmarks::report
