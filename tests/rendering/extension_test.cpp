// Tests functions that a scene supplies, on the device: docs/extending.md.
#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "engine/files.h"
#include "engine/pipeline.h"
#include "engine/run_tool.h"
#include "engine/shaders.h"
#include "hair/extension.h"
#include "hair/rendering/renderer.h"
#include "hair/simulation/simulation.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/rendering/pictures.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/strands.h"
#include "tests/temporary_folder.h"

namespace hair {
namespace {

using rendering::Pixels;

ExtensionParameters
read(ExtensionKind kind, const std::string& text, std::vector<ExtensionValue> values = {}) {
    return {
        .values = std::move(values),
        .file = std::make_shared<const Extension>(parseExtension(kind, "test.glsl", text))};
}

// ---- Shading models -----------------------------------------------------------------------------

class ShadingExtensions : public GpuTest {
protected:
    // The thesis's hair without its head, small.
    static Settings hairAlone() {
        Settings settings = rendering::thesisAtRest();
        settings.groom.grow.mesh = HAIRBENCH_SCENES_DIR "/assets/head.glb";
        settings.strands.density = 8;
        settings.render.width = 128;
        settings.render.height = 72;
        settings.render.head = false;
        return settings;
    }

    Settings shadedBy(const std::string& text) const {
        folder_.write("mine.glsl", text);
        Settings settings = hairAlone();
        settings.shading.model = ShadingModel::extension;
        settings.shading.model_file = "mine.glsl";
        return settings;
    }

    Pixels draw(const Settings& settings) const {
        benchmarks::measure::Case drawn(device(), settings, folder_.path());
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        loop.frame([&](engine::Passes& passes) { drawn.frame(passes); });
        loop.finish();
        return drawn.picture();
    }

    using Color = std::array<int, 3>;
    static std::set<Color> colorsOf(const Pixels& pixels) {
        std::set<Color> colors;
        for (std::size_t i = 0; i < pixels.size(); i += 4)
            colors.insert({pixels[i], pixels[i + 1], pixels[i + 2]});
        return colors;
    }

    // The settings' background, 0.25, 0.15, 0.18, as 8 bits, rounded to nearest.
    static constexpr Color kBackground{64, 38, 46};

    TemporaryFolder folder_;
};

// 0.2, 0.6 and 1 are 51, 153 and 255 parts of 255.
TEST_F(ShadingExtensions, AConstantColourIsWhatHairShowsInEveryBackEnd) {
    Settings settings =
        shadedBy("vec3 shadeHair(HairPoint point) { return vec3(0.2, 0.6, 1.0); }\n");
    std::size_t covered = 0;
    for (const Backend backend :
         {Backend::tessellation, Backend::pulling_geometry, Backend::pulling, Backend::expanded,
          Backend::software, Backend::lines, Backend::mesh}) {
        settings.strands.backend = backend;
        try {
            const Pixels pixels = draw(settings);
            EXPECT_EQ(colorsOf(pixels), (std::set<Color>{kBackground, {51, 153, 255}}))
                << backendName(backend);
            if (backend == Backend::tessellation) {
                for (std::size_t i = 0; i < pixels.size(); i += 4) covered += pixels[i] == 51;
                Settings phong = hairAlone();
                const Pixels other = draw(phong);
                for (std::size_t i = 0; i < pixels.size(); i += 4)
                    ASSERT_EQ(
                        pixels[i] == 51,
                        Color({other[i], other[i + 1], other[i + 2]}) != kBackground)
                        << "pixel " << i / 4;
            }
        } catch (const engine::Unsupported&) {
            EXPECT_TRUE(backend == Backend::mesh || backend == Backend::lines)
                << backendName(backend);
        }
    }
    EXPECT_GT(covered, 200u);
}

// The thesis's equations (5) and (6), implemented in a file. A sum in another order rounds
// differently, by less than half of a step of 255, so the result differs by at most one step.
TEST_F(ShadingExtensions, PhongByAFileIsPhong) {
    Settings settings = shadedBy(R"(
vec3 shadeHair(HairPoint point) {
    vec3 sum = vec3(0.0);
    HairShading of = hairShading();
    for (uint i = 0u; i < lightCount(); ++i) {
        HairLight light = hairLight(point, i);
        float matt = dot(point.normal, light.to_light);
        vec3 mirrored = 2.0 * matt * point.normal - light.to_light;
        float glossy = matt > 0.0 ? pow(max(dot(point.to_eye, mirrored), 0.0), of.exponent) : 0.0;
        vec3 body = point.color * (of.ambient + of.diffuse * light.visible * max(matt, 0.0));
        sum += (body + of.specular * light.visible * glossy) * light.color;
    }
    return sum;
}
)");
    for (const Backend backend : {Backend::tessellation, Backend::software}) {
        settings.strands.backend = backend;
        settings.shading.shadows.hair =
            backend == Backend::software ? HairShadows::deep_opacity : HairShadows::none;
        const Pixels by_file = draw(settings);
        Settings own = settings;
        own.shading.model = ShadingModel::phong;
        own.shading.model_file.clear();
        const Pixels built_in = draw(own);
        int most = 0;
        for (std::size_t i = 0; i < by_file.size(); ++i)
            most = std::max(most, std::abs(int{by_file[i]} - int{built_in[i]}));
        EXPECT_LE(most, 1) << backendName(backend);
    }
}

TEST_F(ShadingExtensions, KnowsWhereOnAStrandItIsInEveryBackEnd) {
    Settings settings = shadedBy(
        "vec3 shadeHair(HairPoint point) { return point.along < 0.5 ? vec3(1.0, 0.0, 0.0) : "
        "vec3(0.0, 0.0, 1.0); }\n");
    std::vector<std::size_t> upper;
    for (const Backend backend : {Backend::tessellation, Backend::expanded, Backend::software}) {
        settings.strands.backend = backend;
        const Pixels pixels = draw(settings);
        EXPECT_EQ(colorsOf(pixels), (std::set<Color>{kBackground, {255, 0, 0}, {0, 0, 255}}));
        std::size_t red = 0;
        for (std::size_t i = 0; i < pixels.size(); i += 4) red += pixels[i] == 255;
        upper.push_back(red);
    }
    EXPECT_NEAR(upper[1], upper[0], 0.02 * upper[0]);
    EXPECT_NEAR(upper[2], upper[0], 0.02 * upper[0]);
}

// A call has 16,384 turns for all its loops (shaders/extension/turns.glsl). Floats count to 2^24,
// so the count divided by 16,384 is exact. lavapipe itself ends a loop after 65,535 turns.
TEST_F(ShadingExtensions, LoopsThatNeverEndEndInEveryBackEnd) {
    Settings settings = shadedBy(R"(
float turns() {
    float count = 0.0;
    for (int i = 0;; i = 0)
        while (true) /* a comment ( */ count += 1.0;
    return count;
}
vec3 shadeHair(HairPoint point) {
    float before = turns(), count = 0.0;
    do count += 1.0; while (point.width > 0.0 || (point.along >= 0.0));
    return vec3(before / 4096.0, 0.2 * count, 0.6);
}
)");
    for (const Backend backend : {Backend::tessellation, Backend::software}) {
        settings.strands.backend = backend;
        EXPECT_EQ(colorsOf(draw(settings)), (std::set<Color>{kBackground, {255, 51, 153}}))
            << backendName(backend);
    }
}

TEST_F(ShadingExtensions, ReadsItsParameters) {
    Settings settings = shadedBy("// @parameter gain 1 [0, 4] 1: factor\n"
                                 "// @parameter tint (0.2, 0.4, 0.6) [0, 1] 1: colour\n"
                                 "vec3 shadeHair(HairPoint point) { return gain * tint; }\n");
    EXPECT_EQ(colorsOf(draw(settings)), (std::set<Color>{kBackground, {51, 102, 153}}));
    settings.shading.model_parameters.values = {{"gain", false, glm::vec3(2.0f)}};
    EXPECT_EQ(colorsOf(draw(settings)), (std::set<Color>{kBackground, {102, 204, 255}}));
    settings.shading.model_parameters.values = {{"tint", true, {0.0f, 1.0f, 0.2f}}};
    EXPECT_EQ(colorsOf(draw(settings)), (std::set<Color>{kBackground, {0, 255, 51}}));
}

// All run in one process: the text, not the name, distinguishes pipelines.
TEST_F(ShadingExtensions, TwoTextsOfOneNameGiveTwoPictures) {
    const std::string body = "vec3 shadeHair(HairPoint point) { return ";
    EXPECT_EQ(
        colorsOf(draw(shadedBy(body + "vec3(1.0, 0.0, 0.0); }\n"))),
        (std::set<Color>{kBackground, {255, 0, 0}}));
    EXPECT_EQ(
        colorsOf(draw(shadedBy(body + "vec3(0.0, 1.0, 0.0); }\n"))),
        (std::set<Color>{kBackground, {0, 255, 0}}));
}

TEST_F(ShadingExtensions, AFileThatWasNotReadIsAnError) {
    Settings settings = hairAlone();
    settings.shading.model = ShadingModel::extension;
    const groom::Groom groom = rendering::oneTriangle({{0, 0, 0}, {0, 1, 0}});
    EXPECT_EQ(
        errorText([&] { rendering::drawGroom(device(), settings, groom, nullptr); }),
        "/shading/model: names a file that was not read");
}

// ---- Offsets of strands -------------------------------------------------------------------------

class OffsetExtensions : public GpuTest {
protected:
    static rendering::StrandPoints evaluate(const std::string& text) {
        Settings settings{.strands = {.density = 8, .tessellation = 3}};
        if (!text.empty()) {
            settings.strands.offset_function = "test.glsl";
            settings.strands.offset_parameters =
                read(ExtensionKind::offset, "// @parameter reach 0.02 [0, 1] m: most\n" + text);
        }
        const rendering::DeviceHair hair(device(), rendering::uprightGroom(), settings);
        return rendering::evaluateStrandPoints(device(), settings, hair.view());
    }
};

// Coordinates of 0.3 m are rounded by 1.5e-8 m, a few times.
constexpr double kRounded = 1e-7;

TEST_F(OffsetExtensions, ShiftStrandsByWhatTheyReturn) {
    const auto straight = evaluate("");
    const auto moved =
        evaluate("vec3 offsetHair(HairPlace place) { return vec3(0.003, 0.004, 0.001); }\n");
    ASSERT_EQ(moved.records.size(), straight.records.size());
    for (std::size_t i = 0; i < moved.records.size(); ++i) {
        const glm::dvec3 by =
            glm::dvec3(moved.records[i].position) - glm::dvec3(straight.records[i].position);
        // The tangent is +y; normal and binormal are across it, with 0.003 and 0.004 m.
        EXPECT_NEAR(by.y, 0.001, kRounded);
        EXPECT_NEAR(glm::length(glm::dvec2(by.x, by.z)), 0.005, kRounded);
        EXPECT_LT(
            glm::distance(
                glm::dvec3(moved.records[i].tangent), glm::dvec3(straight.records[i].tangent)),
            kRounded);
    }
}

TEST_F(OffsetExtensions, AreCutToTheirReach) {
    const auto straight = evaluate("");
    for (const char* const value : {"vec3(0.0, 0.0, 5.0)", "vec3(0.0, 0.0, 1e12)"}) {
        const auto moved =
            evaluate("vec3 offsetHair(HairPlace place) { return " + std::string(value) + "; }\n");
        for (std::size_t i = 0; i < moved.records.size(); ++i)
            EXPECT_NEAR(
                moved.records[i].position.y - straight.records[i].position.y, 0.02, kRounded);
    }
    const auto unmoved = evaluate("vec3 offsetHair(HairPlace place) { return vec3(0.0) / 0.0; }\n");
    for (std::size_t i = 0; i < unmoved.records.size(); ++i)
        EXPECT_EQ(unmoved.records[i].position, straight.records[i].position);
}

// An offset of 0.015 m times the place turns strands by that over their length: 0.001 m in each of
// the 15 segments. Differences of 1/1024 of a length, rounded by 2^-24 of 0.015 m, leave an error
// of 1e-6.
TEST_F(OffsetExtensions, TurnStrandsByTheirSlope) {
    const auto straight = evaluate("");
    const auto moved = evaluate(
        "vec3 offsetHair(HairPlace place) { return vec3(0.015 * place.along, 0.0, 0.0); }\n");
    for (std::size_t i = 0; i < moved.records.size(); ++i) {
        const glm::dvec3 by =
            glm::dvec3(moved.records[i].tangent) - glm::dvec3(straight.records[i].tangent);
        EXPECT_NEAR(by.y, 0.0, 2e-6);
        EXPECT_NEAR(glm::length(by), 0.001, 2e-6);
    }
}

// Each strand has its own number, the same all along it and in every call.
TEST_F(OffsetExtensions, KnowStrandsApart) {
    const auto straight = evaluate("");
    const auto moved = evaluate("vec3 offsetHair(HairPlace place) { return vec3(0.0, 0.0, 0.01 * "
                                "hairRandom(place, 3u)); }\n");
    std::set<long> seen;
    for (std::uint32_t strand = 0; strand < 8; ++strand) {
        const auto by = [&](std::uint32_t segment) {
            return double{moved.at(0, strand, segment, 1).position.y} -
                   double{straight.at(0, strand, segment, 1).position.y};
        };
        EXPECT_NEAR(by(0), by(14), kRounded);
        seen.insert(std::lround(by(0) * 1e6));
    }
    EXPECT_GE(seen.size(), 7u);
}

// ---- The driver's compiler ----------------------------------------------------------------------

class ExtendedPipelines : public GpuTest {};

// Returns the page faults of all children that have ended.
long ofChildren() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return usage.ru_minflt;
}

// Pipelines without extensions need no child, and equal pipelines are made once.
TEST_F(ExtendedPipelines, AreMadeByAChildFirst) {
    const ExtensionParameters force = read(
        ExtensionKind::force,
        "vec3 accelerateGuide(GuidePoint point) { return point.velocity.yzx; }\n");
    engine::ComputeDescription description{
        .shader = "simulation/force.comp", .constants = {}, .push_size = 20};
    const engine::ComputePipeline own(device(), description);
    description.extensions = shaderExtensions(force);
    device().shaders().extended(description.shader, description.extensions);
    const long before = ofChildren();
    const engine::ComputePipeline extended(device(), description);
    const long after = ofChildren();
    EXPECT_GT(after, before);
    const engine::ComputePipeline again(device(), description);
    EXPECT_EQ(again.get(), extended.get());
    EXPECT_EQ(ofChildren(), after);
}

// A failure of the child is reported in one line.
TEST_F(ExtendedPipelines, TheChildSaysWhatIsWrong) {
    const std::string program = engine::helperProgram(engine::kPipelineTrial).string();
    EXPECT_EQ(
        errorText([&] { engine::runTool({program, device().info().name, "/dev/null"}); }),
        "the description of a pipeline is cut off");
    EXPECT_EQ(
        errorText([&] { engine::runTool({program, device().info().name}); }),
        "expected two arguments: a device and a file");
}

// ---- Forces on guides ---------------------------------------------------------------------------

class ForceExtensions : public GpuTest {
protected:
    static std::vector<glm::vec3>
    after(const groom::Groom& groom, const SimulationSettings& settings, int steps) {
        simulation::Simulation moved(device(), groom, settings, 1);
        simulation::advance(device(), moved, steps);
        return moved.readPositions();
    }

    static SimulationSettings with(SimulationSettings settings, const std::string& text) {
        settings.force = "test.glsl";
        settings.force_parameters = read(ExtensionKind::force, text);
        return settings;
    }
};

// Solvers add gravity and the accelerations. If one of them is 0, the sum is the same to the bit,
// and so are all results.
TEST_F(ForceExtensions, AConstantAccelerationIsGravity) {
    const groom::Groom groom = simulation::straightGroom(3, 8);
    for (const Solver solver : simulation::kSolvers) {
        SimulationSettings falling;
        falling.solver = solver;
        falling.gravity = {1.5f, -9.8f, 0.5f};
        SimulationSettings driven = with(
            falling, "vec3 accelerateGuide(GuidePoint point) { return vec3(1.5, -9.8, 0.5); }\n");
        driven.gravity = glm::vec3(0.0f);
        const auto fallen = after(groom, falling, 20);
        EXPECT_GT(largestDifference(fallen, groom.points), 1e-4) << static_cast<int>(solver);
        EXPECT_LT(largestDifference(after(groom, driven, 20), fallen), 1e-6)
            << static_cast<int>(solver);
    }
}

// Without other forces, the velocity of a free vertex is the sum of all previous accelerations,
// times the step. The accelerations are the times 0, dt, ... (n - 1) dt, so the velocity is n (n -
// 1) / 2 dt^2.
// The second force brakes with 1 / dt times the velocity and so ends the motion of the step
// before.
TEST_F(ForceExtensions, KnowTimeAndVelocity) {
    const groom::Groom groom = simulation::straightGroom(1, 3);
    const SimulationSettings free = simulation::nothingActs();
    const double dt = free.time_step;
    const auto timed = after(
        groom,
        with(
            free, "vec3 accelerateGuide(GuidePoint point) { return vec3(point.time, 0.0, "
                  "0.0); }\n"),
        10);
    double velocity = 0.0, place = 0.0;
    for (int step = 0; step < 10; ++step) {
        velocity += step * dt * dt;
        place += velocity * dt;
    }
    EXPECT_NEAR(timed[2].x - groom.points[2].x, place, 1e-6);
    EXPECT_EQ(timed[0], groom.points[0]);  // a root is held

    SimulationSettings falling = free;
    falling.gravity = {0.0f, -9.8f, 0.0f};
    const auto braked = after(
        groom,
        with(
            falling, "// @parameter rate 60 [0, 1000] 1/s: of the brake\n"
                     "vec3 accelerateGuide(GuidePoint point) { return -rate * "
                     "point.velocity; }\n"),
        10);
    EXPECT_NEAR(braked[2].y - groom.points[2].y, -10.0 * 9.8 * dt * dt, 1e-5);
}

TEST_F(ForceExtensions, DoNotActWhileHairSettles) {
    const groom::Groom groom = simulation::straightGroom(2, 4);
    SimulationSettings settings = simulation::nothingActs();
    settings.settle_steps = 5;
    EXPECT_EQ(
        after(
            groom, with(settings, "vec3 accelerateGuide(GuidePoint point) { return vec3(9.0); }\n"),
            0),
        groom.points);
}

}  // namespace
}  // namespace hair
