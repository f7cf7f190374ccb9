#include "benchmarks/run/plan.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/environment.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

TEST(Shard, IsTwoNumbers) {
    const report::Shard shard = parseShard("2/8");
    EXPECT_EQ(shard.index, 2u);
    EXPECT_EQ(shard.count, 8u);
    for (const char* wrong :
         {"", "2", "/", "2/", "/8", "2/8/", "-1/8", "a/8", "2 /8", "2/99999999999"})
        EXPECT_THAT(
            errorText([&] { parseShard(wrong); }), testing::HasSubstr("is not I/N, as in 2/8"));
    for (const char* wrong : {"0/8", "9/8", "0/0"})
        EXPECT_THAT(errorText([&] { parseShard(wrong); }), testing::HasSubstr("from 1 to"));
}

// Computed by another program with the Mersenne Twister of the C++ standard.
TEST(ShuffledOrder, IsTheSameEverywhere) {
    EXPECT_THAT(shuffledOrder(8, 1), ElementsAre(7, 2, 1, 4, 6, 0, 3, 5));
}

TEST(ShuffledOrder, HasEachOnce) {
    for (const std::size_t count : {0u, 1u, 2u, 100u}) {
        std::vector<std::size_t> order = shuffledOrder(count, 3);
        std::ranges::sort(order);
        std::vector<std::size_t> all(count);
        std::iota(all.begin(), all.end(), std::size_t{0});
        EXPECT_EQ(order, all);
    }
    EXPECT_NE(shuffledOrder(100, 3), shuffledOrder(100, 4));
}

// ---- Plans --------------------------------------------------------------------------------------

class Plan : public testing::Test {
protected:
    // Writes a scene with five cases.
    std::filesystem::path scene(const std::string& name, int seed = 1) {
        return folder_.write(
            name, R"({"base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json", "seed": )" +
                      std::to_string(seed) +
                      R"(, "sweep": {"/render/msaa": null, "/strands/density": [1, 2, 3, 4, 5]}})");
    }
    static RunPlan
    plan(const std::filesystem::path& file, const char* filter = "", const char* shard = "") {
        return planRun({.scene = file}, filter, shard);
    }

    TemporaryFolder folder_;
};

TEST_F(Plan, SplitsTheCasesAmongShards) {
    const auto file = scene("a.json");
    const RunPlan whole = plan(file);
    EXPECT_EQ(whole.name, "a");
    EXPECT_EQ(whole.case_count, 5u);
    ASSERT_THAT(whole.cases, SizeIs(5));
    std::set<std::size_t> found;
    for (const char* shard : {"1/3", "2/3", "3/3"}) {
        const RunPlan part = plan(file, "", shard);
        EXPECT_EQ(part.case_count, 5u);
        EXPECT_EQ(part.cases_hash, whole.cases_hash);
        EXPECT_EQ(part.scene.hash, whole.scene.hash);
        for (const PlannedCase& each : part.cases) {
            EXPECT_TRUE(found.insert(each.index).second) << each.index;
            EXPECT_EQ(each.spec.name, whole.cases[each.index].spec.name);
        }
    }
    EXPECT_THAT(found, SizeIs(5));
    EXPECT_THAT(plan(file, "", "6/6").cases, SizeIs(0));
}

TEST_F(Plan, KeepsTheNumbersOfWhatAFilterLeaves) {
    const RunPlan some = plan(scene("a.json"), "density:[24]");
    EXPECT_EQ(some.case_count, 5u);
    ASSERT_THAT(some.cases, SizeIs(2));
    EXPECT_EQ(some.cases[0].index, 1u);
    EXPECT_EQ(some.cases[1].index, 3u);
}

TEST_F(Plan, HashesWhatCasesSay) {
    const auto file = scene("a.json");
    const std::string before = plan(file).cases_hash;
    EXPECT_EQ(before, plan(file, "density:4").cases_hash);
    const RunPlan other = planRun({.scene = file, .axes = {"/strands/density=1,2,3,4,6"}}, "", "");
    EXPECT_NE(before, other.cases_hash);
    EXPECT_EQ(other.scene.hash, plan(file).scene.hash);  // no axis is applied there
}

TEST_F(Plan, OfASuiteHasAllScenesCases) {
    scene("a.json");
    scene("b.json", 2);
    const auto suite = folder_.write("both.json", R"({"suite": ["b.json", "a.json"]})");
    const RunPlan both = plan(suite);
    EXPECT_EQ(both.name, "both");
    EXPECT_EQ(both.seed, 2u);
    ASSERT_THAT(both.cases, SizeIs(10));
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(both.cases[i].index, i);
    EXPECT_EQ(both.cases[0].spec.name, "b/density:1");
    EXPECT_EQ(both.cases[9].spec.name, "a/density:5");
    const scene::Json& document = both.scene.document.json();
    EXPECT_EQ(document["suite"]["b"]["seed"], 2);
    EXPECT_EQ(document["suite"]["a"]["seed"], 1);
    EXPECT_EQ(both.scene.hash, report::hashText(both.scene.document.text()));
}

}  // namespace
}  // namespace benchmarks::run
