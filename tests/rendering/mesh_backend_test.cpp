#include "hair/rendering/mesh_backend.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "benchmarks/scene/scene.h"
#include "engine/instance.h"
#include "engine/pictures.h"
#include "engine/queries.h"
#include "tests/error_text.h"
#include "tests/flip_errors.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"

// The back end `mesh`: its division into workgroups, its pictures compared with those of
// `tessellation`, and its limits.
namespace hair::rendering {
namespace {

// ---- Workgroups ---------------------------------------------------------------------------------

// The least limits of a device with mesh shaders in the Vulkan specification (table "Required
// Limits"), and preferences as that device's own.
VkPhysicalDeviceMeshShaderPropertiesEXT leastLimits() {
    VkPhysicalDeviceMeshShaderPropertiesEXT limits{};
    limits.maxTaskWorkGroupTotalCount = 1u << 22;
    limits.maxTaskWorkGroupInvocations = limits.maxMeshWorkGroupInvocations = 128;
    for (int axis = 0; axis < 3; ++axis) {
        limits.maxTaskWorkGroupCount[axis] = limits.maxMeshWorkGroupCount[axis] = 65535;
        limits.maxTaskWorkGroupSize[axis] = limits.maxMeshWorkGroupSize[axis] = 128;
    }
    limits.maxTaskPayloadSize = 16384;
    limits.maxTaskSharedMemorySize = 32768;
    limits.maxTaskPayloadAndSharedMemorySize = 32768;
    limits.maxMeshWorkGroupTotalCount = 1u << 22;
    limits.maxMeshSharedMemorySize = 28672;
    limits.maxMeshPayloadAndSharedMemorySize = 28672;
    limits.maxMeshOutputMemorySize = 32768;
    limits.maxMeshPayloadAndOutputMemorySize = 47104;
    limits.maxMeshOutputComponents = 128;
    limits.maxMeshOutputVertices = limits.maxMeshOutputPrimitives = 256;
    limits.maxPreferredTaskWorkGroupInvocations = 128;
    limits.maxPreferredMeshWorkGroupInvocations = 128;
    return limits;
}

engine::DeviceInfo deviceWith(
    const VkPhysicalDeviceMeshShaderPropertiesEXT& limits,
    engine::DeviceType type = engine::DeviceType::discrete) {
    engine::DeviceInfo info;
    info.type = type;
    info.mesh_limits = limits;
    return info;
}

TEST(MeshBackend, FitsEveryDevice) {
    const MeshSizes sizes = meshSizes(deviceWith(leastLimits()));
    EXPECT_EQ(sizes.points, 128u);
    EXPECT_EQ(sizes.task_group, 128u);
    EXPECT_EQ(sizes.mesh_group, 128u);
}

TEST(MeshBackend, HasWorkgroupsAsTheDeviceLikesThem) {
    VkPhysicalDeviceMeshShaderPropertiesEXT limits = leastLimits();
    limits.maxTaskWorkGroupInvocations = limits.maxMeshWorkGroupInvocations = 1024;
    limits.maxTaskWorkGroupSize[0] = limits.maxMeshWorkGroupSize[0] = 1024;
    EXPECT_EQ(meshSizes(deviceWith(limits)).mesh_group, 128u);
    limits.maxPreferredTaskWorkGroupInvocations = 32;
    limits.maxPreferredMeshWorkGroupInvocations = 64;
    EXPECT_EQ(meshSizes(deviceWith(limits)).task_group, 32u);
    EXPECT_EQ(meshSizes(deviceWith(limits)).mesh_group, 64u);
    EXPECT_EQ(meshSizes(deviceWith(limits, engine::DeviceType::cpu)).mesh_group, 8u);
    limits.maxTaskPayloadSize = 40;  // of four bytes a block
    limits.maxMeshWorkGroupSize[0] = 16;
    EXPECT_EQ(meshSizes(deviceWith(limits)).task_group, 10u);
    EXPECT_EQ(meshSizes(deviceWith(limits)).mesh_group, 16u);
}

TEST(MeshBackend, RefusesDevicesThatHaveLessThanAllShould) {
    VkPhysicalDeviceMeshShaderPropertiesEXT limits = leastLimits();
    limits.maxMeshOutputVertices = 128;
    EXPECT_EQ(
        errorText([&] { meshSizes(deviceWith(limits)); }),
        "/strands/backend: mesh: mesh work groups of the device have 128 vertices; 256 are needed");
    limits = leastLimits();
    limits.maxMeshSharedMemorySize = 1000;
    EXPECT_NE(
        errorText([&] { meshSizes(deviceWith(limits)); }).find("1000 bytes of shared memory"),
        std::string::npos);
}

StrandPlan planOf(
    std::uint32_t triangles, std::uint32_t segments, std::uint32_t density, std::uint32_t pieces) {
    return planStrands(triangles, segments, {.density = density, .tessellation = pieces}, {}, 64);
}

TEST(MeshBackend, FillsBlocksWithWholeStrands) {
    // 7 x 4 + 1 = 29 points per strand; four strands fit into 128.
    EXPECT_EQ(countBlocks(planOf(136, 7, 64, 4), Taper::strand, 128), 136u * 16);
    EXPECT_EQ(countBlocks(planOf(136, 7, 65, 4), Taper::strand, 128), 136u * 17);
    // 7 x 5 = 35 points if segments share none; three strands fit.
    EXPECT_EQ(countBlocks(planOf(136, 7, 64, 4), Taper::segment, 128), 136u * 22);
    // 127 + 1 points and 64 x 2 points fill one block; one point more takes a second block.
    EXPECT_EQ(countBlocks(planOf(1, 127, 1, 1), Taper::strand, 128), 1u);
    EXPECT_EQ(countBlocks(planOf(1, 128, 1, 1), Taper::strand, 128), 2u);
    EXPECT_EQ(countBlocks(planOf(1, 64, 1, 1), Taper::segment, 128), 1u);
    EXPECT_EQ(countBlocks(planOf(1, 65, 1, 1), Taper::segment, 128), 2u);
}

TEST(MeshBackend, CutsLongStrandsBetweenSegments) {
    // 15 segments of 8 pieces have 121 points, 16 have 129: 64 segments are five blocks.
    EXPECT_EQ(countBlocks(planOf(2, 64, 3, 8), Taper::strand, 128), 2u * 3 * 5);
    // 65 points per segment; two segments share one.
    EXPECT_EQ(countBlocks(planOf(1, 255, 1, 64), Taper::strand, 128), 255u);
    EXPECT_EQ(countBlocks(planOf(0, 7, 64, 4), Taper::strand, 128), 0u);
    EXPECT_NE(
        errorText([] {
            countBlocks(planOf(1u << 20, 255, 4096, 64), Taper::strand, 128);
        }).find("blocks of strands are too many"),
        std::string::npos);
}

// ---- Pictures -----------------------------------------------------------------------------------

namespace fs = std::filesystem;

class MeshBackendPicture : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (isOver()) return;
        if (!device().has(engine::Feature::mesh_shader))
            return skipWithout(Need::mesh, "the device has no task and mesh stages");
    }

    // The back end makes the quads of `tessellation` by the same functions: on processors the
    // pictures are equal, but a centroid is rounded differently if a quad's triangles come in
    // another way: 2 of 57,600 pixels on lavapipe of Mesa 25. A GPU's compiler may round
    // differently in another stage, which moves an edge over a sample in a few places.
    static void expectSamePictures(const Settings& settings, std::size_t hair) {
        const Pixels expected = drawCase(device(), with(settings, Backend::tessellation));
        EXPECT_GT(differingPixels(expected, drawBald(device(), settings)), hair);
        EXPECT_LE(
            differingPixels(expected, drawCase(device(), with(settings, Backend::mesh))),
            mostDiffering(settings));
    }

    static std::size_t mostDiffering(const Settings& settings) {
        const std::size_t pixels = std::size_t{settings.render.width} * settings.render.height;
        if (device().info().type == engine::DeviceType::cpu)
            return settings.render.msaa > 1 ? pixels / 10000 : 0;
        return pixels / 1000;
    }

    static Settings small() {
        Settings settings = thesisAtRest();
        settings.render.width = 320;
        settings.render.height = 180;
        return settings;
    }

    fs::path write(const std::string& name, const Settings& settings, const Pixels& pixels) {
        return writePicture(folder_.path() / (name + ".png"), settings, pixels);
    }

    TemporaryFolder folder_;
};

TEST_F(MeshBackendPicture, IsThatOfTessellationAtTheThesissCase) {
    expectSamePictures(thesisAtRest(), 10000);
}

TEST_F(MeshBackendPicture, IsThatOfTessellationOfStrandsInAnyNumber) {
    Settings dense = small();
    dense.strands.density = 101;  // blocks of four strands and one of a single strand; two patches
                                  // per triangle
    dense.strands.tessellation = 3;
    expectSamePictures(dense, 625);
    Settings single = small();
    single.strands.density = 1;
    single.strands.root_width = single.strands.tip_width = 0.003f;
    expectSamePictures(single, 625);
}

// 32 segments of 16 pieces: each strand takes five blocks, and the joints between them are closed.
TEST_F(MeshBackendPicture, IsThatOfTessellationOfLongStrands) {
    Settings settings = small();
    settings.groom.guides = 30;
    settings.groom.grow.vertices = 33;
    settings.strands.density = 16;
    settings.strands.tessellation = 16;
    expectSamePictures(settings, 625);
    settings.strands.taper = Taper::segment;
    expectSamePictures(settings, 625);
}

TEST_F(MeshBackendPicture, IsThatOfTessellationWithSeveralSamples) {
    if (!device().supportsSamples(4)) GTEST_SKIP() << "no 4-sample images";
    Settings settings = small();
    settings.render.msaa = 4;
    expectSamePictures(settings, 625);
}

TEST_F(MeshBackendPicture, IsThatOfTessellationAtEveryLevelOfDetail) {
    Settings settings = small();
    settings.strands.density = 100;
    settings.lod = {.mode = LodMode::distance, .near_distance = 0.4f, .far_distance = 0.8f};
    expectSamePictures(settings, 625);
    settings.strands.taper = Taper::segment;
    expectSamePictures(settings, 625);
    settings.strands.taper = Taper::strand;
    settings.lod = {.mode = LodMode::forced, .level = 1.3f};
    expectSamePictures(settings, 625);
}

// Curves, tapers, offsets and strands that follow a single guide.
TEST_F(MeshBackendPicture, IsThatOfTessellationOfEveryKindOfStrand) {
    const std::initializer_list<void (*)(StrandSettings&)> kinds{
        [](StrandSettings& s) {
            s.curve = Curve::bspline_unpinned;
            s.taper = Taper::segment;
        },
        [](StrandSettings& s) { s.curve = Curve::catmull_rom; },
        [](StrandSettings& s) { s.curl.radius = 0.01f; },
        [](StrandSettings& s) { s.interpolation = Interpolation::single; },
        [](StrandSettings& s) {
            s.interpolation = Interpolation::mixed;
            s.randomness = Randomness::thesis;
        }};
    for (const auto& kind : kinds) {
        Settings settings = small();
        kind(settings.strands);
        SCOPED_TRACE(&kind - kinds.begin());
        expectSamePictures(settings, 625);
    }
}

// The strands of a groom. Each has its own guides and its own level.
TEST_F(MeshBackendPicture, IsThatOfTessellationOfAGroomsOwnStrands) {
    Settings settings;
    settings.strands.source = StrandSource::groom;
    settings.strands.tessellation = 4;
    settings.strands.root_width = settings.strands.tip_width = 0.02f;
    settings.camera.position = {0.0f, 0.0f, 0.6f};
    settings.render.width = 320;
    settings.render.height = 240;
    settings.render.head = false;
    groom::Groom groom = oneTriangle(
        {{-0.15f, -0.1f, 0.05f},
         {-0.05f, 0.02f, 0.0f},
         {0.05f, 0.0f, 0.0f},
         {0.15f, 0.1f, -0.05f}});
    groom.root_triangles.clear();
    for (int i = 0; i < 21; ++i) {
        const float turn = 0.3f * static_cast<float>(i);
        groom.bindings.push_back(
            {.guides = {0, 1, 2},
             .weights = {0.2f, 0.3f, 0.5f},
             .offset = {0.0f, 0.1f * std::sin(turn), 0.1f * std::cos(turn)}});
    }
    for (const LodMode mode : {LodMode::forced, LodMode::distance}) {
        settings.lod = {.mode = mode, .near_distance = 0.5f, .far_distance = 0.8f};
        const Pixels expected =
            drawGroom(device(), with(settings, Backend::tessellation), groom, nullptr);
        const Pixels drawn = drawGroom(device(), with(settings, Backend::mesh), groom, nullptr);
        Settings bald = settings;
        bald.render.hair = false;
        EXPECT_GT(differingPixels(expected, drawGroom(device(), bald, groom, nullptr)), 2000u);
        EXPECT_LE(differingPixels(expected, drawn), mostDiffering(settings));
    }
}

TEST_F(MeshBackendPicture, IsThatOfTessellationHoweverItIsShown) {
    const std::initializer_list<std::pair<const char*, void (*)(Settings&)>> kinds{
        {"lists", [](Settings& s) { s.render.transparency = Transparency::fragment_list; }},
        {"samples", [](Settings& s) { s.render.transparency = Transparency::alpha_to_coverage; }},
        {"covered",
         [](Settings& s) {
             s.render.coverage = Coverage::analytic;
             s.render.transparency = Transparency::fragment_list;
         }},
        {"tangents", [](Settings& s) { s.render.show = Show::tangents; }},
        {"normals", [](Settings& s) { s.render.show = Show::normals; }},
        {"strands", [](Settings& s) { s.render.show = Show::strands; }},
        {"levels",
         [](Settings& s) {
             s.render.show = Show::lod;
             s.lod = {.mode = LodMode::distance, .near_distance = 0.42f, .far_distance = 0.6f};
         }},
        {"Marschner", [](Settings& s) { s.shading.model = ShadingModel::marschner; }},
    };
    for (const auto& [name, change] : kinds) {
        SCOPED_TRACE(name);
        Settings settings = small();
        change(settings);
        expectSamePictures(settings, 625);
    }
}

// Sums of half floats and of opacity depend on the order of strands in their last bits.
TEST_F(MeshBackendPicture, IsNearThatOfTessellationWhereStrandsAreBlended) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    for (const bool shadows : {false, true}) {
        Settings settings = small();
        settings.render.transparency = Transparency::weighted_blended;
        settings.strands.opacity = 0.4f;
        if (shadows) {
            settings.render.transparency = Transparency::none;
            settings.shading.model = ShadingModel::dual_scattering;
            settings.shading.shadows.hair = HairShadows::deep_opacity;
            settings.shading.shadows.meshes = true;
        }
        const Pixels expected = drawCase(device(), with(settings, Backend::tessellation));
        const Pixels drawn = drawCase(device(), with(settings, Backend::mesh));
        EXPECT_GT(differingPixels(expected, drawBald(device(), settings)), 625u);
        EXPECT_LE(
            flipErrors({{write("t", settings, expected), write("m", settings, drawn)}})[0], 0.005);
    }
}

// The shipped scenes, after frames in which the simulation moves the hair.
TEST_F(MeshBackendPicture, IsThatOfTessellationInScenes) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    std::vector<std::pair<fs::path, fs::path>> pairs;
    for (const char* scene :
         {"rest", "strong_wind", "curly", "root_triangles/tight_curls", "lod_path"}) {
        const fs::path file = fs::path(HAIRBENCH_SCENES_DIR) / (std::string(scene) + ".json");
        for (const std::uint32_t samples : {1u, 4u}) {
            Settings settings = benchmarks::scene::loadScene(file).settings;
            settings.simulation.settle_steps = 10;
            settings.render.width = 480;
            settings.render.height = 270;
            settings.render.ssaa = 1;
            settings.render.msaa = samples;
            const auto draw = [&](Backend backend, const char* kind) {
                benchmarks::measure::Case picture(
                    device(), with(settings, backend), file.parent_path());
                engine::FrameLoop loop(device(), engine::Timing::overlapped);
                for (int i = 0; i < 2; ++i)
                    loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
                loop.finish();
                return write(
                    file.stem().string() + std::to_string(samples) + kind, settings,
                    picture.picture());
            };
            const fs::path expected = draw(Backend::tessellation, "t");
            pairs.emplace_back(expected, draw(Backend::mesh, "m"));
        }
    }
    const std::vector<double> errors = flipErrors(pairs);
    for (std::size_t i = 0; i < errors.size(); ++i)
        EXPECT_LE(errors[i], 0.005) << pairs[i].second.filename();
}

// The eye is in the hair, so strands cross the near plane or are behind it.
TEST_F(MeshBackendPicture, IsThatOfTessellationWithinTheHair) {
    Settings settings = small();
    settings.camera.position = {0.0f, 0.02f, 0.11f};
    settings.camera.target = {0.08f, 0.0f, 0.02f};
    settings.camera.near_plane = 0.02f;
    expectSamePictures(settings, 320u * 180u / 4u);
}

TEST_F(MeshBackendPicture, ShowsNoStrandBehindTheCameraNorOfNone) {
    Settings settings;
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
    settings.strands.backend = Backend::mesh;
    EXPECT_EQ(differingPixels(drawGroom(device(), settings, behind, nullptr), empty), 0u);
    EXPECT_EQ(differingPixels(drawGroom(device(), settings, none, nullptr), empty), 0u);
    EXPECT_GT(differingPixels(drawGroom(device(), settings, before, nullptr), empty), 50u);
}

TEST_F(MeshBackendPicture, HasAnySize) {
    Settings wide = small();
    wide.render.width = 8192;
    wide.render.height = 64;
    expectSamePictures(wide, 200);
    Settings one = small();
    one.camera.position = {0.0f, 0.05f, 0.5f};
    one.camera.target = {0.0f, 0.05f, 0.0f};
    one.strands.root_width = one.strands.tip_width = 0.01f;
    one.render.width = one.render.height = 1;
    const Pixels drawn = drawCase(device(), with(one, Backend::mesh));
    EXPECT_EQ(differingPixels(drawn, drawBald(device(), one)), 1u);
    EXPECT_EQ(differingPixels(drawn, drawCase(device(), with(one, Backend::tessellation))), 0u);
}

TEST_F(MeshBackendPicture, IsTheSameEveryTime) {
    const Settings settings = with(small(), Backend::mesh);
    const Pixels first = drawCase(device(), settings);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(differingPixels(first, drawCase(device(), settings)), 0u);
}

// ---- What it leaves out -------------------------------------------------------------------------

struct Invocations {
    std::uint64_t task = 0;
    std::uint64_t mesh = 0;
};

class MeshBackendCounts : public MeshBackendPicture {
protected:
    void SetUp() override {
        MeshBackendPicture::SetUp();
        if (isOver()) return;
        if (!device().hasPipelineStatistics() || !device().has(engine::Feature::mesh_statistics))
            GTEST_SKIP() << "the device doesn't count them";
    }

    static Invocations count(const Settings& settings) {
        benchmarks::measure::Case picture(
            device(), with(settings, Backend::mesh), HAIRBENCH_SCENES_DIR);
        engine::FrameLoop loop(device(), engine::Timing::statistics);
        loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
        const std::vector<engine::FrameRecord> records = loop.finish();
        const auto strands = std::ranges::find(
            records.at(0).statistics, std::string("strands"), &engine::PassStatistics::name);
        if (strands == records.at(0).statistics.end()) throw std::runtime_error("no strands");
        const auto at = [&](std::string_view name) {
            const auto place = std::ranges::find(engine::kStatisticNames, name);
            return strands->counts.at(
                static_cast<std::size_t>(place - engine::kStatisticNames.begin()));
        };
        EXPECT_EQ(at("vertex_invocations"), 0u);
        EXPECT_EQ(at("geometry_invocations"), 0u);
        return {.task = at("task_invocations"), .mesh = at("mesh_invocations")};
    }
};

// 136 triangles of 64 strands, four strands per block.
TEST_F(MeshBackendCounts, AreABlockForEachInvocationAndAWorkgroupForEachBlock) {
    const MeshSizes sizes = meshSizes(device().info());
    const Invocations counted = count(small());
    EXPECT_EQ(counted.task, divideUp(136u * 16, sizes.task_group) * sizes.task_group);
    EXPECT_EQ(counted.mesh, 136u * 16 * sizes.mesh_group);
}

TEST_F(MeshBackendCounts, AreFewerOfWhatAPictureCannotShow) {
    const Invocations whole = count(small());
    Settings part = small();
    part.camera.target = {0.12f, 0.0f, 0.0f};  // a corner of the hair, 9 cm high
    part.camera.field_of_view = 10.0f;
    const Invocations seen = count(part);
    EXPECT_EQ(seen.task, whole.task);
    EXPECT_GT(seen.mesh, 0u);
    EXPECT_LT(seen.mesh, whole.mesh);
    expectSamePictures(part, 100);
    Settings away = small();
    away.camera.target = {0.0f, 0.0f, 2.0f};  // looks away from the hair, from z = 0.5 m
    EXPECT_EQ(count(away).mesh, 0u);
}

// With one piece a segment a strand has eight points, so 16 strands fit a block; level 3 draws 8
// of 64.
TEST_F(MeshBackendCounts, AreFewerOfCoarseLevels) {
    Settings far = small();
    far.lod = {
        .mode = LodMode::distance,
        .near_distance = 0.01f,
        .far_distance = 0.02f,
        .maximum_level = 3.0f};
    const MeshSizes sizes = meshSizes(device().info());
    EXPECT_EQ(count(far).mesh, 136u * sizes.mesh_group);
}

}  // namespace
}  // namespace hair::rendering
