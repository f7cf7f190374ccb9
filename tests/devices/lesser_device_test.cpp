// Tests devices that lack features. Cases that need them are skipped with one line; all others have
// the same results as elsewhere. The devices are made from the present one by hiding features. The
// validation layer reports any use of a hidden feature.
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "engine/queries.h"
#include "engine/shaders.h"
#include "engine/spirv_judge.h"
#include "engine/target.h"
#include "hair/rendering/backends.h"
#include "tests/required.h"
#include "tests/simulation/near_reference.h"

namespace benchmarks {
namespace {

using engine::DeviceInfo;
using engine::Feature;
using testing::IsEmpty;

using Mask = std::function<void(DeviceInfo&)>;

Mask without(std::vector<Feature> features) {
    return [features](DeviceInfo& info) {
        for (const Feature feature : features) info.features.erase(feature);
    };
}

// Hides everything that the program can do without.
void bare(DeviceInfo& info) {
    info.features.clear();
    info.limits.maxTessellationGenerationLevel = 0;
}

// Gets the work that a GPU gets: processors get few long invocations, GPUs many short ones.
void likeAGpu(DeviceInfo& info) {
    info.type = engine::DeviceType::discrete;
    info.subgroup_size = 64;
}

// Devices are made one after the other, because volk's functions belong to the last one.
class LesserDevice : public testing::Test {
protected:
    void SetUp() override {
        try {
            make({});
        } catch (const engine::NoDevice& error) {
            skipWithout(Need::device, error.what());
        }
    }

    void TearDown() override { expectNoMessage(); }

    engine::Device& make(const Mask& mask) {
        expectNoMessage();
        device_.reset();
        device_.emplace(engine::DeviceOptions{
            .wanted = "", .validation = engine::Validation::on, .mask = mask});
        return *device_;
    }

    engine::Device& device() { return *device_; }

    using Pixels = std::vector<std::uint8_t>;

    // Returns the picture of the third frame.
    Pixels pictureOf(const hair::Settings& settings) {
        measure::Case played(device(), settings, HAIRBENCH_SCENES_DIR);
        engine::FrameLoop loop(device(), engine::Timing::isolated);
        for (int i = 0; i < 3; ++i)
            loop.frame([&](engine::Passes& passes) { played.frame(passes); });
        loop.finish();
        return played.picture();
    }

    // Returns the reason for which the case is skipped.
    std::string skipped(const hair::Settings& settings) {
        try {
            const measure::Case made(device(), settings, HAIRBENCH_SCENES_DIR);
        } catch (const engine::Unsupported& error) {
            return error.what();
        }
        return "not skipped";
    }

private:
    void expectNoMessage() {
        if (!device_) return;
        EXPECT_THAT(device_->messages().take(), IsEmpty());
    }

    std::optional<engine::Device> device_;
};

hair::Settings smallCase() {
    hair::Settings settings;
    settings.groom.guides = 20;
    settings.simulation.settle_steps = 0;
    settings.simulation.wind.strength = 10.0f;
    settings.strands.backend = hair::Backend::tessellation;
    settings.strands.density = 4;
    settings.strands.tessellation = 2;
    settings.render.width = 160;
    settings.render.height = 96;
    return settings;
}

hair::Settings onlyGuides() {
    hair::Settings settings = smallCase();
    settings.simulation.colliders = {
        {.a = {0, 0.014f, 0.012f}, .b = {0, 0.014f, 0.012f}, .radius = 0.0661f}};
    settings.render.hair = false;
    settings.render.overlays = {.guides = true, .root_triangles = true, .bodies = true};
    return settings;
}

// ---- As a GPU ----------------------------------------------------------------------------------

TEST_F(LesserDevice, IsGivenAGpusShareOfWorkForTheSamePicture) {
    hair::Settings settings = smallCase();
    settings.simulation.solver = hair::Solver::ftl;  // with the same invocations on all devices
    settings.strands.density = 11;
    settings.strands.tessellation = 3;
    for (const hair::Backend backend : {hair::Backend::software, hair::Backend::expanded})
        for (const hair::Taper taper : {hair::Taper::strand, hair::Taper::segment}) {
            settings.strands.backend = backend;
            settings.strands.taper = taper;
            make({});
            const Pixels expected = pictureOf(settings);
            make(likeAGpu);
            EXPECT_TRUE(pictureOf(settings) == expected);
            settings.render.hair = false;
            EXPECT_FALSE(pictureOf(settings) == expected);
            settings.render.hair = true;
        }
}

// ---- Skipped cases ------------------------------------------------------------------------------

TEST_F(LesserDevice, StrandsNeedTheStagesOfTheirBackEnd) {
    hair::Settings pulled = smallCase();
    pulled.strands.backend = hair::Backend::pulling_geometry;
    make(without({Feature::tessellation}));
    EXPECT_EQ(
        skipped(smallCase()),
        "/strands/backend: tessellation: the device has no tessellation stages with isolines");
    EXPECT_EQ(skipped(pulled), "not skipped");
    make(without({Feature::geometry}));
    EXPECT_EQ(
        skipped(smallCase()), "/strands/backend: tessellation: the device has no geometry stages");
    EXPECT_EQ(
        skipped(pulled), "/strands/backend: pulling_geometry: the device has no geometry stages");
    pulled.strands.backend = hair::Backend::pulling;
    make(bare);
    EXPECT_EQ(skipped(pulled), "not skipped");
    pulled.strands.backend = hair::Backend::mesh;
    EXPECT_EQ(skipped(pulled), "/strands/backend: mesh: the device has no task and mesh stages");
    pulled.strands.backend = hair::Backend::rays;
    EXPECT_EQ(skipped(pulled), "/strands/backend: rays: the device has no ray queries");
}

// Takes the first back end, in the order for this type of device, of which the device lacks no
// feature.
TEST_F(LesserDevice, StrandsAreDrawnByWhatTheDeviceHas) {
    hair::Settings settings = smallCase();
    settings.strands.backend = hair::Backend::automatic;
    settings.render.msaa = 4;
    const auto drawnBy = [&] {
        return measure::Case(device(), settings, HAIRBENCH_SCENES_DIR).backend().value();
    };
    make({});
    EXPECT_EQ(drawnBy().backend, hair::Backend::software);
    make([](DeviceInfo& info) { info.limits.standardSampleLocations = VK_FALSE; });
    EXPECT_EQ(drawnBy().backend, hair::Backend::tessellation);
    make([](DeviceInfo& info) {
        info.limits.standardSampleLocations = VK_FALSE;
        info.features.erase(Feature::geometry);
    });
    EXPECT_EQ(drawnBy().backend, hair::Backend::expanded);
    EXPECT_EQ(
        drawnBy().reason,
        "automatic: the first that can draw it; not software: /strands/backend: software: the "
        "device does not have the standard sample locations; not tessellation: /strands/backend: "
        "tessellation: the device has no geometry stages");
}

TEST_F(LesserDevice, StrandsInComputeNeedSamplesAtKnownPlaces) {
    hair::Settings settings = smallCase();
    settings.strands.backend = hair::Backend::software;
    settings.render.msaa = 4;
    make([](DeviceInfo& info) { info.limits.standardSampleLocations = VK_FALSE; });
    EXPECT_EQ(
        skipped(settings),
        "/strands/backend: software: the device does not have the standard sample locations");
    settings.render.msaa = 1;
    EXPECT_EQ(skipped(settings), "not skipped");
}

TEST_F(LesserDevice, ShadowsOfHairNeedThemToo) {
    hair::Settings settings = smallCase();
    settings.shading.shadows.hair = hair::HairShadows::deep_opacity;
    make(without({Feature::geometry}));
    EXPECT_EQ(
        skipped(settings), "/strands/backend: tessellation: the device has no geometry stages");
    settings.render.hair = false;
    EXPECT_EQ(skipped(settings), "not skipped");
}

TEST_F(LesserDevice, MapsOfTheirOpacityNeedBlendingOfFloats) {
    hair::Settings settings = smallCase();
    settings.shading.shadows.hair = hair::HairShadows::deep_opacity;
    make(without({Feature::float_blend}));
    EXPECT_EQ(
        skipped(settings), "/shading/shadows/hair: the device has no blending of 32-bit floats");
    EXPECT_EQ(skipped(smallCase()), "not skipped");
    settings.strands.backend = hair::Backend::software;  // it adds in compute
    EXPECT_EQ(skipped(settings), "not skipped");
}

TEST_F(LesserDevice, TransparencyNeedsItsFeatures) {
    hair::Settings lists = smallCase();
    lists.render.transparency = hair::Transparency::fragment_list;
    hair::Settings weighted = smallCase();
    weighted.render.transparency = hair::Transparency::weighted_blended;
    make(without({Feature::fragment_stores, Feature::independent_blend}));
    EXPECT_EQ(
        skipped(lists),
        "/render/transparency: fragment_list: the device has no stores in fragment stages");
    EXPECT_EQ(
        skipped(weighted),
        "/render/transparency: weighted_blended: the device has no independent blending");
    EXPECT_EQ(skipped(smallCase()), "not skipped");
    lists.render.hair = weighted.render.hair = false;
    EXPECT_EQ(skipped(lists), "not skipped");
    EXPECT_EQ(skipped(weighted), "not skipped");
}

template <class Call>
std::string reasonOf(Call&& call) {
    try {
        call();
    } catch (const engine::Unsupported& error) {
        return error.what();
    }
    return "not skipped";
}

TEST_F(LesserDevice, WatchedStagesNeedStores) {
    make(without({Feature::vertex_stores}));
    EXPECT_EQ(
        reasonOf([&] { hair::rendering::StageWatch{device()}; }),
        "ablation: the device has no stores in vertex, tessellation and geometry stages");
}

TEST_F(LesserDevice, SamplesAreCountedOnlyWhereQueriesCount) {
    make(without({Feature::sample_counts}));
    EXPECT_EQ(
        reasonOf([&] { engine::SamplesQuery{device()}; }),
        "samples query: the device has no occlusion queries that count");
}

TEST_F(LesserDevice, PipelinesNameTheStageThatIsMissing) {
    make(bare);
    const engine::GraphicsDescription description{
        .shaders = {"strands/pulling_geometry.vert", "strands/strand.geom", "strands/strand.frag"}};
    EXPECT_EQ(
        reasonOf([&] { engine::GraphicsPipeline(device(), description); }),
        "strands/strand.geom: the device has no geometry stages");
}

// Invocations exchange a strand's vertices in shared memory. Each needs 116 bytes and has at most
// 32 vertices.
TEST_F(LesserDevice, ShapeNeedsSharedMemoryForItsStrands) {
    const auto withShared = [](std::uint32_t bytes) {
        return [bytes](DeviceInfo& info) { info.limits.maxComputeSharedMemorySize = bytes; };
    };
    make(withShared(3 * 116 - 1));
    hair::Settings settings = onlyGuides();
    settings.groom.grow.vertices = 65;
    EXPECT_EQ(skipped(settings), "simulation: 65 vertices per strand; this device runs at most 64");
    settings.groom.grow.vertices = 64;
    EXPECT_EQ(skipped(settings), "not skipped");
    make(withShared(0));
    EXPECT_EQ(skipped(settings), "simulation: 64 vertices per strand; this device runs at most 0");
    settings.simulation.parallelism = hair::Parallelism::serial;
    EXPECT_EQ(skipped(settings), "not skipped");
}

// ---- Cases with the same results ----------------------------------------------------------------

// Present fences need an instance extension for windows. Devices without a window have neither.
TEST_F(LesserDevice, HasNoFencesOfPresentsWithoutAWindow) {
    EXPECT_FALSE(device().has(Feature::present_fences));
    make([](DeviceInfo& info) { EXPECT_FALSE(info.features.contains(Feature::present_fences)); });
}

// The memory leaves room for only four invocations, so each has four vertices instead of fewer.
TEST_F(LesserDevice, ShapeMovesStrandsTheSameInLittleSharedMemory) {
    make([](DeviceInfo& info) { info.limits.maxComputeSharedMemorySize = 4 * 116; });
    hair::SimulationSettings settings = hair::simulation::windy();
    settings.parallelism = hair::Parallelism::vertex;
    hair::simulation::expectNearReference(device(), hair::simulation::wavyGroom(5, 16), settings);
}

// Returns the bytes of the buffers of this name.
std::uint64_t bytesOf(const engine::Device& device, const std::string& name) {
    std::uint64_t bytes = 0;
    for (const auto& [entry, size] : device.memory())
        if (entry.name == name) bytes += size;
    return bytes;
}

// Moves 100 strands without 64-bit integers, and in smaller dispatches: of 64 strands because of
// the range of a buffer or a sixteenth of the device's memory, and of 32 without memory. The
// results are the same, because strands do not depend on each other.
class LesserDeviceRods
    : public LesserDevice,
      public testing::WithParamInterface<std::pair<hair::Solver, std::uint32_t>> {};

// Each solver with its vec4 of scratch memory per vertex.
INSTANTIATE_TEST_SUITE_P(
    , LesserDeviceRods,
    testing::Values(
        std::pair{hair::Solver::rod, 9u}, std::pair{hair::Solver::stable_cosserat, 4u},
        std::pair{hair::Solver::position_based_rod, 5u},
        std::pair{hair::Solver::augmented_mass_spring, 13u}));

TEST_P(LesserDeviceRods, MoveStrandsTheSameOnAnyDevice) {
    const std::uint64_t bytes = 9 * 16 * GetParam().second;  // B
    hair::SimulationSettings settings = hair::simulation::windy();
    settings.solver = GetParam().first;
    const hair::groom::Groom groom = hair::simulation::wavyGroom(100, 9);
    struct State {
        std::vector<glm::vec3> positions;
        std::vector<glm::vec3> previous;
        bool operator==(const State&) const = default;
    };
    const auto played = [&](std::uint64_t strands) {
        hair::simulation::Simulation simulation(device(), groom, settings, 3);
        EXPECT_EQ(bytesOf(device(), "rod scratch"), strands * bytes);
        hair::simulation::advance(device(), simulation, 10);
        return State{simulation.readPositions(), simulation.readPrevious()};
    };
    const State whole = played(100);
    EXPECT_NE(whole.positions, groom.points);
    make(without({Feature::long_integers}));
    EXPECT_EQ(played(100), whole);
    make([&](DeviceInfo& info) { info.limits.maxStorageBufferRange = 96 * bytes - 1; });
    EXPECT_EQ(played(64), whole);
    make([&](DeviceInfo& info) { info.local_bytes = 16 * 64 * bytes; });
    EXPECT_EQ(played(64), whole);
    make([](DeviceInfo& info) { info.local_bytes = 0; });
    EXPECT_EQ(played(32), whole);
}

// Sums are of integers, so adding two at once or each by itself gives the same.
TEST_F(LesserDevice, HairFeelsHairTheSameWithoutAtomicsOnLongIntegers) {
    const hair::HairHairSettings slides{
        .friction = 0.3f, .repulsion = 0.3f, .crowding = 0.5f, .resolution = 32};
    const hair::HairHairSettings sticks{
        .friction_coefficient = 0.5f,
        .cohesion = 0.05f,
        .repulsion = 0.3f,
        .crowding = 0.5f,
        .resolution = 32};
    hair::HairHairSettings joins = slides;
    joins.attraction = 0.1f;
    hair::HairHairSettings joins_and_sticks = sticks;
    joins_and_sticks.attraction = 0.1f;
    const hair::groom::Groom groom = hair::simulation::wavyGroom(100, 9);
    for (const hair::HairHairSettings& contact : {slides, sticks, joins, joins_and_sticks}) {
        hair::SimulationSettings settings = hair::simulation::windy();
        settings.hair_hair = contact;
        const auto played = [&] {
            hair::simulation::Simulation simulation(device(), groom, settings, 3);
            hair::simulation::advance(device(), simulation, 10);
            return simulation.readPositions();
        };
        make({});
        const std::vector<glm::vec3> there = played();
        for (const std::vector<Feature>& missing :
             {std::vector{Feature::long_atomics}, std::vector{Feature::long_integers},
              engine::allFeatures()}) {
            make(without(missing));
            EXPECT_EQ(played(), there);
        }
        make(likeAGpu);  // which takes a part of the cells at a time
        settings.parallelism = hair::Parallelism::serial;
        const std::vector<glm::vec3> serial = played();
        make({});
        EXPECT_EQ(played(), serial);
        settings.hair_hair = {};
        EXPECT_NE(played(), serial);
    }
}

TEST_F(LesserDevice, DrawsEverythingButStrandsWithoutAnyFeature) {
    hair::Settings settings = onlyGuides();
    settings.shading.shadows.meshes = true;
    settings.render.tone_map = hair::ToneMap::agx;
    const Pixels there = pictureOf(settings);
    hair::Settings empty = settings;
    empty.render.overlays = {};
    EXPECT_NE(there, pictureOf(empty));
    make(bare);
    EXPECT_EQ(pictureOf(settings), there);
}

// Two 32-bit minima find the same nearest piece as one of 64 bits. The way in which points are read
// and the number of strands per invocation do not matter.
TEST_F(LesserDevice, CoversTheSameSamplesByAllVariants) {
    hair::Settings settings = smallCase();
    settings.strands.backend = hair::Backend::software;
    for (const std::uint32_t samples : {1u, 4u}) {
        settings.render.msaa = samples;
        make({});
        const Pixels there = pictureOf(settings);
        hair::Settings bald = settings;
        bald.render.hair = false;
        EXPECT_NE(there, pictureOf(bald));
        make(without({Feature::long_atomics}));
        EXPECT_EQ(pictureOf(settings), there);
        make(without({Feature::push_descriptors}));
        EXPECT_EQ(pictureOf(settings), there);
        make([](DeviceInfo& info) { info.limits.maxTexelBufferElements = 1; });
        EXPECT_EQ(pictureOf(settings), there);
        make([](DeviceInfo& info) { info.type = engine::DeviceType::discrete; });
        EXPECT_EQ(pictureOf(settings), there);
        make(bare);
        EXPECT_EQ(pictureOf(settings), there);
    }
}

// Without tessellation a device's limit for isolines is 0.
TEST_F(LesserDevice, PullsTheSameStrandsWithoutTessellation) {
    hair::Settings settings = smallCase();
    settings.strands.backend = hair::Backend::pulling_geometry;
    settings.strands.density = 80;  // two patches of a device's 64 isolines
    const Pixels there = pictureOf(settings);
    make([](DeviceInfo& info) {
        info.features = {Feature::geometry};
        info.limits.maxTessellationGenerationLevel = 0;
    });
    EXPECT_EQ(pictureOf(settings), there);
    for (const hair::Backend backend : {hair::Backend::pulling, hair::Backend::expanded}) {
        settings.strands.backend = backend;
        make({});
        const Pixels whole = pictureOf(settings);
        make(bare);
        EXPECT_EQ(pictureOf(settings), whole);
    }
}

TEST_F(LesserDevice, HasNoStatisticsWhereTheyAreMissing) {
    make(without({Feature::pipeline_statistics}));
    measure::Case played(device(), smallCase(), HAIRBENCH_SCENES_DIR);
    engine::FrameLoop loop(device(), engine::Timing::statistics);
    loop.frame([&](engine::Passes& passes) { played.frame(passes); });
    EXPECT_THAT(loop.finish().front().statistics, IsEmpty());
}

// Binds more descriptor sets than a pool holds, for pipelines of both kinds, in several frames.
TEST_F(LesserDevice, BindsAnyNumberOfImagesWithoutPushDescriptors) {
    make(without({Feature::push_descriptors}));
    const engine::Target target(device(), {.width = 8, .height = 8, .msaa = 1, .ssaa = 2});
    const engine::ComputePipeline resolve(
        device(), {.shader = "post/resolve.comp",
                   .constants = {{0, 1u}, {1, 2u}},
                   .sampled_images = 1,
                   .storage_images = 1});
    engine::FrameLoop loop(device(), engine::Timing::isolated);
    for (int frame = 0; frame < 3; ++frame) {
        loop.frame([&](engine::Passes& passes) {
            passes.pass("resolve", engine::PassKind::compute, [&](engine::Commands& commands) {
                target.beginRendering(commands, engine::Load::clear, {0.25f, 0.5f, 0.75f});
                target.endRendering(commands);
                target.beginResolve(commands);
                for (int i = 0; i < 150; ++i) {
                    commands.bind(resolve);
                    const engine::Image* const from = &target.color();
                    const engine::Image* const to = &target.output();
                    commands.images(resolve, std::span(&from, 1), std::span(&to, 1));
                    commands.dispatch(1, 1);
                }
                target.endResolve(commands);
            });
        });
    }
    loop.finish();
    const Pixels pixels = engine::readOutput(device(), target);
    ASSERT_EQ(pixels.size(), 8u * 8u * 4u);
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        // 63.75, 127.5 and 191.25 are stored to the nearest of 255 steps.
        EXPECT_EQ(pixels[i], 64);
        EXPECT_THAT(pixels[i + 1], testing::AnyOf(127, 128));
        EXPECT_EQ(pixels[i + 2], 191);
    }
}

// ---- Shaders ------------------------------------------------------------------------------------

// A shader's capabilities list the features that it needs: SPIR-V specification, 3.31.
TEST(ShaderCapabilities, AreThoseThatFeaturesStandFor) {
    constexpr std::uint32_t kCapability = 17;  // OpCapability
    constexpr std::uint32_t kShader = 1, kGeometry = 2, kTessellation = 3, kLongIntegers = 11,
                            kLongAtomics = 12, kSampledBuffer = 46, kImageQuery = 50,
                            kRayQueries = 4472, kMeshShading = 5283, kPhysicalAddresses = 5347;
    for (const std::string_view path : engine::shaderPaths())
        engine::forEachDeclaration(
            engine::shaderCode(path), [&](engine::SpirvInstruction instruction) {
                if (instruction.operation != kCapability) return;
                const std::uint32_t capability = instruction.operands[0];
                // Vulkan has these, or hairbench requires them of every device.
                if (capability == kShader || capability == kSampledBuffer ||
                    capability == kImageQuery || capability == kPhysicalAddresses)
                    return;
                const std::string_view file = engine::shaderFile(path);
                const bool is_packed = path.ends_with("+packed");
                const bool traces = path.starts_with("strands/rays/trace") ||
                                    path.find("+rays") != std::string_view::npos;
                if (traces && capability == kRayQueries) return;
                if (is_packed && (path.starts_with("simulation/volume_splat") ||
                                  path.starts_with("simulation/volume_spread") ||
                                  path.starts_with("strands/software/raster")))
                    EXPECT_THAT(capability, testing::AnyOf(kLongIntegers, kLongAtomics)) << path;
                else if (is_packed)
                    EXPECT_EQ(capability, kLongIntegers) << path;
                else if (file.ends_with(".geom"))
                    EXPECT_EQ(capability, kGeometry) << path;
                else if (file.ends_with(".task") || file.ends_with(".mesh"))
                    EXPECT_EQ(capability, kMeshShading) << path;
                else if (file.ends_with(".tesc") || file.ends_with(".tese"))
                    EXPECT_EQ(capability, kTessellation) << path;
                else
                    ADD_FAILURE() << path << " has capability " << capability;
            });
}

}  // namespace
}  // namespace benchmarks
