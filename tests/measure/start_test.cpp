#include "benchmarks/measure/measure.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"

namespace benchmarks::measure {
namespace {

using hair::simulation::GuideCondition;
using testing::ElementsAre;
using testing::IsEmpty;

hair::Settings settledSettings() {
    hair::Settings settings;
    settings.simulation.settle_steps = 30;
    return settings;
}

TEST(Start, SaysWhereTheHairIsFrom) {
    hair::Settings settings;
    EXPECT_EQ(judgeStart({}, nullptr, settings).record.from, "grown");
    settings.groom.file = "hair.hair";
    EXPECT_EQ(judgeStart({}, nullptr, settings).record.from, "file");
    settings.simulation.settle_steps = 1;
    EXPECT_EQ(judgeStart({}, nullptr, settings).record.from, "relaxed");
    settings.simulation.solver = hair::Solver::none;
    EXPECT_EQ(judgeStart({}, nullptr, settings).record.from, "file") << "nothing moves";
    EXPECT_EQ(judgeStart({}, nullptr, settings).record.rest, "groom");
    settings.simulation.rest = hair::RestShape::balanced;
    EXPECT_EQ(judgeStart({}, nullptr, settings).record.rest, "balanced");
}

TEST(Start, WarnsOfWhatIsWrongAndNamesTheGuide) {
    const GuideCondition wrong{
        .stretch = {.value = 1.3125, .guide = 17, .guides = 2},
        .depth = {.value = 0.0014, .guide = 8, .guides = 1},
        .speed = {.value = 0.25, .guide = 3, .guides = 5}};
    const StartInspection start = judgeStart(wrong, nullptr, settledSettings());
    EXPECT_EQ(start.record.stretch.value, 1.3125);
    EXPECT_EQ(start.record.depth.guide, 8u);
    EXPECT_EQ(start.record.speed.guides, 5u);
    EXPECT_FALSE(start.record.stiffened);
    EXPECT_THAT(
        start.warnings,
        ElementsAre(
            "hair starts torn: a segment of guide 17 is 1.31 times its rest length; 2 guides "
            "beyond 1.05 times",
            "hair starts inside a body: guide 8 is 1.4 mm deep; 1 guide deeper than 0.1 mm",
            "hair has not settled: guide 3 moves at 250 mm/s; 5 guides faster than 10 mm/s; raise "
            "/simulation/settle_steps (30)"));
}

TEST(Start, IsSilentWhereNothingIsWrong) {
    const GuideCondition fine{
        .stretch = {.value = 1.04}, .depth = {.value = 5e-5}, .speed = {.value = 0.009}};
    EXPECT_THAT(judgeStart(fine, nullptr, settledSettings()).warnings, IsEmpty());
}

// The thesis's iterations stretch hair, and so do lengths without a constraint. The settings
// request this.
TEST(Start, GivesTheFigureAloneWhereLengthsAreNotKept) {
    const GuideCondition stretched{.stretch = {.value = 1.5, .guide = 1, .guides = 9}};
    hair::Settings settings = settledSettings();
    settings.simulation.length.method = hair::LengthMethod::iterate;
    EXPECT_THAT(judgeStart(stretched, nullptr, settings).warnings, IsEmpty());
    EXPECT_EQ(judgeStart(stretched, nullptr, settings).record.stretch.value, 1.5);
    settings.simulation.length = {.iterations = 0};
    EXPECT_THAT(judgeStart(stretched, nullptr, settings).warnings, IsEmpty());
    settings.simulation.solver = hair::Solver::rod;
    EXPECT_EQ(judgeStart(stretched, nullptr, settings).warnings.size(), 1u);
}

TEST(Start, SaysWhatBalanceTook) {
    hair::simulation::RestBalance balance;
    balance.add(1.0);
    balance.add(2.5);
    balance.add(1.5);
    balance.unbalanced = {4, 7};
    hair::Settings settings;
    settings.simulation.solver = hair::Solver::rod;
    const StartInspection start = judgeStart({}, &balance, settings);
    EXPECT_EQ(start.record.stiffened, 2u);
    EXPECT_EQ(start.record.stiffest, 2.5);
    EXPECT_EQ(start.record.unbalanced, 2u);
    EXPECT_THAT(
        start.warnings, ElementsAre("hair sags: guide 4 can't be balanced by a stiffening of 16 "
                                    "(/simulation/most_stiffening); 2 guides in all"));
    settings.simulation.solver = hair::Solver::shape;
    EXPECT_THAT(
        judgeStart({}, &balance, settings).warnings,
        ElementsAre("hair sags: guide 4 can't be balanced if nothing pulls it to its place "
                    "(/simulation/global/stiffness is 0); 2 guides in all"));
}

using StartOnDevice = GpuTest;

// tests/simulation/hair_hair_test.cpp compares the numbers with theory.
TEST_F(StartOnDevice, WarnsOnceOfAnAttractionThatTheStepLimits) {
    hair::Settings settings;
    settings.groom.guides = 24;
    settings.strands.density = 1;
    settings.render.width = 16;
    settings.render.height = 16;
    settings.simulation.hair_hair = {.attraction = 100.0f};
    const auto warnings = [&] {
        return inspectStart(Case(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes", nullptr))
            .warnings;
    };
    const std::vector<std::string> limited = warnings();
    ASSERT_EQ(limited.size(), 1u);
    EXPECT_THAT(
        limited[0], testing::MatchesRegex(
                        "/simulation/hair_hair/attraction: 100 acts as [0-9.]+ m.2/s.2, as much as "
                        "the time step bears; steps of [0-9.]+ s or less bear all of it"));
    const std::string before = "steps of ";
    settings.simulation.time_step =
        std::stof(limited[0].substr(limited[0].find(before) + before.size()));
    EXPECT_THAT(warnings(), IsEmpty());
}

}  // namespace
}  // namespace benchmarks::measure
