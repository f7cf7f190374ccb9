#include "benchmarks/measure/memory_need.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/run/record.h"
#include "benchmarks/run/run.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/sweep.h"
#include "engine/error.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/error_text.h"
#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::measure {
namespace {

namespace fs = std::filesystem;
using report::MemoryNeed;
using testing::HasSubstr;

const fs::path kSceneFolder = HAIRBENCH_SCENES_DIR;

// ---- Need and rows against what is allocated
// -----------------------------------------------------

// Allocations with sizes that depend on the contents of files other than the groom.
bool isOfFile(const std::string& name) {
    constexpr std::string_view kNames[] = {"body lines", "environment", "mesh ", "strand texture"};
    return std::ranges::any_of(kNames, [&](std::string_view each) {
        return each.ends_with(' ') ? name.starts_with(each) : name == each;
    });
}

class MemoryNeedTest : public GpuTest {
protected:
    // Compares a case's need and rows with its live allocations after it is made. `name` is the
    // case's.
    void check(const std::string& name, const hair::Settings& settings) {
        SCOPED_TRACE(name);
        HairCache cache;
        const std::uint64_t before = device().allocatedBytes();
        const auto bytes_before = device().resources().bytes();
        try {
            const MemoryNeed unread = caseMemory(device(), settings, kSceneFolder).need;
            cache.assets().groom(settings, kSceneFolder);
            const CaseMemory memory = caseMemory(device(), settings, kSceneFolder, &cache);
            const Case test_case(device(), settings, kSceneFolder, &cache);
            const std::uint64_t held = device().allocatedBytes() - before;
            EXPECT_GE(memory.need.device, held);
            EXPECT_GE(unread.device, held);
            // The assumed small buffers are at most half a MiB.
            EXPECT_LE(memory.need.device, 3 * held + (512u << 10));
            checkRows(memory.rows, bytes_before, settings);
            ++checked_;
        } catch (const engine::Unsupported&) {
            // There is no promise for a device that lacks a needed feature.
        }
    }

    // Every buffer and image of a case has a row of its name, of its size or, if its contents
    // decide, of at most that.
    void checkRows(
        const engine::MemoryRows& rows, const std::map<std::string, std::uint64_t>& before,
        const hair::Settings& settings) {
        std::map<std::string, std::uint64_t> expected;
        std::set<std::string> at_most;
        for (const auto& [row, purpose] : rows.all()) {
            expected[row.name] += std::uint64_t{row.copies} * row.size;
            if (row.at_most) at_most.insert(row.name);
        }
        // An environment may have fewer lights than the settings ask for.
        const bool has_fewer = settings.shading.environment_lights > 0;
        std::set<std::string> found;
        for (auto [name_of, bytes] : device().resources().bytes()) {
            if (const auto old = before.find(name_of); old != before.end()) bytes -= old->second;
            if (bytes == 0) continue;
            found.insert(name_of);
            if (isOfFile(name_of)) continue;
            if (has_fewer || at_most.contains(name_of))
                EXPECT_LE(bytes, expected[name_of]) << name_of;
            else
                EXPECT_EQ(bytes, expected[name_of]) << name_of;
        }
        for (const auto& [name_of, bytes] : expected)
            EXPECT_TRUE(found.contains(name_of) || isOfFile(name_of)) << name_of;
    }

    std::size_t checked_ = 0;
};

TEST_F(MemoryNeedTest, IsThatOfWhatFeaturesAllocateAndNotFarMore) {
    for (const hair::Feature& feature : hair::features()) {
        hair::Settings settings = hair::plainSettings();
        feature.show(settings);
        check(feature.name, settings);
    }
    EXPECT_GT(checked_, hair::features().size() / 2);
}

TEST_F(MemoryNeedTest, KnowsEveryBackEnd) {
    using hair::Backend;
    for (const Backend backend :
         {Backend::tessellation, Backend::pulling_geometry, Backend::lines, Backend::pulling,
          Backend::expanded, Backend::mesh, Backend::software, Backend::rays}) {
        for (const std::uint32_t msaa : {1u, 4u}) {
            hair::Settings settings = hair::plainSettings();
            settings.strands.backend = backend;
            settings.strands.density = 200;
            settings.render.msaa = msaa;
            check(std::to_string(int(backend)), settings);
            hair::lit(settings);
            check(std::to_string(int(backend)) + " lit", settings);
            settings.strands.rays.geometry = hair::RaysGeometry::boxes;
            if (backend == Backend::rays) check("rays in boxes", settings);
            settings.shading.shadows.hair = hair::HairShadows::rays;
            if (backend >= Backend::software) check("rays of light", settings);
        }
    }
    EXPECT_GT(checked_, 8u);
}

TEST_F(MemoryNeedTest, KnowsEverySolver) {
    using hair::Solver;
    for (const Solver solver :
         {Solver::none, Solver::shape, Solver::ftl, Solver::rod, Solver::stable_cosserat,
          Solver::position_based_rod, Solver::augmented_mass_spring}) {
        hair::Settings settings = hair::plainSettings();
        settings.simulation.solver = solver;
        settings.groom.guides = 3000;
        settings.groom.grow.vertices = 24;
        check(std::to_string(int(solver)), settings);
        settings.simulation.hair_hair.friction = 0.5f;
        settings.simulation.wind.mode = hair::WindMode::drag;
        check(std::to_string(int(solver)) + " with hair and air", settings);
        settings.simulation.rod.integrator = hair::RodIntegrator::generalized_alpha;
        settings.simulation.colliders = {{.radius = 0.05f}};
        settings.simulation.pulls = {{.path = {{.time = 0.0f}, {.time = 1.0f}}}};
        check(std::to_string(int(solver)) + " with bodies and hands", settings);
    }
    EXPECT_GT(checked_, 12u);
}

// The first case of each shipped scene, made small.
TEST_F(MemoryNeedTest, IsThatOfWhatShippedScenesAllocate) {
    for (const auto& entry : fs::directory_iterator(kSceneFolder)) {
        const fs::path path = entry.path();
        if (path.extension() != ".json" || path.stem().extension() == ".schema" ||
            scene::isSuite(path))
            continue;
        const scene::Scene loaded = scene::loadScene(path);
        hair::Settings settings = scene::expand(loaded).front().settings;
        settings.run.compare_backends = false;  // its pictures are drawn after the case's
        check(path.filename().string(), run::smaller(settings));
    }
    EXPECT_GT(checked_, 10u);
}

// A picture's own images, computed by hand: 8-bit colour and 32-bit depth of each sample, and the
// output.
TEST_F(MemoryNeedTest, GrowsWithThePictureAsItsImagesDo) {
    hair::Settings settings = hair::plainSettings();
    settings.render.msaa = 4;
    settings.render.width = settings.render.height = 1000;
    const std::uint64_t small = caseMemory(device(), settings, kSceneFolder).need.device;
    settings.render.width = settings.render.height = 2000;
    const std::uint64_t large = caseMemory(device(), settings, kSceneFolder).need.device;
    const double images = 3e6 * (4 * (4 + 4) + 4);  // of three million additional pixels
    EXPECT_GE(static_cast<double>(large - small), images);
    EXPECT_LE(static_cast<double>(large - small), 1.5 * images);
}

// ---- What there is ------------------------------------------------------------------------------

TEST(MemoryRoom, IsWhatTheControlGroupLeaves) {
    const TemporaryFolder root;
    EXPECT_EQ(freeInControlGroup(root.path()), std::nullopt);
    root.write("proc/self/cgroup", "0::/user/run\n");
    root.write("sys/fs/cgroup/user/run/memory.max", "max\n");
    EXPECT_EQ(freeInControlGroup(root.path()), std::nullopt);
    root.write("sys/fs/cgroup/user/run/memory.max", "1000000\n");
    root.write("sys/fs/cgroup/user/run/memory.current", "700000\n");
    EXPECT_EQ(freeInControlGroup(root.path()), 300000u);
    // Pages that can be read again count as free.
    root.write("sys/fs/cgroup/user/run/memory.stat", "anon 600000\ninactive_file 100000\n");
    EXPECT_EQ(freeInControlGroup(root.path()), 400000u);
    // A group's ancestors limit it too.
    root.write("sys/fs/cgroup/user/memory.max", "900000\n");
    root.write("sys/fs/cgroup/user/memory.current", "880000\n");
    EXPECT_EQ(freeInControlGroup(root.path()), 20000u);
    root.write("sys/fs/cgroup/user/memory.current", "980000\n");
    EXPECT_EQ(freeInControlGroup(root.path()), 0u);
}

TEST(MemoryRoom, IsWhatAnOlderControlGroupLeaves) {
    const TemporaryFolder root;
    root.write("proc/self/cgroup", "9:name=systemd:/\n4:cpu,memory:/job/7\n0::/\n");
    root.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    root.write("sys/fs/cgroup/memory/memory.usage_in_bytes", "123456789\n");
    EXPECT_EQ(freeInControlGroup(root.path()), std::nullopt);  // means no limit
    // Inside a container, the group's folder is the root of the mount.
    root.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "200000000\n");
    root.write("sys/fs/cgroup/memory/memory.stat", "cache 1\ntotal_inactive_file 23456789\n");
    EXPECT_EQ(freeInControlGroup(root.path()), 100000000u);
}

TEST(MemoryRoom, IsWhatTheHostHasAvailable) {
    const TemporaryFolder root;
    EXPECT_EQ(availableMemory(root.path()), std::nullopt);
    root.write("proc/meminfo", "MemTotal: 8000 kB\nMemFree: 100 kB\nMemAvailable: 3000 kB\n");
    EXPECT_EQ(availableMemory(root.path()), 3000u * 1024);
}

TEST(MemoryRoom, SaysWhatDoesNotFit) {
    using Of = MemoryRoom::Of;
    const MemoryNeed need{.device = 3'000'000'000, .host = 100'000'000};
    EXPECT_EQ(
        whyItDoesNotFit(
            need,
            {{Of::device, 4'000'000'000, "budget"}, {Of::device, 2'000'000'000, "--max-memory"}}),
        "needs about 3.00 GB of device memory; 2.00 GB are free (--max-memory)");
    EXPECT_EQ(
        whyItDoesNotFit(need, {{Of::host, 50'000'000, "limit"}}),
        "needs about 100 MB of the host's memory; 50.0 MB are free (limit)");
    EXPECT_EQ(
        whyItDoesNotFit(need, {{Of::both, 3'000'000'000, "limit"}}),
        "needs about 3.10 GB of memory; 3.00 GB are free (limit)");
    EXPECT_EQ(whyItDoesNotFit(need, {{Of::both, 4'000'000'000, "limit"}}), "");
    EXPECT_EQ(whyItDoesNotFit(need, {}), "");
}

TEST(MemorySize, IsReadInEitherPowers) {
    EXPECT_EQ(parseMemorySize("123456"), 123456u);
    EXPECT_EQ(parseMemorySize("500M"), 500u << 20);
    EXPECT_EQ(parseMemorySize("2g"), std::uint64_t{2} << 30);
    EXPECT_EQ(parseMemorySize("1.5GiB"), std::uint64_t{3} << 29);
    EXPECT_EQ(parseMemorySize("2GB"), 2'000'000'000u);
    EXPECT_EQ(parseMemorySize("64KiB"), 65536u);
    for (const char* wrong : {"", "G", "-1G", "0", "nan", "inf", "2X", "2GX", "1e99", "9999999T"})
        EXPECT_THAT(
            errorText([&] { parseMemorySize(wrong); }),
            HasSubstr("is not a size, as in 500M or 2G"))
            << wrong;
}

// ---- Cases that there is no room for ------------------------------------------------------------

class NoRoom : public GpuTest {
protected:
    static run::PlannedCase planned(std::size_t index, const hair::Settings& settings) {
        return {
            .spec = {.name = "case " + std::to_string(index), .axes = {}, .settings = settings},
            .directory = kSceneFolder,
            .index = index};
    }
    static hair::Settings smallCase(std::uint32_t side) {
        hair::Settings settings;
        settings.strands.backend = hair::Backend::tessellation;
        settings.strands.density = 2;
        settings.strands.tessellation = 1;
        settings.render.head = false;
        settings.render.width = settings.render.height = side;
        settings.run = {.warmup = 1, .frames = 1, .max_time = 0.0f};
        return settings;
    }
    report::CaseResult run(const run::PlannedCase& each, std::optional<std::uint64_t> most = {}) {
        return run::runCase(
                   device(), each, {.stop = [] { return false; }}, {}, comparisons_, cache_, most)
            .result;
    }

    run::CaseComparisons comparisons_;
    HairCache cache_;
};

TEST_F(NoRoom, IsSkippedWithTheFigure) {
    const run::PlannedCase each = planned(3, smallCase(512));
    const report::CaseResult skipped = run(each, 1u << 20);
    EXPECT_EQ(skipped.status, report::Status::skipped);
    EXPECT_THAT(
        skipped.reason,
        testing::MatchesRegex("needs about [0-9.]+ [MG]B of (device )?memory; 1.05 MB are free "
                              "\\(--max-memory\\)"));
    ASSERT_TRUE(skipped.memory_need);
    EXPECT_GT(skipped.memory_need->device, 512u * 512 * 8);  // both mean that there is no limit
    const report::CaseResult ran = run(each, std::uint64_t{8} << 30);
    EXPECT_EQ(ran.status, report::Status::ok) << ran.reason;
    ASSERT_TRUE(ran.memory_need);
    EXPECT_EQ(ran.memory_need->device, skipped.memory_need->device);
}

// A case with a failed allocation is in the journal, and so are the cases around it.
TEST_F(NoRoom, FailsOneCaseAndTheRunGoesOn) {
    const TemporaryFolder folder;
    run::RunPlan plan;
    plan.case_count = 3;
    for (std::size_t i = 0; i < 3; ++i) plan.cases.push_back(planned(i, smallCase(32)));
    report::ReportHeader header = sampleReport();
    header.case_count = 3;
    header.shard.reset();
    const fs::path out = folder.file("r.json");
    {
        run::RunRecord record(plan, header, {.out = out, .filter = {}});
        for (const run::PlannedCase& each : plan.cases) {
            const MeasureHooks hooks{
                .stop = [] { return false; },
                .progress =
                    [&](const SamplingState&) {
                        if (each.index == 1) throw std::bad_alloc();
                    }};
            report::CaseResult result =
                run::runCase(device(), each, hooks, {}, comparisons_, cache_).result;
            result.order = each.index;
            record.add(result);
        }
        EXPECT_EQ(record.measured(), 2u);
        record.write(run::RunEnd::interrupted);
    }
    const scene::Json report = report::readReport(out);
    ASSERT_EQ(report["cases"].size(), 3u);
    EXPECT_EQ(report["cases"][0]["status"], "ok");
    EXPECT_EQ(report["cases"][1]["status"], "failed");
    EXPECT_EQ(report["cases"][1]["reason"], "the host has not enough memory");
    EXPECT_TRUE(report["cases"][1].contains("memory_need"));
    EXPECT_EQ(report["cases"][2]["status"], "ok") << report["cases"][2];
    EXPECT_EQ(run::RunRecord(plan, header, {.out = out, .filter = {}, .resume = true}).done(), 3u);
}

}  // namespace
}  // namespace benchmarks::measure
