#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/acceleration.h"
#include "hair/rendering/rays_backend.h"
#include "tests/flip_errors.h"
#include "tests/gpu_fixture.h"
#include "tests/probe_shaders.h"
#include "tests/rendering/pictures.h"
#include "tests/required.h"

// The back end `rays`: its pictures against those of `tessellation`, which draws the same quads
// with the rasteriser, and of `software`, which has the same shading.
namespace hair::rendering {
namespace {

namespace fs = std::filesystem;

// ---- A ray through a round piece ----------------------------------------------------------------

using gpu::RoundConeProbe;

static_assert(offsetof(RoundConeProbe, enters) == 56 && sizeof(RoundConeProbe) == 64);

struct Chord {
    double enters;
    double leaves;
};

// Returns the least value of a convex function.
template <class Function>
double least(Function&& value, double from, double to) {
    constexpr double kGolden = 0.6180339887498949;
    for (int i = 0; i < 100; ++i) {
        const double a = to - kGolden * (to - from);
        const double b = from + kGolden * (to - from);
        (value(a) < value(b) ? to : from) = value(a) < value(b) ? b : a;
    }
    return std::min(value(from), value(to));
}

// The chord of the balls with middles and radii linear in s from 0 to 1, each `more` larger, in
// double precision and without the equation of a cone. A point t of the ray is in ball s if |o + t
// d
// - c(s)| <= r(s). The left side is convex in (s, t) and the right side is linear, so these (s, t)
// are a convex set, and the least t of a ball is a convex function of s.
std::optional<Chord> referenceChord(const RoundConeProbe& probe, double more) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(probe.direction));
    const glm::dvec3 from = glm::dvec3(probe.from) - glm::dvec3(probe.origin);
    const glm::dvec3 axis = glm::dvec3(probe.to) - glm::dvec3(probe.from);
    const double radius = probe.from_radius + more;
    const double widening = double{probe.to_radius} - probe.from_radius;
    const glm::dvec3 beside = glm::cross(direction, from);
    const glm::dvec3 turning = glm::cross(direction, axis);
    // The square of half a ball's chord: a + b s + c s^2.
    const double a = radius * radius - glm::dot(beside, beside);
    const double b = 2.0 * (radius * widening - glm::dot(beside, turning));
    const double c = widening * widening - glm::dot(turning, turning);
    const auto half = [&](double s) { return std::sqrt(std::max(a + s * (b + s * c), 0.0)); };
    const auto middle = [&](double s) { return glm::dot(from + s * axis, direction); };
    std::vector<double> bounds{0.0, 1.0};
    if (const double root = b * b - 4.0 * a * c; root >= 0.0) {
        const double sum = -0.5 * (b + std::copysign(std::sqrt(root), b));
        for (const double s : {sum / c, a / sum})
            if (s > 0.0 && s < 1.0) bounds.push_back(s);
    }
    std::ranges::sort(bounds);
    std::optional<Chord> chord;
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
        const double inside = 0.5 * (bounds[i] + bounds[i + 1]);
        if (radius + std::min(widening, 0.0) < 0.0 || a + inside * (b + inside * c) < 0.0) continue;
        const Chord part{
            .enters =
                least([&](double s) { return middle(s) - half(s); }, bounds[i], bounds[i + 1]),
            .leaves =
                -least([&](double s) { return -middle(s) - half(s); }, bounds[i], bounds[i + 1])};
        if (!chord) chord = part;
        chord->enters = std::min(chord->enters, part.enters);
        chord->leaves = std::max(chord->leaves, part.leaves);
    }
    return chord;
}

class RoundCone : public GpuTest {
protected:
    static std::vector<RoundConeProbe> asked(const std::vector<RoundConeProbe>& probes) {
        const engine::Buffer buffer =
            engine::makeBuffer(device(), probes, "round cone probes", "tests");
        probe_shaders::addTo(device());
        const engine::ComputePipeline pipeline(
            device(),
            {.shader = "probe_round_cone.comp", .push_size = sizeof(gpu::RoundConeProbePush)});
        const gpu::RoundConeProbePush push{
            .probes = buffer.address(), .count = static_cast<std::uint32_t>(probes.size())};
        runOnce(device(), [&](engine::Commands& commands) {
            commands.bind(pipeline, push);
            commands.dispatchInvocations(push.count, 64);
        });
        return engine::downloadAs<RoundConeProbe>(device(), buffer);
    }
};

// Rays from up to 1 m to pieces of hair, from every side, some almost along them; pieces of no
// length, of equal radii, with an end in the other, and with the ray's origin in them.
std::vector<RoundConeProbe> manyRays() {
    std::mt19937 random(3);
    const auto number = [&] { return static_cast<float>(random() >> 8u) * 0x1p-24f; };
    const auto towards = [&] {
        glm::vec3 v(2.0f);
        while (glm::dot(v, v) > 1.0f || v == glm::vec3(0.0f))
            v = 2.0f * glm::vec3(number(), number(), number()) - 1.0f;
        return glm::normalize(v);
    };
    const auto between = [&](float low, float high) {
        return low * std::pow(high / low, number());
    };
    std::vector<RoundConeProbe> probes;
    for (int i = 0; i < 30000; ++i) {
        RoundConeProbe probe{};
        const glm::vec3 axis = towards();
        const float length = i % 16 == 0 ? 0.0f : between(1e-4f, 0.05f);
        probe.from = 0.2f * towards();
        probe.to = probe.from + length * axis;
        probe.from_radius = between(1e-5f, 2e-3f);
        probe.to_radius = i % 4 == 0 ? probe.from_radius : between(1e-5f, 2e-3f);
        const float place = 1.2f * number() - 0.1f;
        const float radius = glm::mix(probe.from_radius, probe.to_radius, place);
        const glm::vec3 target = glm::mix(probe.from, probe.to, place) +
                                 1.5f * number() * std::max(radius, 1e-5f) * towards();
        probe.direction =
            i % 8 == 1 ? glm::normalize(axis + between(1e-4f, 0.3f) * towards()) : towards();
        probe.origin = target - (i % 32 == 2 ? 0.0f : between(1e-3f, 1.0f)) * probe.direction;
        probes.push_back(probe);
    }
    return probes;
}

// Single precision keeps the place of a ray at `far` metres to some 2^-24 of it, and those of the
// piece likewise: the answer is that for a piece whose radii differ by as much.
TEST_F(RoundCone, IsMetWhereItsBallsAre) {
    std::size_t met = 0, missed = 0, grazed = 0;
    for (const RoundConeProbe& probe : asked(manyRays())) {
        const double far = 0.25 + glm::distance(probe.origin, probe.from);
        const double margin = 8.0 * kUlp * far;
        const std::optional<Chord> larger = referenceChord(probe, margin);
        const std::optional<Chord> smaller = referenceChord(probe, -margin);
        const bool is_met = probe.enters <= probe.leaves;
        if (!larger) {
            ++missed;
            EXPECT_FALSE(is_met);
            continue;
        }
        if (!smaller) {
            ++grazed;  // either answer
            if (!is_met) continue;
        }
        ASSERT_TRUE(is_met);
        met += smaller ? 1 : 0;
        EXPECT_GE(probe.enters, larger->enters - margin);
        EXPECT_LE(probe.leaves, larger->leaves + margin);
        if (!smaller) continue;
        EXPECT_LE(probe.enters, smaller->enters + margin);
        EXPECT_GE(probe.leaves, smaller->leaves - margin);
        if (HasFailure()) FAIL() << "one is enough";
    }
    EXPECT_GT(met, 15000u);
    EXPECT_GT(missed, 2000u);
    EXPECT_LT(grazed, 3000u);
}

// ---- Pictures -----------------------------------------------------------------------------------

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
    static void
    expectThatOfSoftware(Settings settings, RaysGeometry geometry, double most_different) {
        const Pixels expected = drawCase(device(), with(settings, Backend::software));
        const std::size_t hair = differingPixels(expected, drawBald(device(), settings));
        EXPECT_GT(hair, 600u);
        settings.strands.rays.geometry = geometry;
        const auto different = static_cast<double>(
            differingPixels(expected, drawCase(device(), with(settings, Backend::rays)), 2));
        EXPECT_LE(different, most_different * static_cast<double>(hair));
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
    // Most pixels that differ from those of `software` if pieces are round, over the hair's, and
    // the greatest error from `tessellation`. Round ends and full widths at bends are seen at few
    // edges.
    double most_round = 0.03;
    double round_error = 0.02;
};

// Everything that decides which quads there are, and how a sample is shaded.
constexpr std::array kKinds{
    Kind{"plain", [](Settings&) {}},
    Kind{"four samples", [](Settings& s) { s.render.msaa = 4; }},
    Kind{"linear light", [](Settings& s) { s.render.tone_map = ToneMap::aces; }},
    Kind{"supersampled", [](Settings& s) { s.render.ssaa = 2; }},
    Kind{"covered", [](Settings& s) { s.render.coverage = Coverage::analytic; }, 0.01, true},
    // The first ball of a segment is wider than the end of the segment before, and in front of it.
    Kind{"segments", [](Settings& s) { s.strands.taper = Taper::segment; }, 0.01, false, 0.1},
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
        },
        0.01, false, 0.2},
    Kind{"merged hairs", [](Settings& s) { s.lod = {.mode = LodMode::forced, .level = 1.3f}; }},
    Kind{
        "merged strips",
        [](Settings& s) {
            s.lod = {.mode = LodMode::forced, .level = 2.0f, .merged = MergedStrands::strip};
        }},
    // The sides of a quad cross on the screen if a curl points at the eye. `software` uncrosses
    // them, and triangles don't. Round, it is a disc.
    Kind{"curls", [](Settings& s) { s.strands.curl.radius = 0.01f; }, 0.1, false, 0.4},
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
        },
        // Strands of 2 mm are near the eye, and many point at it: they are discs.
        0.01, false, 0.25, 0.03},
};

TEST_F(RaysBackendPicture, IsThatOfSoftware) {
    for (const Kind& kind : kKinds) {
        SCOPED_TRACE(kind.name);
        Settings settings = small();
        kind.change(settings);
        expectThatOfSoftware(settings, RaysGeometry::triangles, kind.most_different);
    }
}

TEST_F(RaysBackendPicture, OfRoundPiecesIsNearlyThatOfSoftware) {
    for (const Kind& kind : kKinds) {
        SCOPED_TRACE(kind.name);
        Settings settings = small();
        kind.change(settings);
        expectThatOfSoftware(settings, RaysGeometry::boxes, kind.most_round);
    }
}

// `tessellation` shades a strand once per pixel, and this back end each sample at its own place:
// the same bound as for `software` (docs/rendering.md).
TEST_F(RaysBackendPicture, IsNearThatOfTessellation) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    std::vector<std::pair<fs::path, fs::path>> pairs;
    std::vector<std::string> names;
    std::vector<double> most;
    for (const Kind& kind : kKinds) {
        if (kind.is_widened) continue;
        Settings settings = small();
        kind.change(settings);
        const auto draw = [&](Backend backend, RaysGeometry geometry, const char* suffix) {
            settings.strands.rays.geometry = geometry;
            return write(
                kind.name + std::string(suffix), settings,
                drawCase(device(), with(settings, backend)));
        };
        const fs::path expected = draw(Backend::tessellation, RaysGeometry::triangles, " t");
        pairs.emplace_back(expected, draw(Backend::rays, RaysGeometry::triangles, " r"));
        pairs.emplace_back(expected, draw(Backend::rays, RaysGeometry::boxes, " b"));
        names.emplace_back(kind.name);
        names.emplace_back(kind.name + std::string(", round"));
        most.insert(most.end(), {0.02, kind.round_error});
    }
    const std::vector<double> errors = flipErrors(pairs);
    ASSERT_EQ(errors.size(), names.size());
    for (std::size_t i = 0; i < errors.size(); ++i) EXPECT_LE(errors[i], most[i]) << names[i];
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
    for (const RaysGeometry geometry : {RaysGeometry::triangles, RaysGeometry::boxes}) {
        settings.strands.rays.geometry = geometry;
        const Pixels built = lastOf(RaysUpdate::build, 20);
        EXPECT_GT(differingPixels(built, lastOf(RaysUpdate::build, 1)), 300u);
        // A ray on the edge that two triangles share takes either, and so does one where two round
        // pieces are equally near.
        EXPECT_LE(differingPixels(built, lastOf(RaysUpdate::refit, 20)), 5u);
    }
}

TEST_F(RaysBackendPicture, IsTheSameEveryTime) {
    Settings settings = with(small(), Backend::rays);
    for (const RaysGeometry geometry : {RaysGeometry::triangles, RaysGeometry::boxes}) {
        settings.strands.rays.geometry = geometry;
        const Pixels first = drawCase(device(), settings);
        for (int i = 0; i < 2; ++i)
            EXPECT_EQ(differingPixels(first, drawCase(device(), settings)), 0u);
    }
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
    for (const RaysGeometry geometry : {RaysGeometry::triangles, RaysGeometry::boxes})
        for (const RaysUpdate update : {RaysUpdate::build, RaysUpdate::refit}) {
            settings.strands.rays = {.geometry = geometry, .update = update};
            EXPECT_EQ(differingPixels(drawGroom(device(), settings, behind, nullptr), empty), 0u);
            EXPECT_EQ(differingPixels(drawGroom(device(), settings, none, nullptr), empty), 0u);
            EXPECT_GT(differingPixels(drawGroom(device(), settings, before, nullptr), empty), 50u);
        }
}

// 28 pieces a strand: two corners for each of their 29 points and two triangles for each, or a box
// of 32 bytes.
TEST_F(RaysBackendPicture, TellsItsMemory) {
    for (const RaysGeometry geometry : {RaysGeometry::triangles, RaysGeometry::boxes})
        for (const engine::Rebuild rebuild : {engine::Rebuild::anew, engine::Rebuild::refit}) {
            Settings settings = with(small(), Backend::rays);
            settings.strands.rays.geometry = geometry;
            if (rebuild == engine::Rebuild::refit) settings.strands.rays.update = RaysUpdate::refit;
            const benchmarks::measure::Case drawn(device(), settings, HAIRBENCH_SCENES_DIR);
            const auto strands = static_cast<std::uint32_t>(drawn.plan().strands());
            ASSERT_EQ(strands, 136u * 64);
            const std::map<std::string, std::uint64_t> bytes = device().resources().bytes();
            engine::PrimitiveSet primitives{.is_opaque = true, .rebuild = rebuild};
            if (geometry == RaysGeometry::boxes) {
                EXPECT_EQ(bytes.at("strand boxes"), strands * 28ull * 32);
                EXPECT_FALSE(bytes.contains("quad corners"));
                primitives.kind = engine::PrimitiveSet::Kind::boxes;
                primitives.count = strands * 28;
                primitives.box_stride = 32;
            } else {
                EXPECT_EQ(bytes.at("quad corners"), strands * 29ull * 2 * 12);
                EXPECT_EQ(bytes.at("quad triangles"), strands * 28ull * 2 * 12);
                primitives.count = strands * 28 * 2;
                primitives.vertices = strands * 29 * 2;
            }
            const engine::MemoryRows structure =
                engine::AccelerationStructure::rows(device(), primitives);
            for (const engine::MemoryRows::Row& row : structure.all())
                EXPECT_EQ(bytes.at(row.of.name), row.of.size) << row.of.name;
        }
}

}  // namespace
}  // namespace hair::rendering
