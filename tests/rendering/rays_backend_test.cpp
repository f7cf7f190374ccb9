#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/acceleration.h"
#include "hair/rendering/rays_backend.h"
#include "tests/flip_errors.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"
#include "tests/required.h"

// The back end `rays`: its pictures against those of `tessellation`, which draws the same quads
// with the rasteriser, and of `software`, which has the same shading.
namespace hair::rendering {
namespace {

namespace fs = std::filesystem;

class RaysBackendPicture : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (isOver()) return;
        if (!device().has(engine::Feature::ray_queries))
            return skipWithout(Need::rays, "the device has no ray queries");
    }

    static Settings small() {
        Settings settings = thesisAtRest();
        settings.render.width = 320;
        settings.render.height = 180;
        return settings;
    }

    // `software` covers and shades samples of the same quads, made from the same points. A sample
    // on a quad's edge, or on the edge of a hidden quad, may be on another side of it: both compute
    // in single precision, which keeps a place to 1e-4 px here, and a pixel of hair has some ten
    // edges. So one in a hundred pixels of hair would be many.
    static void expectThatOfSoftware(const Settings& settings, double most_different) {
        const Pixels expected = drawCase(device(), with(settings, Backend::software));
        const std::size_t hair = differingPixels(expected, drawBald(device(), settings));
        EXPECT_GT(hair, 600u);
        EXPECT_LE(
            static_cast<double>(
                differingPixels(expected, drawCase(device(), with(settings, Backend::rays)), 2)),
            most_different * static_cast<double>(hair));
    }

    fs::path write(const std::string& name, const Settings& settings, const Pixels& pixels) {
        return writePicture(folder_.path() / (name + ".png"), settings, pixels);
    }

    TemporaryFolder folder_;
};

struct Kind {
    const char* name;
    void (*change)(Settings&);
    // Most pixels that differ from those of `software`, over the hair's.
    double most_different = 0.01;
    // Whether the others widen strands, which `software` and `rays` don't.
    bool is_widened = false;
};

// Everything that decides which quads there are, and how a sample is shaded.
constexpr std::array kKinds{
    Kind{"plain", [](Settings&) {}},
    Kind{"four samples", [](Settings& s) { s.render.msaa = 4; }},
    Kind{"linear light", [](Settings& s) { s.render.tone_map = ToneMap::aces; }},
    Kind{"supersampled", [](Settings& s) { s.render.ssaa = 2; }},
    Kind{"covered", [](Settings& s) { s.render.coverage = Coverage::analytic; }, 0.01, true},
    Kind{"segments", [](Settings& s) { s.strands.taper = Taper::segment; }},
    Kind{
        "levels by distance",
        [](Settings& s) {
            s.lod = {.mode = LodMode::distance, .near_distance = 0.4f, .far_distance = 0.8f};
        }},
    Kind{
        "segments' levels by distance",
        [](Settings& s) {
            s.strands.taper = Taper::segment;
            s.lod = {.mode = LodMode::distance, .near_distance = 0.4f, .far_distance = 0.8f};
        }},
    Kind{"merged hairs", [](Settings& s) { s.lod = {.mode = LodMode::forced, .level = 1.3f}; }},
    Kind{
        "merged strips",
        [](Settings& s) {
            s.lod = {.mode = LodMode::forced, .level = 2.0f, .merged = MergedStrands::strip};
        }},
    // The sides of a quad cross on the screen if a curl points at the eye. `software` uncrosses
    // them, and triangles don't.
    Kind{"curls", [](Settings& s) { s.strands.curl.radius = 0.01f; }, 0.1},
    Kind{"Catmull-Rom", [](Settings& s) { s.strands.curve = Curve::catmull_rom; }},
    Kind{
        "shadows",
        [](Settings& s) {
            s.shading.model = ShadingModel::dual_scattering;
            s.shading.shadows.hair = HairShadows::deep_opacity;
            s.shading.shadows.meshes = true;
        }},
    Kind{
        "within the hair",
        [](Settings& s) {
            s.camera.position = {0.0f, 0.02f, 0.11f};
            s.camera.target = {0.08f, 0.0f, 0.02f};
            s.camera.near_plane = 0.02f;
        }},
};

TEST_F(RaysBackendPicture, IsThatOfSoftware) {
    for (const Kind& kind : kKinds) {
        SCOPED_TRACE(kind.name);
        Settings settings = small();
        kind.change(settings);
        expectThatOfSoftware(settings, kind.most_different);
    }
}

// `tessellation` shades a strand once per pixel, and this back end each sample at its own place:
// the same bound as for `software` (docs/rendering.md).
TEST_F(RaysBackendPicture, IsNearThatOfTessellation) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    std::vector<std::pair<fs::path, fs::path>> pairs;
    std::vector<std::string> names;
    for (const Kind& kind : kKinds) {
        if (kind.is_widened) continue;
        Settings settings = small();
        kind.change(settings);
        const auto draw = [&](Backend backend, const char* suffix) {
            return write(
                kind.name + std::string(suffix), settings,
                drawCase(device(), with(settings, backend)));
        };
        pairs.emplace_back(draw(Backend::tessellation, " t"), draw(Backend::rays, " r"));
        names.emplace_back(kind.name);
    }
    const std::vector<double> errors = flipErrors(pairs);
    ASSERT_EQ(errors.size(), names.size());
    for (std::size_t i = 0; i < errors.size(); ++i) EXPECT_LE(errors[i], 0.02) << names[i];
}

// The hair moves in the wind. Its structure is built in the first frame and only fitted afterwards,
// or built in each: rays find the same triangles.
TEST_F(RaysBackendPicture, IsTheSameWhetherItsStructureIsBuiltOrFitted) {
    Settings settings = with(small(), Backend::rays);
    settings.simulation.solver = Solver::ftl;
    settings.simulation.wind.strength = 20.0f;
    const auto lastOf = [&](RaysUpdate update, int frames) {
        settings.strands.rays.update = update;
        benchmarks::measure::Case played(device(), settings, HAIRBENCH_SCENES_DIR);
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        for (int i = 0; i < frames; ++i)
            loop.frame([&](engine::Passes& passes) { played.frame(passes); });
        loop.finish();
        return played.picture();
    };
    const Pixels built = lastOf(RaysUpdate::build, 20);
    EXPECT_GT(differingPixels(built, lastOf(RaysUpdate::build, 1)), 300u);
    // A ray on the edge that two triangles share takes either.
    EXPECT_LE(differingPixels(built, lastOf(RaysUpdate::refit, 20)), 5u);
}

TEST_F(RaysBackendPicture, IsTheSameEveryTime) {
    const Settings settings = with(small(), Backend::rays);
    const Pixels first = drawCase(device(), settings);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(differingPixels(first, drawCase(device(), settings)), 0u);
}

TEST_F(RaysBackendPicture, ShowsNoStrandBehindTheCameraNorOfNone) {
    Settings settings = with({}, Backend::rays);
    settings.strands.root_width = settings.strands.tip_width = 0.05f;
    settings.camera.position = {0.0f, 0.0f, 0.5f};
    settings.render.width = 160;
    settings.render.height = 120;
    const groom::Groom behind = oneTriangle({{-0.1f, 0.0f, 0.7f}, {0.1f, 0.1f, 2.0f}});
    const groom::Groom before = oneTriangle({{-0.1f, 0.0f, 0.2f}, {0.1f, 0.1f, 0.0f}});
    groom::Groom none = before;
    none.root_triangles.clear();
    Settings bald = settings;
    bald.render.hair = false;
    const Pixels empty = drawGroom(device(), bald, behind, nullptr);
    for (const RaysUpdate update : {RaysUpdate::build, RaysUpdate::refit}) {
        settings.strands.rays.update = update;
        EXPECT_EQ(differingPixels(drawGroom(device(), settings, behind, nullptr), empty), 0u);
        EXPECT_EQ(differingPixels(drawGroom(device(), settings, none, nullptr), empty), 0u);
        EXPECT_GT(differingPixels(drawGroom(device(), settings, before, nullptr), empty), 50u);
    }
}

// 28 pieces a strand: two corners for each of their 29 points, and two triangles for each.
TEST_F(RaysBackendPicture, TellsItsMemory) {
    for (const engine::Rebuild rebuild : {engine::Rebuild::anew, engine::Rebuild::refit}) {
        Settings settings = with(small(), Backend::rays);
        if (rebuild == engine::Rebuild::refit) settings.strands.rays.update = RaysUpdate::refit;
        const benchmarks::measure::Case drawn(device(), settings, HAIRBENCH_SCENES_DIR);
        const auto strands = static_cast<std::uint32_t>(drawn.plan().strands());
        ASSERT_EQ(strands, 136u * 64);
        const std::map<std::string, std::uint64_t> bytes = device().resources().bytes();
        EXPECT_EQ(bytes.at("quad corners"), strands * 29ull * 2 * 12);
        EXPECT_EQ(bytes.at("quad triangles"), strands * 28ull * 2 * 12);
        const engine::MemoryRows structure = engine::TriangleStructure::rows(
            device(), {.vertices = strands * 29 * 2,
                       .triangles = strands * 28 * 2,
                       .is_opaque = true,
                       .rebuild = rebuild});
        for (const engine::MemoryRows::Row& row : structure.all())
            EXPECT_EQ(bytes.at(row.of.name), row.of.size) << row.of.name;
    }
}

}  // namespace
}  // namespace hair::rendering
