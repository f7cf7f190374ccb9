#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "benchmarks/scene/sweep.h"
#include "engine/frame_loop.h"
#include "engine/hazards.h"
#include "hair/groom/files.h"
#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

// Tests the barriers of the passes: none is missing, removing any needed one is a hazard, and none
// is redundant.
namespace benchmarks::measure {
namespace {

namespace fs = std::filesystem;

// As many frames in flight as possible: after the host has waited for a frame, it causes no hazard.
constexpr engine::Overlap kOverlap{.frames = engine::FrameLoop::kMaxSlots};
constexpr std::uint32_t kFrames = kOverlap.frames;

// Makes settings small and quick to play. Recorded commands do not depend on sizes.
hair::Settings made(hair::Settings settings) {
    settings.render.width = 32;
    settings.render.height = 24;
    settings.strands.density = 1;
    settings.strands.tessellation = 1;
    settings.shading.shadows.resolution = std::min(settings.shading.shadows.resolution, 64u);
    settings.simulation.settle_steps = 0;
    settings.groom.grow.strands = std::min(settings.groom.grow.strands, 1000u);
    for (hair::DistanceFieldSettings& field : settings.simulation.distance_fields)
        field.resolution = std::min(field.resolution, 8u);
    return settings;
}

// Returns settings with everything that moves hair and most passes that draw it. Indirect light is
// not there, because it lights each vertex of the head by thousands of sources.
hair::Settings everything() {
    hair::Settings settings = made(hair::plainSettings());
    hair::lit(settings);
    settings.shading.shadows.resolution = 64;
    settings.simulation.solver = hair::Solver::shape;
    settings.simulation.substeps = 2;
    settings.simulation.hair_hair.friction = 0.2f;
    settings.simulation.pulls = {
        {.guide = 3, .vertex = 2, .path = {{.time = 0.0f}, {.time = 100.0f}}}};
    settings.strands.curl.radius = 0.004f;
    settings.render.transparency = hair::Transparency::fragment_list;
    settings.render.overlays.guides = true;
    return settings;
}

// Writes 16 curls side by side.
fs::path writeCurls(const TemporaryFolder& folder) {
    hair::groom::StrandSet set{.metres_per_unit = 1.0};
    for (int strand = 0; strand < 16; ++strand) {
        for (int k = 0; k < 24; ++k) {
            const float turn = 0.8f * static_cast<float>(k) + static_cast<float>(strand);
            set.points.emplace_back(
                0.01f * static_cast<float>(strand) + 0.005f * std::cos(turn),
                0.1f - 0.004f * static_cast<float>(k), 0.005f * std::sin(turn));
        }
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    const fs::path file = folder.file("curls.ply");
    hair::groom::exportStrands(set, file);
    return file;
}

// Returns settings with indirect light on a mesh of four vertices below strands from a file.
hair::Settings indirectlyLit(const TemporaryFolder& folder) {
    hair::Settings settings = made(hair::plainSettings());
    hair::lit(settings);
    settings.shading.shadows.resolution = 64;
    settings.shading.indirect = true;
    settings.strands.source = hair::StrandSource::groom;
    settings.groom.file = writeCurls(folder).string();
    settings.groom.guides = 4;
    const fs::path floor = folder.file("floor.obj");
    std::ofstream(floor) << "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 4 3 2 1\n";
    settings.render.meshes = {{.file = floor.string()}};
    return settings;
}

// The resources that passes touch, by the names of the passes.
using Touched = std::map<std::string, engine::PassUses>;

std::string joined(const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "`" : ", `") + name + '`';
    return text;
}

std::vector<std::string> rowsOf(const Touched& touched) {
    std::vector<std::string> rows;
    for (const auto& [pass, uses] : touched)
        rows.push_back(
            "| `" + pass + "` | " + joined(uses.reads) + " | " + joined(uses.writes) + " |");
    return rows;
}

// The rows of the table of passes, or of the one for the back end `rays`, which needs a device of
// its own.
enum class PublishedTable { all, of_rays };

std::vector<std::string> publishedRows(PublishedTable table) {
    const std::string head = table == PublishedTable::all ? "| pass | reads | writes |"
                                                          : "| pass of `rays` | reads | writes |";
    std::ifstream page(HAIRBENCH_SCENES_DIR "/../docs/design.md");
    std::vector<std::string> rows;
    bool is_table = false;
    for (std::string line; std::getline(page, line);) {
        if (is_table && line.empty()) break;
        if (is_table && line.starts_with("| `")) rows.push_back(line);
        is_table = is_table || line == head;
    }
    return rows;
}

class FramesHazards : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (!isOver()) log().drop(std::nullopt);
    }
    void TearDown() override {
        if (GpuEnvironment::device()) log().drop(std::nullopt);
        GpuTest::TearDown();
    }

    static engine::HazardLog& log() { return *device().hazards(); }

    // Returns the messages on hazards, without other messages of the layer.
    static std::string hazards() {
        std::string text;
        for (const std::string& message : device().messages().take())
            if (message.starts_with("hazard: ")) text += message + '\n';
        return text;
    }

    // Plays frames and adds the places of their barriers to `places`, and of the needed barriers to
    // `needed`.
    static void play(
        const hair::Settings& settings, std::set<std::string>& places,
        std::set<std::string>& needed, Touched& touched) {
        Case played(device(), settings, HAIRBENCH_SCENES_DIR);
        engine::FrameLoop loop(device(), engine::Timing::overlapped, kOverlap);
        log().keepRecordings();
        log().takeRecordings();
        for (std::uint32_t i = 0; i < kFrames; ++i)
            loop.frame([&](engine::Passes& passes) { played.frame(passes); });
        loop.finish();
        const std::vector<engine::Recording> recordings = log().takeRecordings();
        ASSERT_EQ(recordings.size(), kFrames);
        for (const engine::Recording& recording : recordings)
            for (engine::PassUses& uses : log().passesOf(recording)) {
                touched[uses.pass].reads.merge(uses.reads);
                touched[uses.pass].writes.merge(uses.writes);
            }
        const std::set<std::string> all = engine::barrierPlaces(recordings);
        places.insert(all.begin(), all.end());
        const std::vector<std::string> redundant = engine::redundantBarriers(recordings);
        std::ranges::set_difference(all, redundant, std::inserter(needed, needed.end()));
    }
};

// Any message fails the test. Guides move, so that frames depend on each other.
TEST_F(FramesHazards, AreNoneInAnySceneOrFeatureAndNoBarrierIsSuperfluous) {
    std::set<std::string> places;
    std::set<std::string> needed;
    Touched touched;
    const auto silent = [&](const std::string& name, const hair::Settings& settings) {
        SCOPED_TRACE(name);
        play(settings, places, needed, touched);
        for (const std::string& message : device().messages().take())
            ADD_FAILURE() << name << ": " << message;
    };
    for (const hair::Feature& feature : hair::features()) {
        hair::Settings settings = hair::plainSettings();
        feature.show(settings);
        settings.simulation.solver = hair::Solver::ftl;
        silent(feature.name, made(settings));
    }
    hair::Settings at_rest = hair::plainSettings();
    at_rest.strands.curl.radius = 0.004f;
    silent("at rest", made(at_rest));
    silent("everything", everything());
    // Frames last half a step, so every other frame draws but moves nothing.
    for (const float curl : {0.0f, 0.004f}) {
        hair::Settings skinned = hair::plainSettings();
        skinned.groom.grow.mesh = "assets/head_talk.glb";
        skinned.simulation.animation.clip = "talk";
        hair::lit(skinned);
        skinned.shading.indirect = curl > 0.0f;
        skinned.strands.curl.radius = curl;
        skinned.run.frame_time = 0.5f * skinned.simulation.time_step;
        silent("skinned, curl " + std::to_string(curl), made(skinned));
    }
    // Frames of no step, one, two and three steps, drawn between steps.
    for (const float steps : {0.4f, 1.5f, 2.5f}) {
        hair::Settings between = everything();
        between.run.interpolate = true;
        between.run.frame_time = steps * between.simulation.time_step;
        silent("interpolated, steps " + std::to_string(steps), made(between));
    }
    for (const hair::Solver solver :
         {hair::Solver::rod, hair::Solver::stable_cosserat, hair::Solver::position_based_rod,
          hair::Solver::augmented_mass_spring}) {
        hair::Settings rods = everything();
        rods.simulation.solver = solver;
        if (solver == hair::Solver::rod) rods.simulation.material.set_share = 0.5f;
        silent("rods, solver " + std::to_string(static_cast<int>(solver)), rods);
    }
    hair::Settings segments = everything();
    segments.simulation.collision.parts = hair::CollisionParts::segments;
    segments.simulation.colliders = {{.radius = 0.05f}};
    segments.simulation.substeps = 3;
    silent("segments", segments);
    // For extensions of scenes see docs/extending.md.
    hair::Settings extended = everything();
    extended.simulation.force = "extended/vortex.glsl";
    extended.strands.offset_function = "extended/crimped.glsl";
    extended.shading.model = hair::ShadingModel::extension;
    extended.shading.model_file = "extended/toon.glsl";
    extended.strands.curve = hair::Curve::extension;
    extended.strands.curve_file = "extended/helix.glsl";
    silent("a scene's own functions", extended);
    extended.simulation.solver = hair::Solver::extension;
    extended.simulation.solver_file = "extended/mass_spring.glsl";
    extended.simulation.substeps = 2;
    extended.simulation.collision.parts = hair::CollisionParts::segments;
    silent("a scene's own functions and solver", extended);
    const TemporaryFolder folder;
    silent("indirect light", indirectlyLit(folder));
    // Strands of a groom file that keep their residuals to the mean of their guides.
    for (const hair::Backend backend : {hair::Backend::tessellation, hair::Backend::expanded}) {
        hair::Settings residuals = everything();
        residuals.strands.backend = backend;
        residuals.strands.source = hair::StrandSource::groom;
        residuals.groom.file = writeCurls(folder).string();
        residuals.groom.guides = 4;
        silent("residuals, back end " + std::to_string(static_cast<int>(backend)), residuals);
    }
    for (const hair::Backend backend : {hair::Backend::expanded, hair::Backend::software}) {
        for (const std::uint32_t samples : {1u, 4u}) {
            for (const bool has_maps : {false, true}) {
                hair::Settings settings = hair::plainSettings();
                if (has_maps) hair::lit(settings);
                settings.render.msaa = samples;
                settings.simulation.solver = hair::Solver::ftl;
                settings.strands.backend = backend;
                silent(
                    "back end " + std::to_string(static_cast<int>(backend)) + ", " +
                        std::to_string(samples) + " samples, maps " + std::to_string(has_maps),
                    made(settings));
            }
        }
    }
    for (const auto& entry : fs::directory_iterator(HAIRBENCH_SCENES_DIR)) {
        if (entry.path().extension() != ".json" || entry.path().stem() == "scene.schema" ||
            scene::isSuite(entry.path()))
            continue;
        for (const scene::Scene& each : scene::loadScenes(entry.path()))
            silent(entry.path().filename().string() + " " + each.name, made(each.settings));
    }
    std::set<std::string> redundant;
    std::ranges::set_difference(places, needed, std::inserter(redundant, redundant.end()));
    EXPECT_THAT(redundant, testing::IsEmpty());
    for (auto& [pass, uses] : touched)
        std::erase_if(uses.reads, [&](const auto& name) { return uses.writes.contains(name); });
    EXPECT_THAT(
        publishedRows(PublishedTable::all), testing::UnorderedElementsAreArray(rowsOf(touched)))
        << "docs/design.md";
}

// Returns the resources that messages on hazards name: "... of 'depth': pass ...".
std::set<std::string> resourcesIn(const std::string& hazards) {
    std::set<std::string> names;
    const std::string before = " of '";
    for (std::size_t at = hazards.find(before); at != std::string::npos;
         at = hazards.find(before, at)) {
        at += before.size();
        names.insert(hazards.substr(at, hazards.find('\'', at) - at));
    }
    return names;
}

// Plays frames without one of a frame's barriers, for each of them. Each must be missed, and those
// resources must be accessed out of order without one barrier or another.
void missEach(
    engine::Device& device, const hair::Settings& settings,
    const std::set<std::string>& resources) {
    engine::HazardLog& log = *device.hazards();
    Case played(device, settings, HAIRBENCH_SCENES_DIR);
    engine::FrameLoop loop(device, engine::Timing::overlapped, kOverlap);
    const auto play = [&](std::uint32_t frames) {
        for (std::uint32_t i = 0; i < frames; ++i)
            loop.frame([&](engine::Passes& passes) { played.frame(passes); });
    };
    play(kFrames);
    log.drop(std::nullopt);
    play(1);
    const std::uint32_t barriers = log.barriers();
    ASSERT_GT(barriers, 0u);
    std::set<std::string> missed;
    for (std::uint32_t i = 0; i < barriers; ++i) {
        device.messages().take();
        log.drop(i);
        play(kFrames);
        std::string hazards;
        for (const std::string& message : device.messages().take())
            if (message.starts_with("hazard: ")) hazards += message + '\n';
        EXPECT_NE(hazards, "") << log.dropped().value_or("");
        missed.merge(resourcesIn(hazards));
    }
    EXPECT_THAT(missed, testing::IsSupersetOf(resources));
    log.drop(std::nullopt);
    loop.finish();
    device.messages().take();
}

// For everything().
const std::set<std::string> kMissed{
    "volume blocks",  // cleared
    "volume samples",
    "volume sums",
    "guide accelerations",  // written by wind, hair-hair contact and the hand
    "guide pull",
    "guide positions",  // written by the substep before
    "guide normals",
    "depth of meshes",
    "depth of hair",
    "opacity of hair",
    "color",  // the frame before still resolves it
    "depth",
    "fragment heads",
    "output",
    "radiance"};

TEST_F(FramesHazards, EachBarrierThatIsTakenOutIsMissed) {
    missEach(device(), everything(), kMissed);
}

TEST_F(FramesHazards, EachBarrierOfIndirectLightIsMissed) {
    const TemporaryFolder folder;
    missEach(
        device(), indirectlyLit(folder),
        {"sources of indirect light", "indirect light on meshes", "depth of meshes",
         "depth of hair", "opacity of hair"});
}

// Task and mesh stages read the same resources as vertex stages, after the same barriers.
TEST_F(FramesHazards, EachBarrierIsMissedByMeshStages) {
    if (!device().has(engine::Feature::mesh_shader))
        return skipWithout(Need::mesh, "the device has no task and mesh stages");
    hair::Settings settings = everything();
    settings.strands.backend = hair::Backend::mesh;
    missEach(device(), settings, kMissed);
}

// The structure is built and traced in each frame, from quads that the frame before still traces.
TEST_F(FramesHazards, EachBarrierOfRaysIsMissedAndNoneIsSuperfluous) {
    if (!device().has(engine::Feature::ray_queries))
        return skipWithout(Need::rays, "the device has no ray queries");
    std::set<std::string> places;
    std::set<std::string> needed;
    Touched touched;
    for (const hair::RaysUpdate update : {hair::RaysUpdate::build, hair::RaysUpdate::refit})
        for (const std::uint32_t samples : {1u, 4u})
            for (const bool has_maps : {false, true}) {
                // Maps and samples have nothing to do with what rays meet.
                const bool has_boxes = has_maps == (samples == 4);
                hair::Settings settings = hair::plainSettings();
                if (has_maps) hair::lit(settings);
                settings.render.msaa = samples;
                settings.simulation.solver = hair::Solver::ftl;
                settings.strands.backend = hair::Backend::rays;
                settings.strands.rays.update = update;
                if (has_boxes) settings.strands.rays.geometry = hair::RaysGeometry::boxes;
                play(made(settings), places, needed, touched);
                EXPECT_THAT(device().messages().take(), testing::IsEmpty());
            }
    // Rays of light, of the strands' samples and of the scene's fragments.
    hair::Settings traced = hair::plainSettings();
    hair::lit(traced);
    traced.simulation.solver = hair::Solver::ftl;
    traced.shading.shadows.hair = hair::HairShadows::rays;
    traced.strands.rays.geometry = hair::RaysGeometry::boxes;
    Touched of_light;
    for (const hair::Backend backend : {hair::Backend::software, hair::Backend::rays}) {
        traced.strands.backend = backend;
        play(made(traced), places, needed, of_light);
        EXPECT_THAT(device().messages().take(), testing::IsEmpty());
    }
    std::set<std::string> redundant;
    std::ranges::set_difference(places, needed, std::inserter(redundant, redundant.end()));
    EXPECT_THAT(redundant, testing::IsEmpty());
    std::erase_if(touched, [](const auto& each) {
        return each.first != "acceleration" && each.first != "strands";
    });
    touched["scene"] = of_light.at("scene");
    for (auto& [pass, uses] : touched)
        std::erase_if(uses.reads, [&](const auto& name) { return uses.writes.contains(name); });
    EXPECT_THAT(
        publishedRows(PublishedTable::of_rays), testing::UnorderedElementsAreArray(rowsOf(touched)))
        << "docs/design.md";

    hair::Settings settings = made(hair::plainSettings());
    settings.simulation.solver = hair::Solver::ftl;
    settings.strands.backend = hair::Backend::rays;
    for (const auto& [geometry, primitives] :
         {std::pair{hair::RaysGeometry::triangles, "quad corners"},
          std::pair{hair::RaysGeometry::boxes, "strand boxes"}}) {
        settings.strands.rays.geometry = geometry;
        missEach(
            device(), settings,
            {primitives, "acceleration structure", "acceleration top level", "acceleration scratch",
             "strands",  // their points: names end at an apostrophe
             "software visibility buffer", "depth"});
    }
    missEach(
        device(), made(traced),
        {"strand boxes", "acceleration structure", "acceleration top level", "depth of meshes"});
}

// Guides are drawn without offsets, and weighted blending writes to the output.
TEST_F(FramesHazards, EachBarrierOfWeightedBlendingIsMissed) {
    hair::Settings settings = made(hair::plainSettings());
    settings.simulation.solver = hair::Solver::ftl;
    settings.render.transparency = hair::Transparency::weighted_blended;
    missEach(
        device(), settings,
        {"guide accelerations", "guide positions", "weighted sum", "revealed part", "depth",
         "output"});
}

// Guides are at rest; only their frames (normals) are computed.
TEST_F(FramesHazards, FramesOfGuidesWaitForThoseWhoDraw) {
    hair::Settings settings = made(hair::plainSettings());
    settings.strands.curl.radius = 0.004f;
    missEach(device(), settings, {"guide normals", "output", "depth"});
}

// A frame's second step works in place, on the copy of the guides that the first step wrote.
TEST_F(FramesHazards, EachBarrierOfSeveralStepsIsMissed) {
    hair::Settings settings = made(hair::plainSettings());
    settings.simulation.solver = hair::Solver::ftl;
    settings.simulation.hair_hair.friction = 0.2f;
    settings.run.frame_time = 2.0f * settings.simulation.time_step;
    missEach(
        device(), settings,
        {"volume blocks", "volume samples", "volume sums", "guide accelerations", "guide positions",
         "output", "depth"});
}

// Vertices are spread over the grids twice, the second time by what the first one summed.
TEST_F(FramesHazards, EachBarrierOfHairThatSticksToHairIsMissed) {
    hair::Settings settings = made(hair::plainSettings());
    settings.simulation.solver = hair::Solver::ftl;
    settings.simulation.hair_hair.cohesion = 0.1f;
    settings.run.frame_time = 2.0f * settings.simulation.time_step;
    missEach(
        device(), settings,
        {"volume blocks", "volume samples", "volume sums", "volume spreads", "guide accelerations",
         "guide positions"});
}

TEST_F(FramesHazards, EachBarrierOfListsOfFragmentsIsMissed) {
    hair::Settings settings = made(hair::plainSettings());
    settings.render.transparency = hair::Transparency::fragment_list;
    missEach(device(), settings, {"fragment heads", "output", "depth"});
}

// A command that reads needs a barrier behind the command that wrote. The frame of the thesis's
// case by `software` is a chain with one behind each of wind, simulation and earlier drawing, scene
// and evaluation of points, clearing and first cull, its raster, reduction, pyramid, second cull,
// its raster, large pieces, shading, and drawing of the samples: 12. Everything else shares these.
TEST_F(FramesHazards, AFrameHasNoMoreBarriersThanItsChainOfDependenciesNeeds) {
    hair::Settings settings = made(hair::plainSettings());
    settings.simulation.solver = hair::Solver::shape;
    settings.strands.backend = hair::Backend::software;
    Case played(device(), settings, HAIRBENCH_SCENES_DIR);
    engine::FrameLoop loop(device(), engine::Timing::overlapped, kOverlap);
    const auto play = [&] { loop.frame([&](engine::Passes& passes) { played.frame(passes); }); };
    for (std::uint32_t i = 0; i < kFrames; ++i) play();
    log().drop(std::nullopt);
    play();
    EXPECT_LE(log().barriers(), 12u);
    loop.finish();
}

}  // namespace
}  // namespace benchmarks::measure
