#include "benchmarks/measure/hair_cache.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "benchmarks/scene/assets.h"
#include "engine/frame_loop.h"
#include "engine/shaders.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::measure {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kScenes = HAIRBENCH_SOURCE_DIR "/scenes";

// A few of the thesis's guides, settled onto the head, in a small picture.
hair::Settings settledCase(hair::Solver solver) {
    hair::Settings settings;
    settings.groom.guides = 24;
    settings.strands.density = 2;
    settings.strands.tessellation = 1;
    settings.render.width = 48;
    settings.render.height = 32;
    settings.simulation.solver = solver;
    settings.simulation.settle_steps = 12;
    settings.simulation.wind.strength = 10.0f;
    settings.simulation.collision = {.margin = 0.004f, .friction = 0.3f};
    settings.simulation.distance_fields = {{.mesh = "", .resolution = 12}};
    settings.simulation.hair_hair = {.friction = 0.1f, .repulsion = 0.1f, .resolution = 16};
    return settings;
}

// Hashes of a case: its initial guides, and its guides and picture after frames with motion and a
// reset, twice.
struct Shown {
    std::vector<std::string> hashes;
    bool operator==(const Shown&) const = default;
};

class HairCacheTest : public GpuTest {
protected:
    HairCache onDisk(std::string processor = engine::system::processorName()) {
        return HairCache(
            DiskCache(
                {.folder = folder_.path(),
                 .warn = [this](const std::string& fault) { faults_.push_back(fault); }}),
            std::move(processor));
    }

    static Shown shown(Case& played) {
        Shown shown;
        for (int round = 0; round < 2; ++round) {
            shown.hashes.push_back(played.stateHash());
            engine::FrameLoop loop(device(), engine::Timing::isolated);
            for (int i = 0; i < 3; ++i)
                loop.frame([&](engine::Passes& passes) { played.frame(passes); });
            loop.finish();
            shown.hashes.push_back(played.stateHash());
            shown.hashes.push_back(played.pictureHash());
            played.reset();
        }
        return shown;
    }

    static Shown shown(const hair::Settings& settings, HairCache* cache) {
        Case played(device(), settings, kScenes, cache);
        return shown(played);
    }

    // The complete settled state, including velocities and the solver's own data.
    static std::vector<std::vector<std::byte>>
    settledState(const hair::Settings& settings, HairCache& cache) {
        const auto mesh = scene::loadMesh(settings, kScenes);
        const hair::groom::Groom groom = cache.assets().groom(settings, kScenes);
        return cache
            .simulation(device(), groom, settings, scene::loadFieldMeshes(settings, mesh, kScenes))
            .readSettled()
            .buffers;
    }

    // Number of fields and states that this case adds to the cache.
    static std::size_t makes(HairCache& cache, const hair::Settings& settings) {
        const std::size_t before = cache.made();
        const Case made(device(), settings, kScenes, &cache);
        return cache.made() - before;
    }

    TemporaryFolder folder_;
    std::vector<std::string> faults_;
};

TEST_F(HairCacheTest, GivesToTheBitWhatIsMadeWithoutIt) {
    std::size_t made = 2;  // a field, shared by all solvers, and a state
    for (const hair::Solver solver :
         {hair::Solver::shape, hair::Solver::ftl, hair::Solver::rod, hair::Solver::stable_cosserat,
          hair::Solver::position_based_rod, hair::Solver::augmented_mass_spring}) {
        const hair::Settings settings = settledCase(solver);
        const Shown expected = shown(settings, nullptr);
        ASSERT_NE(expected.hashes[0], expected.hashes[1]);  // it moves
        EXPECT_EQ(expected.hashes[0], expected.hashes[3]);
        HairCache first = onDisk();
        EXPECT_EQ(shown(settings, &first), expected);
        EXPECT_EQ(first.made(), made);
        EXPECT_EQ(shown(settings, &first), expected);
        EXPECT_EQ(first.made(), made);
        made = 1;
        HairCache later = onDisk();
        EXPECT_EQ(shown(settings, &later), expected);
        EXPECT_EQ(later.made(), 0u);

        HairCache nothing;
        const auto state = settledState(settings, nothing);
        ASSERT_EQ(nothing.made(), 2u);
        HairCache again = onDisk();
        EXPECT_EQ(settledState(settings, again), state);
        EXPECT_EQ(again.made(), 0u);
        std::size_t bytes = 0;
        for (const auto& buffer : state) bytes += buffer.size();
        EXPECT_GT(bytes, 0u);
    }
    EXPECT_THAT(faults_, IsEmpty());
}

TEST_F(HairCacheTest, CasesOwnWhatTheyOwnWithoutIt) {
    const hair::Settings settings = settledCase(hair::Solver::rod);
    const auto memory = [&](HairCache* cache) {
        const Case made(device(), settings, kScenes, cache);
        return std::pair(device().allocatedBytes(), device().memory());
    };
    const auto expected = memory(nullptr);
    HairCache cache = onDisk();
    EXPECT_EQ(memory(&cache), expected);
    EXPECT_EQ(memory(&cache), expected);
}

TEST_F(HairCacheTest, CasesThatAreDrawnOtherwiseShareAllOfIt) {
    HairCache cache;
    const hair::Settings settings = settledCase(hair::Solver::shape);
    EXPECT_EQ(makes(cache, settings), 2u);
    for (const auto& change : std::vector<std::function<void(hair::Settings&)>>{
             [](auto& s) { s.strands.density = 5; }, [](auto& s) { s.render.width = 20; },
             [](auto& s) { s.shading.color = {1, 0, 0}; },
             [](auto& s) { s.camera.field_of_view = 30; }, [](auto& s) { s.run.frames = 3; },
             [](auto& s) { s.render.head = !s.render.head; }}) {
        hair::Settings other = settings;
        change(other);
        EXPECT_EQ(makes(cache, other), 0u);
    }
}

// All inputs of a field and of a settled state are in their keys.
TEST_F(HairCacheTest, CasesWithOtherHairShareWhatIsTheSameAlone) {
    const hair::Settings settings = settledCase(hair::Solver::shape);
    HairCache cache = onDisk();
    EXPECT_EQ(makes(cache, settings), 2u);
    using Change = std::function<void(hair::Settings&)>;
    for (const auto& [made, change] : std::vector<std::pair<std::size_t, Change>>{
             {1, [](auto& s) { s.groom.guides = 25; }},
             {1, [](auto& s) { s.groom.grow.length = 0.11f; }},
             {1, [](auto& s) { s.seed = 9; }},
             {1, [](auto& s) { s.simulation.settle_steps = 13; }},
             {1, [](auto& s) { s.simulation.solver = hair::Solver::ftl; }},
             {1, [](auto& s) { s.simulation.gravity.y = -9.0f; }},
             {1, [](auto& s) { s.simulation.local.stiffness = 0.77f; }},
             {1, [](auto& s) { s.simulation.hair_hair.repulsion = 0.2f; }},
             {1, [](auto& s) { s.simulation.colliders = {{.radius = 0.08f}}; }},
             {1, [](auto& s) { s.simulation.motion.keyframes = {{.rotation = {0, 9, 0}}}; }},
             {2, [](auto& s) { s.simulation.collision.margin = 0.005f; }},
             {2, [](auto& s) { s.simulation.distance_fields[0].resolution = 13; }}}) {
        hair::Settings other = settings;
        change(other);
        HairCache fresh = onDisk();  // so that the keys on disk are tested too
        EXPECT_EQ(makes(fresh, other), made);
        EXPECT_EQ(makes(fresh, other), 0u);
    }
}

// The text of a solver's file counts, not its name.
TEST_F(HairCacheTest, AnEditedSolverSettlesAnew) {
    HairCache cache;
    hair::Settings settings = settledCase(hair::Solver::extension);
    settings.groom.grow.mesh = std::string(kScenes) + "/assets/head.glb";
    settings.simulation.solver_file = "mine.glsl";
    const auto hashOf = [&](const std::string& body) {
        folder_.write("mine.glsl", "void solveGuide(Guide guide) { " + body + " }\n");
        return Case(device(), settings, folder_.path(), &cache).stateHash();
    };
    const std::string still = hashOf("");
    const std::size_t made = cache.made();
    const std::string lifted =
        hashOf("setGuidePosition(1u, guideRest(1u) + vec3(0.0, 0.01, 0.0));");
    EXPECT_NE(lifted, still);
    EXPECT_EQ(cache.made(), made + 1);
    EXPECT_EQ(hashOf(""), still);
    EXPECT_EQ(cache.made(), made + 1);
}

// A state without settling is not kept.
TEST_F(HairCacheTest, KeepsNoStateThatTookNoTime) {
    HairCache cache = onDisk();
    hair::Settings settings = settledCase(hair::Solver::none);
    EXPECT_EQ(makes(cache, settings), 1u);  // the field
    settings.simulation.solver = hair::Solver::shape;
    settings.simulation.settle_steps = 0;
    EXPECT_EQ(makes(cache, settings), 0u);
}

// Replacing the program's shaders by identical ones still counts as another program.
TEST_F(HairCacheTest, ProgramsWithOtherShadersTakeNothing) {
    const hair::Settings settings = settledCase(hair::Solver::shape);
    HairCache cache = onDisk();
    EXPECT_EQ(makes(cache, settings), 2u);
    const auto code = engine::shaderCode("simulation/ftl.comp");
    device().shaders().replace({{"simulation/ftl.comp", {code.begin(), code.end()}}});
    HairCache other = onDisk();
    EXPECT_EQ(makes(other, settings), 2u);
    EXPECT_EQ(makes(cache, settings), 0u);  // with the replaced shaders, made by the other cache
    device().shaders().replace({});
    EXPECT_EQ(makes(other, settings), 0u);
}

// The compiled code of a software device depends on the processor.
TEST_F(HairCacheTest, OtherProcessorsTakeNothing) {
    if (device().info().type != engine::DeviceType::cpu)
        GTEST_SKIP() << "the device is no processor";
    const hair::Settings settings = settledCase(hair::Solver::shape);
    HairCache cache = onDisk("Analytical Engine");
    EXPECT_EQ(makes(cache, settings), 2u);
    HairCache other = onDisk("Difference Engine");
    EXPECT_EQ(makes(other, settings), 2u);
    HairCache again = onDisk("Analytical Engine");
    EXPECT_EQ(makes(again, settings), 0u);
}

// A mesh file that is edited keeps its name, so the settings stay the same.
TEST_F(HairCacheTest, AnEditedMeshOfAFieldIsAnother) {
    const hair::Settings settings = settledCase(hair::Solver::shape);
    scene::AssetStore assets;
    const hair::groom::Groom groom = assets.groom(settings, kScenes);
    std::vector<hair::groom::Mesh> meshes =
        scene::loadFieldMeshes(settings, scene::loadMesh(settings, kScenes), kScenes);
    const auto made = [&] {
        HairCache fresh = onDisk();
        fresh.simulation(device(), groom, settings, meshes);
        return fresh.made();
    };
    EXPECT_EQ(made(), 2u);
    EXPECT_EQ(made(), 0u);
    meshes.at(0).positions.at(0).y += 1e-3f;
    EXPECT_EQ(made(), 2u);
    EXPECT_EQ(made(), 0u);
}

// A tetrahedron without one face, as large as the head.
TEST_F(HairCacheTest, FieldsKeepWhatIsOddAboutTheirMesh) {
    hair::Settings settings = settledCase(hair::Solver::shape);
    const TemporaryFolder meshes;
    settings.simulation.distance_fields[0].mesh =
        meshes
            .write(
                "open.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n")
            .string();
    const auto warnings = [&](HairCache* cache) {
        return Case(device(), settings, kScenes, cache).warnings();
    };
    const std::vector<std::string> expected = warnings(nullptr);
    ASSERT_EQ(expected.size(), 1u);
    EXPECT_EQ(expected[0].find("/simulation/distance_fields/0: the surface is not closed"), 0u);
    HairCache cache = onDisk();
    EXPECT_EQ(warnings(&cache), expected);
    EXPECT_EQ(warnings(&cache), expected);
    HairCache other = onDisk();
    EXPECT_EQ(warnings(&other), expected);
    EXPECT_EQ(other.made(), 0u);
}

TEST_F(HairCacheTest, DamagedEntriesAreMadeAnew) {
    const hair::Settings settings = settledCase(hair::Solver::shape);
    HairCache first = onDisk();
    const Shown expected = shown(settings, &first);
    std::size_t entries = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        std::filesystem::resize_file(entry.path(), entry.file_size() - 1);
        ++entries;
    }
    ASSERT_EQ(entries, 2u);
    HairCache later = onDisk();
    EXPECT_EQ(shown(settings, &later), expected);
    EXPECT_EQ(later.made(), 2u);
    EXPECT_THAT(faults_, SizeIs(2));
    HairCache mended = onDisk();
    EXPECT_EQ(makes(mended, settings), 0u);
}

TEST_F(HairCacheTest, MakesAMeshAndAGroomOnce) {
    scene::AssetStore assets;
    hair::Settings settings = settledCase(hair::Solver::shape);
    const hair::groom::Groom* const groom = &assets.groom(settings, kScenes);
    const auto* const mesh = &assets.mesh(settings, kScenes);
    settings.strands.density = 7;
    EXPECT_EQ(&assets.groom(settings, kScenes), groom);
    EXPECT_EQ(&assets.mesh(settings, kScenes), mesh);
    settings.groom.guides = 30;
    EXPECT_NE(&assets.groom(settings, kScenes), groom);
    EXPECT_EQ(&assets.mesh(settings, kScenes), mesh);
    settings.render.head = false;  // a mesh without pictures
    EXPECT_NE(&assets.mesh(settings, kScenes), mesh);
}

}  // namespace
}  // namespace benchmarks::measure
