// Tests functions that a scene supplies, on the device: docs/extending.md.
#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "benchmarks/scene/scene.h"
#include "engine/files.h"
#include "engine/pipeline.h"
#include "engine/run_tool.h"
#include "engine/shaders.h"
#include "hair/extension.h"
#include "hair/rendering/renderer.h"
#include "hair/simulation/simulation.h"
#include "tests/error_text.h"
#include "tests/flip_errors.h"
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
          Backend::software, Backend::lines, Backend::mesh, Backend::rays}) {
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
            EXPECT_TRUE(
                backend == Backend::mesh || backend == Backend::lines || backend == Backend::rays)
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

// ---- Curves of strands --------------------------------------------------------------------------

class CurveExtensions : public GpuTest {
protected:
    static StrandSettings curvedBy(const std::string& text) {
        StrandSettings strands{.density = 3, .tessellation = 4};
        strands.curve = Curve::extension;
        strands.curve_file = "test.glsl";
        strands.curve_parameters = read(ExtensionKind::curve, text);
        return strands;
    }
    static StrandSettings helices() {
        StrandSettings strands = curvedBy(textOf(HAIRBENCH_SCENES_DIR "/extended/helix.glsl"));
        strands.curve_parameters.values = {
            {"least_turn", false, glm::vec3(3.0f)}, {"most_turn", false, glm::vec3(120.0f)}};
        return strands;
    }
    static rendering::StrandPoints
    evaluate(const groom::Groom& groom, const StrandSettings& strands) {
        const rendering::DeviceHair hair(device(), groom);
        return rendering::evaluateStrandPoints(device(), {.strands = strands}, hair.view());
    }

    // Point i of a helix of radius 1 cm about y that turns by 50 degrees and falls by 4 mm from
    // each vertex to the next; i may be between two.
    static glm::dvec3 onHelix(double i) {
        const double angle = i * 50.0 / 180.0 * 3.14159265358979;
        return {0.01 * std::cos(angle), -0.004 * i, 0.01 * std::sin(angle)};
    }
    static constexpr std::uint32_t kVertices = 10;
    static groom::Groom helix() {
        std::vector<glm::vec3> points;
        for (std::uint32_t i = 0; i < kVertices; ++i) points.emplace_back(onHelix(i));
        return rendering::oneTriangle(points);
    }
    // Greatest distance of a strand from the helix in segments `first` to `last`, m.
    static double
    farthest(const rendering::StrandPoints& points, std::uint32_t first, std::uint32_t last) {
        double farthest = 0.0;
        for (std::uint32_t segment = first; segment <= last; ++segment)
            for (std::uint32_t i = 0; i <= 4; ++i)
                farthest = std::max(
                    farthest, glm::distance(
                                  glm::dvec3(points.at(0, 1, segment, i).position),
                                  onHelix(segment + i / 4.0)));
        return farthest;
    }
};

constexpr const char* kCatmullRom = R"(
HairCurvePoint curveHair(HairSegment s, float t) {
    vec3 slope = 0.5 * (s.to - s.before);
    vec3 square = 0.5 * (2.0 * s.before - 5.0 * s.from + 4.0 * s.to - s.after);
    vec3 cube = 0.5 * (3.0 * (s.from - s.to) + s.after - s.before);
    return HairCurvePoint(
        s.from + t * (slope + t * (square + t * cube)), slope + t * (2.0 * square + 3.0 * t * cube));
}
)";

// The program's own curve is the reference. Both round about ten numbers of up to 0.3 m.
TEST_F(CurveExtensions, CatmullRomByAFileIsCatmullRom) {
    const groom::Groom groom = rendering::uprightGroom();
    for (const groom::Groom& each : {groom, helix()}) {
        StrandSettings strands = curvedBy(kCatmullRom);
        const auto by_file = evaluate(each, strands);
        strands.curve = Curve::catmull_rom;
        strands.curve_parameters = {};
        const auto built_in = evaluate(each, strands);
        ASSERT_EQ(by_file.records.size(), built_in.records.size());
        for (std::size_t i = 0; i < by_file.records.size(); ++i) {
            EXPECT_LT(
                glm::distance(by_file.records[i].position, built_in.records[i].position), 3e-7f);
            EXPECT_LT(
                glm::distance(by_file.records[i].tangent, built_in.records[i].tangent), 3e-7f);
            EXPECT_EQ(by_file.records[i].along, built_in.records[i].along);
            EXPECT_EQ(by_file.records[i].width, built_in.records[i].width);
        }
    }
}

// The end segments have a mirrored vertex, which is not of the helix; they are arcs of circles. A
// Catmull-Rom curve leaves a circle of radius r that turns by a from point to point by r (1 - (9
// cos(a / 2) - cos(3 a / 2)) / 8) in the middle of a segment, 1.2 % at 50 degrees. Second
// differences of 7 mm round by 1e-9 m, and the axis turns by 1e-6 or so: positions by 3e-8 m.
TEST_F(CurveExtensions, HelicesGoThroughAllOfAHelix) {
    StrandSettings strands = helices();
    const auto points = evaluate(helix(), strands);
    EXPECT_LT(farthest(points, 1, kVertices - 3), 2e-7);
    EXPECT_LT(farthest(points, 0, kVertices - 2), 1e-3);
    strands.curve = Curve::catmull_rom;
    strands.curve_parameters = {};
    EXPECT_GT(farthest(evaluate(helix(), strands), 1, kVertices - 3), 1e-4);
    // d position / d t of the helix, between vertices 4 and 5.
    const auto& middle = points.at(0, 1, 4, 2);
    const glm::dvec3 slope = (onHelix(4.5 + 1e-4) - onHelix(4.5 - 1e-4)) / 2e-4;
    EXPECT_LT(glm::distance(glm::dvec3(middle.tangent), slope), 1e-6);
}

// Vertices without any order, and those of a straight line.
TEST_F(CurveExtensions, HelicesMeetInEveryVertex) {
    for (const groom::Groom& groom : {rendering::tangledGroom(8), rendering::uprightGroom()}) {
        StrandSettings strands = helices();
        const auto points = evaluate(groom, strands);
        strands.curve = Curve::catmull_rom;
        strands.curve_parameters = {};
        const auto known = evaluate(groom, strands);
        ASSERT_EQ(points.records.size(), known.records.size());
        for (std::size_t i = 0; i < points.records.size(); ++i) {
            ASSERT_LT(glm::length(points.records[i].tangent), 100.0f);
            if (i % 5 == 0 || i % 5 == 4) {
                EXPECT_LT(
                    glm::distance(points.records[i].position, known.records[i].position), 1e-6f)
                    << i;
            }
        }
    }
}

// No strand leaves the bounds by which it is culled.
TEST_F(CurveExtensions, StayBesideTheirSegment) {
    const groom::Groom groom =
        rendering::oneTriangle({{0.0f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.0f}, {0.0f, 0.3f, 0.0f}});
    const auto far = evaluate(groom, curvedBy(R"(
HairCurvePoint curveHair(HairSegment s, float t) {
    return HairCurvePoint(vec3(1e6, s.from.y, 0.0), vec3(0.0, float(s.number), float(s.count)));
}
)"));
    // The longest edge of both segments is 0.2 m.
    EXPECT_NEAR(far.at(0, 0, 0, 2).position.x, 0.2f, 1e-6f);
    EXPECT_NEAR(far.at(0, 0, 1, 2).position.x, 0.2f, 1e-6f);
    EXPECT_EQ(far.at(0, 0, 1, 2).tangent, glm::vec3(0.0f, 1.0f, 2.0f));
    for (const char* const value : {"vec3(t) / 0.0", "vec3(0.0) / 0.0", "vec3(3e38) * 3.0"}) {
        const auto wrong = evaluate(
            groom, curvedBy(
                       "HairCurvePoint curveHair(HairSegment s, float t) { vec3 v = " +
                       std::string(value) + "; return HairCurvePoint(v, v); }\n"));
        EXPECT_LT(glm::distance(wrong.at(0, 0, 1, 2).position, glm::vec3(0.0f, 0.2f, 0.0f)), 1e-6f)
            << value;
        EXPECT_LT(glm::distance(wrong.at(0, 0, 1, 2).tangent, glm::vec3(0.0f, 0.2f, 0.0f)), 1e-6f)
            << value;
    }
}

TEST_F(CurveExtensions, LoopsThatNeverEndEnd) {
    const auto points = evaluate(rendering::uprightGroom(), curvedBy(R"(
HairCurvePoint curveHair(HairSegment s, float t) {
    float count = 0.0;
    while (true) count += 1.0;
    return HairCurvePoint(s.from, vec3(count / 4096.0, 0.0, 0.0));
}
)"));
    for (const auto& record : points.records) EXPECT_EQ(record.tangent.x, 1.0f);
}

// The shipped scene. Bounds as for the program's own curves: an edge in a thousand pixels, and mean
// FLIP errors by the back ends that draw from points (docs/rendering.md).
TEST_F(CurveExtensions, AreDrawnAlikeByEveryBackEnd) {
    Settings settings =
        benchmarks::scene::loadScene(HAIRBENCH_SCENES_DIR "/extended/helix.json").settings;
    settings.simulation.settle_steps = 0;
    settings.render.width = 480;
    settings.render.height = 270;
    settings.render.ssaa = settings.render.msaa = 1;
    const auto draw = [&](const Settings& drawn) {
        benchmarks::measure::Case played(device(), drawn, HAIRBENCH_SCENES_DIR "/extended");
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        loop.frame([&](engine::Passes& passes) { played.frame(passes); });
        loop.finish();
        return played.picture();
    };
    const Pixels expected = draw(rendering::with(settings, Backend::tessellation));
    Settings spline = settings;
    spline.strands.curve = Curve::bspline;
    spline.strands.curve_file.clear();
    spline.strands.curve_parameters = {};
    EXPECT_GT(
        rendering::differingPixels(expected, draw(rendering::with(spline, Backend::tessellation))),
        2000u);
    for (const Backend backend : {Backend::pulling_geometry, Backend::pulling})
        EXPECT_LE(
            rendering::differingPixels(expected, draw(rendering::with(settings, backend))),
            480u * 270u / 1000u)
            << backendName(backend);
    if (pythonInterpreter().empty()) return;
    const TemporaryFolder folder;
    const auto written = [&](Backend backend) {
        const Settings drawn = rendering::with(settings, backend);
        return rendering::writePicture(
            folder.file(std::string(backendName(backend)) + ".png"), drawn, draw(drawn));
    };
    const auto reference = written(Backend::tessellation);
    const std::vector<double> errors = flipErrors(
        {{reference, written(Backend::expanded)}, {reference, written(Backend::software)}});
    EXPECT_LE(errors[0], 0.005);
    EXPECT_LE(errors[1], 0.02);
}

// A curve and an offset are linked into the same shaders.
TEST_F(CurveExtensions, ShareShadersWithOffsets) {
    const auto moved = [&](const std::string& name) {
        Settings settings{
            .strands = curvedBy(
                "// @parameter " + name +
                " 0.03 [0, 1] m: x\nHairCurvePoint curveHair(HairSegment s, float t) {\n"
                "    return HairCurvePoint(mix(s.from, s.to, t) + vec3(" +
                name + ", 0., 0.), s.to - s.from);\n}\n")};
        settings.strands.curve_parameters.values = {{name, false, glm::vec3(0.004f)}};
        settings.strands.offset_function = "other.glsl";
        settings.strands.offset_parameters = read(
            ExtensionKind::offset,
            "// @parameter reach 0.02 [0, 1] m: most\n"
            "vec3 offsetHair(HairPlace place) { return vec3(0.0, 0.0, reach); }\n",
            {{"reach", false, glm::vec3(0.01f)}});
        const rendering::DeviceHair hair(device(), rendering::uprightGroom(), settings);
        return rendering::evaluateStrandPoints(device(), settings, hair.view());
    };
    const auto unmoved = evaluate(rendering::uprightGroom(), {.density = 3, .tessellation = 4});
    const glm::vec3 by = moved("aside").at(0, 1, 3, 2).position - unmoved.at(0, 1, 3, 2).position;
    EXPECT_LT(glm::distance(by, glm::vec3(0.004f, 0.01f, 0.0f)), 1e-6f);
}

TEST_F(CurveExtensions, AFileThatWasNotReadIsAnError) {
    StrandSettings strands;
    strands.curve = Curve::extension;
    EXPECT_EQ(
        errorText([&] { evaluate(helix(), strands); }),
        "/strands/curve: names a file that was not read");
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

// ---- Solvers ------------------------------------------------------------------------------------

class SolverExtensions : public GpuTest {
protected:
    static SimulationSettings with(SimulationSettings settings, const std::string& text) {
        settings.solver = Solver::extension;
        settings.solver_file = "test.glsl";
        settings.solver_parameters = read(ExtensionKind::solver, text);
        return settings;
    }

    static std::vector<glm::vec3>
    after(const groom::Groom& groom, const SimulationSettings& settings, int steps) {
        simulation::Simulation moved(device(), groom, settings, 1);
        simulation::advance(device(), moved, steps);
        return moved.readPositions();
    }
};

// Follow the leader, written against the interface alone: the program's own `ftl` is the reference,
// without the two parts that the file leaves out. It also pushes vertices out of bodies once, so
// the program's push afterwards finds nothing but rounding. Both round differently, by less than
// 1e-7 m a step.
TEST_F(SolverExtensions, FollowTheLeaderByAFileIsFollowTheLeader) {
    const char* const text = R"(
void solveGuide(Guide guide) {
    vec3 leader = guidePosition(0u);
    for (uint v = 1u; v < guide.vertices; ++v) {
        vec3 edge = guidePredicted(v) - leader;
        leader = outOfBodies(v, leader + guideRestLength(v) / length(edge) * edge);
        setGuidePosition(v, leader);
    }
}
)";
    const groom::Groom groom = simulation::wavyGroom(70, 12);
    SimulationSettings own;
    own.solver = Solver::ftl;
    own.ftl.velocity_correction = 0.0f;
    own.global.stiffness = 0.0f;
    own.substeps = 3;
    own.colliders = {{.a = {0.0f, -0.05f, 0.0f}, .b = {0.1f, -0.05f, 0.0f}, .radius = 0.04f}};
    own.collision.friction = 0.3f;
    own.motion.keyframes = {
        {.time = 0.0f}, {.time = 0.2f, .rotation = {20, 30, 0}, .translation = {0.05f, 0, 0}}};
    for (const WindMode mode : {WindMode::thesis, WindMode::drag}) {
        own.wind.mode = mode;
        own.wind.strength = 8.0f;
        own.wind.speed = 3.0f;
        simulation::Simulation built_in(device(), groom, own, 1);
        simulation::Simulation by_file(device(), groom, with(own, text), 1);
        simulation::advance(device(), built_in, 15);
        simulation::advance(device(), by_file, 15);
        EXPECT_GT(largestDifference(built_in.readPositions(), groom.points), 0.02);
        EXPECT_LT(largestDifference(by_file.readPositions(), built_in.readPositions()), 1e-4);
        EXPECT_EQ(by_file.readContacts(), built_in.readContacts());
        EXPECT_GT(std::ranges::count(by_file.readContacts(), true), 10);
    }
}

// x = sum of 0.001 m n over the substeps n = 1, 2, ...: exact if the file's count survives.
TEST_F(SolverExtensions, RememberWhatTheyWrote) {
    const groom::Groom groom = simulation::straightGroom(3, 4);
    SimulationSettings settings = with(simulation::nothingActs(), R"(
void solveGuide(Guide guide) {
    for (uint v = 1u; v < guide.vertices; ++v)
        for (uint place = 0u; place < 5u; ++place) {
            vec4 count = guideMemory(v, place) + vec4(float(place), 1.0, 0.0, 0.0);
            setGuideMemory(v, place, count);
            if (place == 3u) setGuidePosition(v, guideBefore(v) + vec3(0.001 * count.y, 0.0, 0.0));
            if (place == 4u && guideMemory(v, place) != vec4(0.0)) setGuidePosition(v, vec3(9.0));
        }
    setGuideMemory(guide.vertices, 0u, vec4(1e6));
}
)");
    settings.substeps = 2;
    settings.settle_steps = 1;
    simulation::Simulation moved(device(), groom, settings, 1);
    const auto at = [&](std::size_t vertex) {
        return double{moved.readPositions()[vertex].x} - double{groom.points[vertex].x};
    };
    simulation::advance(device(), moved, 4);
    EXPECT_NEAR(at(2), 0.001 * 10 * 11 / 2, 1e-6);
    EXPECT_NEAR(at(11), 0.001 * 10 * 11 / 2, 1e-6);
    moved.reset();
    simulation::advance(device(), moved, 4);
    EXPECT_NEAR(at(2), 0.001 * 10 * 11 / 2, 1e-6);
    moved.setState(groom.points, groom.points);
    simulation::advance(device(), moved, 1);
    EXPECT_NEAR(at(2), 0.003, 1e-6);
}

TEST_F(SolverExtensions, CannotMoveWhatIsHeldOrNotTheirs) {
    const groom::Groom groom = simulation::straightGroom(3, 4);
    simulation::Simulation moved(
        device(), groom, with(simulation::nothingActs(), R"(
void solveGuide(Guide guide) {
    for (uint v = 0u; v < 9u; ++v) setGuidePosition(v, vec3(float(guide.number), 7.0, 0.0));
    setGuidePosition(4294967295u, vec3(5.0));
    if (guidePosition(guide.vertices) != vec3(0.0) || guideMass(77u) != 0.0 || !guideHeld(0u))
        setGuidePosition(1u, vec3(0.0));
}
)"),
        1);
    moved.pin(std::array{6u});
    simulation::advance(device(), moved, 2);
    const std::vector<glm::vec3> points = moved.readPositions();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % 4 == 0 || i == 6)
            EXPECT_EQ(points[i], groom.points[i]) << i;
        else
            EXPECT_EQ(points[i], glm::vec3(static_cast<float>(i / 4), 7.0f, 0.0f)) << i;
    }
}

// Reads every function: kinematics of a vertex on a parabola, and the settings.
TEST_F(SolverExtensions, KnowTheGuideItsMaterialAndTheHead) {
    const groom::Groom groom = simulation::straightGroom(2, 3, 0.05);
    SimulationSettings settings = simulation::nothingActs();
    settings.gravity = {0.0f, 0.0f, 3.0f};
    settings.friction = 0.1f;
    settings.material = {
        .density = 1000.0f,
        .radius = 1e-4f,
        .ellipticity = 1.5f,
        .youngs_modulus = 2e9f,
        .shear_modulus = 1e9f,
        .damping = 0.01f};
    settings.motion.keyframes = {{.time = 0.0f, .translation = {0.2f, 0.0f, 0.0f}}};
    settings = with(settings, R"(
bool near(float a, float b) { return abs(a - b) <= 1e-5 * abs(b); }
void solveGuide(Guide guide) {
    GuideMaterial m = guideMaterial();
    float mass = 1000.0 * 3.14159265 * 1e-8 * 0.05;
    bool known = near(m.density, 1000.0) && near(m.radius, 1e-4) && near(m.ellipticity, 1.5) &&
        near(m.youngs_modulus, 2e9) && near(m.shear_modulus, 1e9) && near(m.damping, 0.01);
    known = known && near(guideMass(0u), 0.5 * mass) && near(guideMass(1u), mass) &&
        near(guideMass(2u), 0.5 * mass) && near(guideRestLength(2u), 0.05);
    known = known && guide.vertices == 3u && near(guide.seconds, 1.0 / 60.0) &&
        near(guide.kept, 0.9) && guide.head.translation == vec3(0.2, 0.0, 0.0) &&
        guide.head.rotation == vec4(0.0, 0.0, 0.0, 1.0) && guide.head_before == guide.head;
    known = known && guideAcceleration(1u) == vec3(0.0, 0.0, 3.0) && guideYield(1u) == 1.0;
    known = known && distance(guideRest(2u), vec3(0.2 + 0.05 * float(guide.number), -0.1, 0.0)) < 1e-6;
    float random = guideRandom(guide, 1u);
    known = known && random >= 0.0 && random < 1.0 && random != guideRandom(guide, 2u);
    vec3 step = guidePredicted(1u) - guideBefore(1u);
    vec3 own = guide.seconds * (guide.kept * guideVelocity(1u) + guide.seconds * vec3(0, 0, 3));
    known = known && distance(step, own) < 1e-7;
    if (known) setGuidePosition(1u, guidePredicted(1u));
}
)");
    constexpr int kSteps = 6;
    double z = 0.0, moved = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        moved = 0.9 * moved + 3.0 / 3600.0;
        z += moved;
    }
    EXPECT_NEAR(after(groom, settings, kSteps)[4].z, z, 1e-6);
}

// A call has 32,768 turns. Floats count to 2^24.
TEST_F(SolverExtensions, LoopsThatNeverEndEnd) {
    const groom::Groom groom = simulation::straightGroom(1, 2);
    const auto moved = after(
        groom, with(simulation::nothingActs(), R"(
void solveGuide(Guide guide) {
    float count = 0.0;
    while (true) count += 1.0;
    setGuidePosition(1u, vec3(count / 32768.0, 0.0, 0.0));
}
)"),
        1);
    EXPECT_EQ(moved[1].x, 1.0f);
}

// By default a step is one substep; a file's parameter chooses more.
TEST_F(SolverExtensions, ChooseTheirSubsteps) {
    SimulationSettings settings = with(
        {}, "// @parameter longest_substep 0.004 [0.0001, 0.1] s: x\nvoid solveGuide(Guide guide) "
            "{}\n");
    settings.solver_parameters.values = {{"longest_substep", false, glm::vec3(0.004f)}};
    EXPECT_EQ(simulation::stepOf(settings).count, 5u);
    settings.solver_parameters.values = {{"longest_substep", false, glm::vec3(0.1f)}};
    EXPECT_EQ(simulation::stepOf(settings).count, 1u);
    settings.substeps = 3;
    EXPECT_EQ(simulation::stepOf(settings).count, 3u);
}

TEST_F(SolverExtensions, AFileThatWasNotReadIsAnError) {
    SimulationSettings settings;
    settings.solver = Solver::extension;
    settings.solver_file = "test.glsl";
    EXPECT_EQ(
        errorText([&] { after(simulation::straightGroom(1, 3), settings, 1); }),
        "/simulation/solver: names a file that was not read");
}

}  // namespace
}  // namespace hair
