// Tests shards of a sweep that are merged.
#include "tests/run/tiny_sweep.h"

namespace benchmarks::run {
namespace {

using testing::HasSubstr;

class Sharded : public TinySweep {
protected:
    std::string shards(std::initializer_list<int> which) {
        std::string files;
        for (const int i : which) {
            const auto out = folder_.file("shards/" + std::to_string(i) + ".json");
            const Outcome outcome = run(out, {"--shard", std::to_string(i) + "/3"});
            EXPECT_EQ(outcome.status, 0) << outcome.output;
            files += " '" + out.string() + "'";
        }
        return files;
    }
    Outcome merge(const std::string& files) {
        return hairbench("merge" + files + " -o '" + merged_.string() + "'");
    }

    std::filesystem::path merged_ = folder_.file("merged.json");
};

TEST_F(Sharded, MergeToWhatOneRunGives) {
    const Outcome outcome = merge(shards({1, 2, 3}));
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("merged.json: 8 cases of 3 reports"));
    const scene::Json report = report::readReport(merged_);
    scene::Json expected = whole();
    scene::Json found = lasting(report);
    for (scene::Json* const each : {&expected, &found})
        for (scene::Json& result : (*each)["cases"]) result.erase("order");
    EXPECT_EQ(difference(found, expected), "[]");
    for (const scene::Json& each : report["cases"])
        if (each.contains("picture")) {
            EXPECT_TRUE(std::filesystem::exists(folder_.file(each["picture"].get<std::string>())));
        }
}

TEST_F(Sharded, SaysWhatIsMissing) {
    const Outcome outcome = merge(shards({1, 3}));
    EXPECT_EQ(outcome.status, 130);
    EXPECT_THAT(
        outcome.output,
        HasSubstr("3 of 8 cases are missing: number 1, 4, 7 of the sweep, counted from 0\n"));
    EXPECT_EQ(report::readReport(merged_)["interrupted"], true);
}

TEST_F(Sharded, AreFilesOfTheirOwn) {
    const Outcome outcome = runInShell(
        "cd '" + folder_.path().string() + "' && '" HAIRBENCH_PROGRAM "' run '" + scene_.string() +
        "' --shard 2/3 2>&1");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, HasSubstr("report: results/local/tiny.2of3.json\n"));
}

TEST_F(Sharded, WithoutACaseIsNoRun) {
    const Outcome outcome = run(folder_.file("none.json"), {"--shard", "9/9"});
    EXPECT_EQ(outcome.status, 14);
    EXPECT_THAT(outcome.output, HasSubstr("none of the 8 cases is in shard 9/9\n"));
}

}  // namespace
}  // namespace benchmarks::run
