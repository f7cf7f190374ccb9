#include "benchmarks/measure/metrics.h"

#include <fstream>
#include <iterator>
#include <numeric>
#include <regex>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "benchmarks/measure/case.h"
#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"

namespace benchmarks::measure {
namespace {

using engine::MemoryLedger;

double sumOf(const std::vector<report::Metric>& metrics, std::string_view beginning) {
    double sum = 0.0;
    for (const report::Metric& metric : metrics)
        if (metric.name().starts_with(beginning)) sum += metric.samples.at(0);
    return sum;
}

double valueOf(const std::vector<report::Metric>& metrics, std::string_view name) {
    for (const report::Metric& metric : metrics)
        if (metric.name() == name) return metric.samples.at(0);
    return 0.0;
}

double total(const engine::MemoryLedger& ledger) {
    return std::accumulate(ledger.begin(), ledger.end(), 0.0, [](double sum, const auto& line) {
        return sum + static_cast<double>(line.second);
    });
}

TEST(MemoryMetrics, AddUpByHeapAndByPurpose) {
    const MemoryLedger ledger{
        {{0, true, "guide positions", "simulation"}, 1000},
        {{1, false, "picture parameters", "shading"}, 30},
        {{0, true, "rod scratch", "simulation"}, 200},
        {{0, true, "rod scratch", "window"}, 4}};
    const std::vector<report::Metric> metrics = memoryMetrics(ledger);
    EXPECT_EQ(valueOf(metrics, "memory.heap.0"), 1204.0);
    EXPECT_EQ(valueOf(metrics, "memory.heap.1"), 30.0);
    EXPECT_EQ(valueOf(metrics, "memory.purpose.simulation"), 1200.0);
    EXPECT_EQ(valueOf(metrics, "memory.purpose.shading"), 30.0);
    EXPECT_EQ(valueOf(metrics, "memory.purpose.window"), 4.0);
    EXPECT_EQ(metrics.size(), 5u);
    for (const report::Metric& metric : metrics) EXPECT_EQ(metric.unit, "B") << metric.name();
}

TEST(MemoryMetrics, OfNothingAreNone) {
    EXPECT_TRUE(memoryMetrics(engine::MemoryLedger()).empty());
}

// The purposes that results/README.md names.
std::set<std::string> publishedPurposes() {
    std::ifstream file(HAIRBENCH_SCENES_DIR "/../results/README.md");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::size_t row = text.find("| `memory.purpose.<purpose>` |");
    const std::string line = text.substr(row, text.find('\n', row) - row);
    static const std::regex name("`([a-z]+)`");
    std::set<std::string> names;
    for (std::sregex_iterator i(line.begin(), line.end(), name), end; i != end; ++i)
        names.insert((*i)[1]);
    return names;
}

class MemoryOfCasesTest : public GpuTest {
protected:
    // Compares a case with the table and the allocator while it exists, drawn once.
    static void expectAccounted(const char* name, const hair::Settings& settings) {
        SCOPED_TRACE(name);
        const std::uint64_t before = device().allocatedBytes();
        {
            Case test_case(device(), settings, HAIRBENCH_SCENES_DIR);
            engine::FrameLoop loop(device(), engine::Timing::overlapped);
            loop.frame([&](engine::Passes& passes) { test_case.frame(passes); });
            loop.finish();
            const MemoryLedger ledger = device().memory();
            EXPECT_EQ(total(ledger), static_cast<double>(device().allocatedBytes()));
            const std::vector<report::Metric> metrics = memoryMetrics(ledger);
            EXPECT_EQ(sumOf(metrics, "memory.heap."), total(ledger));
            EXPECT_EQ(sumOf(metrics, "memory.purpose."), total(ledger));
            for (const auto& [entry, bytes] : ledger)
                EXPECT_TRUE(publishedPurposes().contains(std::string(entry.purpose.name())))
                    << entry.name;
            // At least a 32-bit colour and depth for every rendered pixel.
            const hair::RenderSettings& render = settings.render;
            EXPECT_GE(
                valueOf(metrics, "memory.purpose.targets"),
                8.0 * render.width * render.height * render.ssaa * render.ssaa * render.msaa);
        }
        EXPECT_EQ(device().allocatedBytes(), before);
    }
};

TEST_F(MemoryOfCasesTest, OfEveryPictureFeatureHasAPurpose) {
    for (const hair::Feature& feature : hair::features()) {
        hair::Settings settings = hair::plainSettings();
        feature.show(settings);
        expectAccounted(feature.name, settings);
    }
}

TEST_F(MemoryOfCasesTest, OfEverySolverHasAPurpose) {
    for (const hair::Solver solver :
         {hair::Solver::none, hair::Solver::shape, hair::Solver::ftl, hair::Solver::rod,
          hair::Solver::stable_cosserat, hair::Solver::position_based_rod,
          hair::Solver::augmented_mass_spring}) {
        hair::Settings settings = hair::plainSettings();
        settings.simulation.solver = solver;
        settings.simulation.settle_steps = 2;
        settings.simulation.colliders = {{.radius = 0.05f}};
        settings.simulation.distance_fields = {{.resolution = 8}};
        settings.simulation.pulls = {{.path = {{.time = 0.0f}, {.time = 1.0f}}}};
        if (solver == hair::Solver::shape) settings.simulation.hair_hair.friction = 0.1f;
        expectAccounted("solver", settings);
    }
}

TEST_F(MemoryOfCasesTest, OfStrandsOfTheirOwnHasAPurpose) {
    hair::Settings settings = hair::plainSettings();
    settings.strands.randomness = hair::Randomness::thesis;
    expectAccounted("thesis", settings);
    settings.strands.backend = hair::Backend::pulling_geometry;
    expectAccounted("pulling_geometry", settings);
}

}  // namespace
}  // namespace benchmarks::measure
