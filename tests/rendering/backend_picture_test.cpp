#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"

// Every back end and every way to split its draws gives the same picture, bit for bit: they draw
// the same lines in the same order with the same functions.
namespace hair::rendering {
namespace {

struct Way {
    const char* name;
    Backend backend;
    Submission submission;
};

constexpr Way kOtherWays[] = {
    {"batched", Backend::tessellation, Submission::batched},
    {"pulling_geometry", Backend::pulling_geometry, Submission::instanced},
};

class BackendPictureTest : public GpuTest {
protected:
    // The pictures show at least `hair` pixels of hair.
    static void expectEqualPictures(Settings settings, std::size_t hair) {
        settings.strands.backend = Backend::tessellation;
        settings.strands.submission = Submission::instanced;
        const Pixels instanced = drawCase(device(), settings);
        EXPECT_GT(differingPixels(instanced, drawBald(device(), settings)), hair);
        for (const Way& way : kOtherWays) {
            settings.strands.backend = way.backend;
            settings.strands.submission = way.submission;
            EXPECT_EQ(differingPixels(instanced, drawCase(device(), settings)), 0u) << way.name;
        }
    }

    // A sixteenth of the pixels, which leaves the tessellation as it is.
    static Settings small() {
        Settings settings = thesisAtRest();
        settings.render.width = 320;
        settings.render.height = 180;
        return settings;
    }
};

// Unsplit it would be one draw of 304,640 vertices, 4.6 times what lavapipe's tessellator can
// index.
TEST_F(BackendPictureTest, AreEqualAtTheThesissCase) {
    const benchmarks::measure::Case thesis(
        device(), thesisAtRest(), HAIRBENCH_SOURCE_DIR "/scenes");
    ASSERT_EQ(thesis.plan().patches() * thesis.plan().verticesPerPatch(), 304640u);
    ASSERT_GT(thesis.plan().patches() * thesis.plan().verticesPerPatch(), 65536u);
    // The head of 0.2 m and hair of 0.15 m round it fill over 100 px square at 604 px/m.
    expectEqualPictures(thesisAtRest(), 10000);
}

TEST_F(BackendPictureTest, AreEqualWhereATriangleTakesSeveralPatches) {
    Settings settings = small();
    settings.strands.density = 100;
    settings.strands.tessellation = 3;
    expectEqualPictures(settings, 625);
}

TEST_F(BackendPictureTest, AreEqualWithFourSamples) {
    Settings settings = small();
    settings.render.msaa = 4;
    if (!device().supportsSamples(4)) GTEST_SKIP() << "no 4-sample images";
    expectEqualPictures(settings, 625);
}

TEST_F(BackendPictureTest, AreEqualWhereDistanceThinsTheHair) {
    Settings settings = small();
    settings.strands.density = 100;  // some triangles leave their second patch empty
    settings.lod = {.mode = LodMode::distance, .near_distance = 0.4f, .far_distance = 0.8f};
    expectEqualPictures(settings, 625);
}

TEST_F(BackendPictureTest, AreEqualForThePublishedProgramsCurveAndTaper) {
    Settings settings = small();
    settings.strands.curve = Curve::bspline_unpinned;
    settings.strands.taper = Taper::segment;
    expectEqualPictures(settings, 625);
}

TEST_F(BackendPictureTest, TwoRunsAreEqual) {
    Settings settings = small();
    EXPECT_EQ(differingPixels(drawCase(device(), settings), drawCase(device(), settings)), 0u);
}

// What the pipeline counts of a split density is what the plan says.
TEST_F(BackendPictureTest, CountsAreThoseOfThePlan) {
    if (!device().hasPipelineStatistics()) GTEST_SKIP() << "no pipeline statistics";
    Settings settings = small();
    settings.strands.density = 100;
    settings.strands.tessellation = 3;
    benchmarks::measure::Case picture(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    engine::FrameLoop loop(device(), engine::Timing::statistics);
    loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
    const std::vector<engine::FrameRecord> records = loop.finish();
    const auto strands = std::ranges::find(
        records.at(0).statistics, std::string("strands"), &engine::PassStatistics::name);
    ASSERT_NE(strands, records.at(0).statistics.end());
    const auto count = [&](std::string_view name) {
        const auto at = std::ranges::find(engine::kStatisticNames, name);
        return strands->counts[static_cast<std::size_t>(at - engine::kStatisticNames.begin())];
    };
    // GPUs may run these stages more than once for a patch or a vertex.
    const std::uint64_t patches = count("tessellation_control_patches");
    const std::uint64_t evaluations = count("tessellation_evaluation_invocations");
    EXPECT_GE(patches, 136u * 7 * 2);
    EXPECT_GE(evaluations, 136u * 7 * 100 * 4);
    if (device().info().type == "cpu") {
        EXPECT_EQ(patches, 136u * 7 * 2);
        EXPECT_EQ(evaluations, 136u * 7 * 100 * 4);
    }
    EXPECT_EQ(count("geometry_invocations"), 136u * 7 * 100 * 3);
    EXPECT_EQ(count("geometry_primitives"), 136u * 7 * 100 * 3 * 2);
}

}  // namespace
}  // namespace hair::rendering
