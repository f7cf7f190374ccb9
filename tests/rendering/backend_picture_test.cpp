#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "engine/shaders.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"

// Every back end and every way to split its draws gives the same picture: they draw the same lines
// in the same order with the same functions. On processors the pictures are equal bit for bit,
// except with `pulling`: a rasteriser rounds interpolated values differently if it gets the
// triangles in another way. `precise` doesn't reach dot products, roots and the logarithm of
// levels by distance. A GPU's compiler may round these differently in another stage, which moves
// an edge over a sample in a few places: one in a thousand pixels may differ.
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
    {"pulling", Backend::pulling, Submission::instanced},
};

class BackendPictureTest : public GpuTest {
protected:
    static std::size_t mostDiffering(const Settings& settings) {
        if (device().info().type == engine::DeviceType::cpu &&
            settings.strands.backend != Backend::pulling)
            return 0;
        return std::size_t{settings.render.width} * settings.render.height / 1000;
    }

    // The pictures show at least `hair` pixels of hair.
    static void expectEqualPictures(Settings settings, std::size_t hair) {
        settings.strands.backend = Backend::tessellation;
        settings.strands.submission = Submission::instanced;
        const Pixels instanced = drawCase(device(), settings);
        EXPECT_GT(differingPixels(instanced, drawBald(device(), settings)), hair);
        for (const Way& way : kOtherWays) {
            settings.strands.backend = way.backend;
            settings.strands.submission = way.submission;
            EXPECT_LE(
                differingPixels(instanced, drawCase(device(), settings)), mostDiffering(settings))
                << way.name;
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

// Without splitting it would be one draw of 304,640 vertices, 4.6 times as many as lavapipe's
// tessellator can index.
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

TEST_F(BackendPictureTest, AreEqualWhereClustersThinTheHair) {
    Settings settings = small();
    settings.strands.density = 100;
    const Pixels full = drawCase(device(), settings);
    settings.lod = {.mode = LodMode::cluster, .error = 20.0f};
    EXPECT_GT(differingPixels(drawCase(device(), settings), full), 1000u);
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

// ---- What their equality rests on ---------------------------------------------------------------

// The number of sums of a product that a compiler may fuse into one operation with one rounding:
// those without the decoration NoContraction. SPIR-V 1.6, 3.49.13 and 3.20.
std::size_t fusibleSums(std::span<const std::uint32_t> code) {
    constexpr std::uint32_t kDecorate = 71, kNoContraction = 42, kFunction = 54, kCall = 57,
                            kLoad = 61, kStore = 62, kNegate = 127, kAdd = 129, kSubtract = 131,
                            kMultiply = 133, kVectorTimesScalar = 142, kMatrixTimesScalar = 143,
                            kReturnValue = 254;
    std::set<std::uint32_t> exact;
    std::set<std::uint32_t> products;  // ids of values, variables and functions
    std::set<std::uint32_t> sums;
    for (int pass = 0; pass < 4; ++pass) {  // functions may be called before they are defined
        std::uint32_t function = 0;
        for (std::size_t at = 5; at < code.size(); at += code[at] >> 16) {
            const std::uint32_t operation = code[at] & 0xffff;
            const auto operand = [&](std::size_t i) { return code[at + 1 + i]; };
            const auto is_product = [&](std::size_t i) { return products.contains(operand(i)); };
            switch (operation) {
            case kDecorate:
                if (operand(1) == kNoContraction) exact.insert(operand(0));
                break;
            case kFunction:
                function = operand(1);
                break;
            case kMultiply:
            case kVectorTimesScalar:
            case kMatrixTimesScalar:
                products.insert(operand(1));
                break;
            case kNegate:
            case kLoad:
            case kCall:
                if (is_product(2)) products.insert(operand(1));
                break;
            case kStore:
                if (is_product(1)) products.insert(operand(0));
                break;
            case kReturnValue:
                if (is_product(0)) products.insert(function);
                break;
            case kAdd:
            case kSubtract:
                if (!exact.contains(operand(1)) && (is_product(2) || is_product(3)))
                    sums.insert(operand(1));
                break;
            default:
                break;
            }
        }
    }
    return sums.size();
}

// Position of a vertex is the built-in 0 of gl_PerVertex; decorations 11 and 18.
bool hasInvariantPosition(std::span<const std::uint32_t> code) {
    constexpr std::uint32_t kMemberDecorate = 72, kDecorate = 71, kBuiltIn = 11, kInvariant = 18;
    using Member = std::pair<std::uint32_t, std::uint32_t>;
    std::set<Member> positions;
    std::set<Member> invariant;
    for (std::size_t at = 5; at < code.size(); at += code[at] >> 16) {
        const std::uint32_t operation = code[at] & 0xffff;
        if (operation == kMemberDecorate) {
            const Member member{code[at + 1], code[at + 2]};
            if (code[at + 3] == kBuiltIn && code[at + 4] == 0) positions.insert(member);
            if (code[at + 3] == kInvariant) invariant.insert(member);
        }
        if (operation == kDecorate) {
            const Member variable{code[at + 1], ~0u};
            if (code[at + 2] == kBuiltIn && code[at + 3] == 0) positions.insert(variable);
            if (code[at + 2] == kInvariant) invariant.insert(variable);
        }
    }
    return std::ranges::any_of(
        positions, [&](const Member& each) { return invariant.contains(each); });
}

TEST(StrandShaders, PlaceStrandsWithoutSumsThatCompilersMayFuse) {
    for (const std::string_view path :
         {"strands/tessellation.tesc", "strands/tessellation.tese",
          "strands/tessellation.tese+watched", "strands/pulling_geometry.vert",
          "strands/evaluate.comp"})
        EXPECT_EQ(fusibleSums(engine::shaderCode(path)), 0u) << path;
    // The test can tell the difference: sums of colours may be fused.
    EXPECT_GT(fusibleSums(engine::shaderCode("strands/strand.frag")), 0u);
}

TEST(StrandShaders, ProjectAllVerticesAlike) {
    for (const std::string_view path :
         {"strands/strand.geom", "strands/strand.geom+watched", "strands/pulling.vert",
          "strands/strand.geom+shadow", "strands/pulling.vert+shadow", "scene/mesh.vert"})
        EXPECT_TRUE(hasInvariantPosition(engine::shaderCode(path))) << path;
    EXPECT_FALSE(hasInvariantPosition(engine::shaderCode("composite/screen.vert")));
}

// ---- Lines --------------------------------------------------------------------------------------

// A straight strand across the view. Only `lines` draws it as a line a pixel wide.
class LinesPicture : public GpuTest {
protected:
    static constexpr double kLength = 400.0;  // px

    // Pixels that the strand of this width (px) and direction (degrees) covers.
    static std::size_t covered(double width, double degrees) {
        constexpr double kPixel = 0.0005;  // m
        constexpr std::uint32_t kSide = 512;
        Settings settings;
        settings.strands.backend = Backend::lines;
        settings.strands.density = 1;
        settings.strands.root_width = settings.strands.tip_width =
            static_cast<float>(width * kPixel);
        settings.camera.position = {0.0f, 0.0f, 0.5f};
        settings.camera.field_of_view =
            static_cast<float>(glm::degrees(2.0 * std::atan(kPixel * kSide / 2.0 / 0.5)));
        settings.render.width = settings.render.height = kSide;
        settings.render.head = false;
        const double angle = glm::radians(degrees);
        const glm::vec3 end(
            0.5 * kLength * kPixel * std::cos(angle), 0.5 * kLength * kPixel * std::sin(angle),
            0.0);
        const groom::Groom groom = oneTriangle(std::vector{-end, glm::vec3(0.0f), end});
        Settings bald = settings;
        bald.render.hair = false;
        return differingPixels(
            drawGroom(device(), settings, groom, nullptr),
            drawGroom(device(), bald, groom, nullptr));
    }
};

// Strands cover pixels at random, each with the same chance, so that the count matches their area.
// At 45 degrees a line one pixel wide may cover one diagonal of pixels or two along its whole
// length.
TEST_F(LinesPicture, CoverTheAreaOfThinStrands) {
    for (const double width : {0.1, 0.3, 0.6}) {
        for (const double degrees : {0.0, 20.0, 40.0, 80.0, 130.0}) {
            const double area = kLength * width;
            EXPECT_NEAR(covered(width, degrees), area, 4.0 * std::sqrt(area))
                << width << " px, " << degrees << " degrees";
        }
    }
}

// Thesis 2.2: a line has one width, whatever the strand's.
TEST_F(LinesPicture, AreOnePixelWideWhereStrandsAreWider) {
    for (const double degrees : {0.0, 20.0, 45.0}) {
        // The bounds: one pixel per column, and all pixels that a rectangle one pixel wide touches.
        const double columns = kLength * std::cos(glm::radians(degrees));
        EXPECT_GE(covered(5.0, degrees), columns - 2.0) << degrees;
        EXPECT_LE(covered(5.0, degrees), kLength + 2.0) << degrees;
    }
}

// The pipeline's counts for a split density are equal to the plan's.
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
    if (device().info().type == engine::DeviceType::cpu) {
        EXPECT_EQ(patches, 136u * 7 * 2);
        EXPECT_EQ(evaluations, 136u * 7 * 100 * 4);
    }
    EXPECT_EQ(count("geometry_invocations"), 136u * 7 * 100 * 3);
    EXPECT_EQ(count("geometry_primitives"), 136u * 7 * 100 * 3 * 2);
}

}  // namespace
}  // namespace hair::rendering
