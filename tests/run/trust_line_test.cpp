// Tests the line that `run` ends with when cases are not trusted.
#include <functional>
#include <string>

#include "tests/run/tiny_sweep.h"

namespace benchmarks::run {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class TrustLine : public TinySweep {
protected:
    // A complete report, changed in each case that ran as if another machine had measured it.
    void write(const std::function<void(scene::Json& result)>& change) {
        scene::Json report = measured();
        for (scene::Json& each : report["cases"])
            if (each["status"] == "ok") {
                each["conditions"] = scene::Json::object();
                each["trust"] = {{"warnings", scene::Json::array()}};
                each["sampling"] = scene::Json::array();
                scene::Json& frame = each["metrics"]["frame.time"];
                frame["interval"] = {
                    {"lower", 0.99 * frame["median"].get<double>()},
                    {"upper", 1.01 * frame["median"].get<double>()},
                    {"confidence", 0.95}};
                change(each);
            }
        report::writeReport(report, out_);
    }

    // A run that finds this report complete, and only judges it.
    Outcome judge(const std::vector<std::string>& options = {}) {
        std::vector<std::string> all{"--resume"};
        all.insert(all.end(), options.begin(), options.end());
        return run(out_, all);
    }

    scene::Json measured() {
        static const scene::Json report = [&] {
            EXPECT_EQ(run(out_).status, 0);
            return report::readReport(out_);
        }();
        return report;
    }

    static std::size_t ran(const scene::Json& report) {
        std::size_t count = 0;
        for (const scene::Json& each : report["cases"]) count += each["status"] == "ok";
        return count;
    }

    static void disturb(scene::Json& result) { result["conditions"]["other_load"] = 0.2; }
    static void drown(scene::Json& result) { result["conditions"]["other_load"] = 0.73; }

    std::filesystem::path out_ = folder_.file("r.json");
};

TEST_F(TrustLine, IsTheLastOneOfARun) {
    const Outcome outcome = run(out_);
    EXPECT_EQ(outcome.status, 0);
    // A single round of two frames gives no interval, whatever else went on.
    EXPECT_THAT(outcome.output, EndsWith("\"hairbench doctor\" says more\n"));
    const scene::Json report = report::readReport(out_);
    ASSERT_GT(ran(report), 0u);
    for (const scene::Json& each : report["cases"]) {
        EXPECT_EQ(each.contains("/trust/verdict"_json_pointer), each["status"] == "ok");
        if (each["status"] == "ok") {
            EXPECT_NE(each["trust"]["verdict"], "trusted");
            EXPECT_FALSE(each["trust"]["reasons"].empty());
        }
    }
}

TEST_F(TrustLine, IsAbsentWhereAllIsTrusted) {
    write([](scene::Json&) {});
    const Outcome outcome = judge({"--fail-on", "doubtful"});
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("nothing left to do"));
    EXPECT_THAT(outcome.output, Not(HasSubstr("hairbench doctor")));
}

TEST_F(TrustLine, CountsTheCasesAndNamesTheWorst) {
    write(drown);
    const std::string all = std::to_string(ran(measured()));
    EXPECT_THAT(
        judge().output,
        EndsWith(
            "hairbench: " + all + " of " + all +
            " cases are not to be trusted: up to 73.0 % of all processors' time was used by "
            "others; \"hairbench doctor\" says more\n"));
}

TEST_F(TrustLine, FailsARunOnRequest) {
    write(disturb);
    EXPECT_EQ(judge().status, 0);
    EXPECT_EQ(judge({"--fail-on", "doubtful"}).status, 15);
    EXPECT_EQ(judge({"--fail-on", "untrusted"}).status, 0);
    EXPECT_EQ(judge({"--fail-on", "untrusted", "--fail-on", "doubtful"}).status, 15);
    EXPECT_EQ(judge({"--fail-on", "inconclusive"}).status, 0);
    write(drown);
    EXPECT_EQ(judge().status, 0);
    EXPECT_EQ(judge({"--fail-on", "doubtful"}).status, 15);
    EXPECT_EQ(judge({"--fail-on", "untrusted"}).status, 15);
    EXPECT_EQ(judge({"--fail-on", "noise"}).status, 2);
}

TEST_F(TrustLine, IsAlsoOfAMerge) {
    write(drown);
    const Outcome outcome =
        hairbench("merge '" + out_.string() + "' -o '" + folder_.file("whole.json").string() + "'");
    const std::string all = std::to_string(ran(measured()));
    EXPECT_THAT(outcome.output, HasSubstr(" reports: " + all + " untrusted\n"));
    EXPECT_THAT(outcome.output, HasSubstr(" cases are not to be trusted: up to 73.0 %"));
    EXPECT_EQ(
        report::readReport(folder_.file("whole.json"))["cases"][0]["trust"]["verdict"],
        "untrusted");
}

}  // namespace
}  // namespace benchmarks::run
