#include "benchmarks/ablate/ablation.h"

#include <gmock/gmock.h>

#include "tests/ablate/made_up_times.h"

namespace benchmarks::ablate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Every number here and in sampleTimes() is a sum of powers of two, so nothing is rounded.
std::vector<double> marginals(const Attribution& attribution) {
    std::vector<double> costs;
    for (const RungCost& rung : attribution.rungs) costs.push_back(rung.marginal.estimate);
    return costs;
}

TEST(LapTime, IsTheMeanOfBothVisitsMedians) {
    EXPECT_EQ(lapTime({.up = {7.0, 1.0, 2.0}, .down = {4.0, 4.0, 100.0}}), 3.0);
}

TEST(Attribution, TakesTheRungBelowFromEach) {
    const Attribution attribution = attribute(steadyTimes(sampleTimes(), 8));
    EXPECT_THAT(marginals(attribution), ElementsAre(1, 2, 3, 4, 5, 20, 10, 15));
    EXPECT_EQ(attribution.pass_time, 60.5);
    EXPECT_DOUBLE_EQ(attribution.rungs[5].share, 20.0 / 60.5);
    EXPECT_EQ(attribution.rungs[5].time, 35.0);
}

// Closure is 60.5 - 60, discard 14 - 15, and multisampling (60 - 45) - (48 - 35).
TEST(Attribution, KnowsWhatMarginalCostsLeaveOpen) {
    const Residual residual = attribute(steadyTimes(sampleTimes(), 8)).residual;
    EXPECT_EQ(residual.closure.estimate, 0.5);
    EXPECT_EQ(residual.discard.estimate, -1.0);
    ASSERT_TRUE(residual.multisampling);
    EXPECT_EQ(residual.multisampling->estimate, 2.0);
    EXPECT_EQ(residual.interaction.estimate, 1.5);
}

// The costs in another order are 1 + (15 - 1) + (35 - 14) + (45 - 35) + (48 - 35) = 59 of 60.5 ms.
TEST(Attribution, ItsInteractionIsThePassLessCostsInAnotherOrder) {
    const std::map<Stop, double> t = sampleTimes();
    const double other = t.at(Stop::empty) + (t.at(Stop::geometry) - t.at(Stop::empty)) +
                         (t.at(Stop::raster) - t.at(Stop::clipped)) +
                         (t.at(Stop::fragment) - t.at(Stop::raster)) +
                         (t.at(Stop::raster_msaa) - t.at(Stop::raster));
    EXPECT_EQ(other, 59.0);
    EXPECT_EQ(attribute(steadyTimes(t, 8)).residual.interaction.estimate, t.at(Stop::pass) - other);
}

TEST(Attribution, OfOneSampleEndsAtTheFragments) {
    std::map<Stop, double> times = sampleTimes();
    times.erase(Stop::msaa);
    times.erase(Stop::raster_msaa);
    times.erase(Stop::tessellation_1);
    times[Stop::pass] = 45.5;
    const Attribution attribution = attribute(steadyTimes(times, 8));
    EXPECT_THAT(marginals(attribution), ElementsAre(1, 2, 7, 5, 20, 10));
    EXPECT_FALSE(attribution.residual.multisampling);
    EXPECT_EQ(attribution.residual.closure.estimate, 0.5);
    EXPECT_EQ(attribution.residual.interaction.estimate, -0.5);
}

TEST(Attribution, SaysWhatWatchingCosts) {
    const auto watching = attribute(steadyTimes(sampleTimes(), 8)).watching;
    ASSERT_EQ(watching.size(), 3u);
    EXPECT_EQ(watching[1].first, Stop::watched_evaluation);
    EXPECT_EQ(watching[1].second.estimate, 0.25);
}

// The device gets slower by 0.25 ms with each visit, on the way up and down. The costs do not
// change.
TEST(Attribution, IsBlindToEvenDrift) {
    std::vector<StopTimes> stops = steadyTimes(sampleTimes(), 6);
    for (std::size_t lap = 0; lap < 6; ++lap) {
        const auto first = static_cast<double>(2 * stops.size() * lap);
        for (std::size_t i = 0; i < stops.size(); ++i) {
            stops[i].laps[lap].up[0] += 0.25 * (first + static_cast<double>(i));
            stops[i].laps[lap].down[0] +=
                0.25 * (first + static_cast<double>(2 * stops.size() - 1 - i));
        }
    }
    const std::vector<double> costs = marginals(attribute(stops));
    EXPECT_THAT(std::vector(costs.begin() + 1, costs.end()), ElementsAre(2, 3, 4, 5, 20, 10, 15));
}

// Walsh averages of 1 ... 6 run from 1 to 6 and have the median 3.5. With n = 6 only the extreme
// ranks can be rejected at 5 %: 2 / 2^6 = 3.1 %.
TEST(Cost, IsTheHodgesLehmannEstimateWithItsInterval) {
    const Cost cost = costOf(std::vector{6.0, 1.0, 4.0, 2.0, 5.0, 3.0});
    EXPECT_EQ(cost.estimate, 3.5);
    ASSERT_TRUE(cost.interval);
    EXPECT_EQ(cost.interval->lower, 1.0);
    EXPECT_EQ(cost.interval->upper, 6.0);
    EXPECT_DOUBLE_EQ(cost.interval->confidence, 1.0 - 2.0 / 64.0);
}

TEST(Cost, HasNoIntervalOfFiveLaps) {
    EXPECT_FALSE(costOf(std::vector{1.0, 2.0, 3.0, 4.0, 5.0}).interval);
}

TEST(AttributionWarnings, AreNoneWhereAllFits) {
    EXPECT_THAT(attributionWarnings(attribute(steadyTimes(sampleTimes(), 8))), IsEmpty());
}

TEST(AttributionWarnings, NameWhatDoesNot) {
    const auto warned = [](Stop stop, double time, std::size_t laps = 8) {
        std::map<Stop, double> times = sampleTimes();
        times[stop] = time;
        return attributionWarnings(attribute(steadyTimes(times, laps)));
    };
    EXPECT_THAT(warned(Stop::clipped, 16.75), ElementsAre(HasSubstr("clipping")));  // 15 * 1.1
    EXPECT_THAT(warned(Stop::clipped, 13.25), ElementsAre(HasSubstr("clipping")));
    EXPECT_THAT(warned(Stop::clipped, 16.25), IsEmpty());
    EXPECT_THAT(warned(Stop::pass, 61.5), ElementsAre(HasSubstr("top of the ladder")));  // 2 %
    EXPECT_THAT(warned(Stop::pass, 61.0), IsEmpty());
    EXPECT_THAT(warned(Stop::watched_geometry, 45.75), ElementsAre(HasSubstr("watched_geometry")));
    EXPECT_THAT(warned(Stop::watched_vertex, 45.5), IsEmpty());  // a quarter of the stage, but
                                                                 // 0.8 % of the pass
    EXPECT_THAT(warned(Stop::vertex, 0.5), testing::Contains(HasSubstr("vertex: the pass takes")));
    EXPECT_THAT(warned(Stop::clipped, 100.0, 5), IsEmpty());  // too few laps to tell
}

}  // namespace
}  // namespace benchmarks::ablate
