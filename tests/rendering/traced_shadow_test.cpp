#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/rendering/renderer.h"
#include "tests/flip_errors.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/mesh_pictures.h"
#include "tests/rendering/pictures.h"
#include "tests/rendering/shadow_probe.h"
#include "tests/required.h"

// Shadows of hair by rays: counts of strands against a search of all pieces in double precision,
// and pictures against those of maps.
namespace hair::rendering {
namespace {

class TracedShadow : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (isOver()) return;
        if (!device().has(engine::Feature::ray_queries))
            return skipWithout(Need::rays, "the device has no ray queries");
    }
};

// ---- Strands on a line --------------------------------------------------------------------------

// The line of a light through a point: `origin` + t `direction`; the point is at t = 0.
struct Line {
    glm::dvec3 origin;
    glm::dvec3 direction;  // unit length
};

Line lineOf(const LightSettings& light, const glm::vec3& point) {
    const glm::dvec3 travels = light.type == LightType::directional
                                   ? glm::dvec3(light.direction)
                                   : glm::dvec3(point) - glm::dvec3(light.position);
    return {.origin = point, .direction = glm::normalize(travels)};
}

// The parameter where a line is nearest to a segment, if they are no farther apart than `radius`.
std::optional<double>
meets(const Line& line, const glm::dvec3& from, const glm::dvec3& to, double radius) {
    const auto across = [&](const glm::dvec3& v) {
        return v - glm::dot(v, line.direction) * line.direction;
    };
    const glm::dvec3 beside = across(from - line.origin);
    const glm::dvec3 turning = across(to - from);
    const double squared = glm::dot(turning, turning);
    const double s =
        squared > 0.0 ? std::clamp(-glm::dot(beside, turning) / squared, 0.0, 1.0) : 0.0;
    if (glm::length(beside + s * turning) > radius) return std::nullopt;
    return glm::dot(from + s * (to - from) - line.origin, line.direction);
}

struct Met {
    int before = 0;
    int behind = 0;
};

// Counts how often a line meets round strands of one width: neighbouring pieces that it meets are
// one strand.
Met countStrands(const StrandPoints& strands, const Line& line, double width) {
    Met met;
    const StrandPlan& plan = strands.plan;
    for (std::uint32_t triangle = 0; triangle < plan.triangles; ++triangle)
        for (std::uint32_t strand = 0; strand < plan.forced_density; ++strand) {
            std::optional<double> last;  // where the line met the piece before
            for (std::uint32_t segment = 0; segment < plan.segments; ++segment)
                for (std::uint32_t end = 0; end < plan.forced_tessellation; ++end) {
                    const auto place = [&](std::uint32_t point) {
                        return glm::dvec3(strands.at(triangle, strand, segment, point).position);
                    };
                    const std::optional<double> t =
                        meets(line, place(end), place(end + 1), 0.5 * width);
                    if (t && !last) ++(*t < 0.0 ? met.before : met.behind);
                    last = t;
                }
        }
    return met;
}

// Points in and round hair with strands of 2^-10 m, a width that points keep exactly. The device
// counts a piece where a ray is nearest to its axis, between its ends; the search counts strands.
// At a joint that turns by 2 a, pieces overlap on the inner side, and leave a gap on the outer one,
// over up to r tan(a) of the strand: with turns of up to 0.3 and pieces of 6 mm 1 %, as often twice
// as not at all. A ray has some two strands before and behind the point.
TEST_F(TracedShadow, CountsTheStrandsOnARay) {
    constexpr double kWidth = 0x1p-10;
    const groom::Groom groom = tangledGroom(12);
    Settings settings;
    settings.strands.backend = Backend::software;
    settings.strands.density = 120;
    settings.strands.tessellation = 6;
    settings.strands.root_width = settings.strands.tip_width = kWidth;
    settings.shading.shadows.hair = HairShadows::rays;
    settings.shading.shadows.stopped = 0.5f;
    // ended = exp(strands (ln a + a - 1)) with a = 1 - stopped.
    const double round_trip = std::log(0.5) + 0.5 - 1.0;
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<float>(random() >> 8u) * 0x1p-23f - 1.0f; };
    for (const LightType type : {LightType::directional, LightType::point}) {
        settings.shading.lights = {
            {.type = type, .position = {0.4f, 1.0f, 0.7f}, .direction = {-0.3f, -0.5f, -0.8f}}};
        const DeviceHair hair(device(), groom, settings);
        const StrandPoints strands = evaluateStrandPoints(device(), settings, hair.view());
        std::vector<glm::vec3> points;
        for (int i = 0; i < 600; ++i) {
            const gpu::StrandPointRecord& at = strands.records[random() % strands.records.size()];
            points.push_back(at.position + 0.02f * glm::vec3(number(), number(), number()));
        }
        const std::vector<FoundPath> paths = findPaths(device(), settings, hair.view(), {}, points);
        std::size_t different = 0;
        double before = 0.0, found_before = 0.0, behind = 0.0, found_behind = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Met met =
                countStrands(strands, lineOf(settings.shading.lights[0], points[i]), kWidth);
            const double ended = std::log(paths[i].ended) / round_trip;
            different += paths[i].strands != static_cast<float>(met.before) ||
                         std::abs(ended - met.behind) > 0.01;
            before += met.before;
            behind += met.behind;
            found_before += paths[i].strands;
            found_behind += ended;
            EXPECT_EQ(paths[i].direct, paths[i].strands == 0.0f ? 1.0f : 0.0f);
        }
        EXPECT_GT(before, 400.0);
        EXPECT_GT(behind, 400.0);
        EXPECT_LE(different, points.size() / 25) << static_cast<int>(type);
        EXPECT_NEAR(found_before, before, 0.01 * before);
        EXPECT_NEAR(found_behind, behind, 0.01 * behind);
    }
}

// ---- Pictures -----------------------------------------------------------------------------------

// Tangled hair before a white wall, lit from beside the eye.
Settings litTangle() {
    Settings settings = with({}, Backend::software);
    settings.render.width = settings.render.height = 160;
    settings.render.msaa = 4;
    settings.render.tone_map = ToneMap::srgb;
    settings.camera.position = {0.0f, 0.05f, 0.8f};
    settings.camera.field_of_view = 28.0f;
    settings.strands.density = 60;
    settings.strands.root_width = settings.strands.tip_width = 0.0015f;
    settings.shading.color = {0.6f, 0.4f, 0.25f};
    settings.shading.lights = {
        {.type = LightType::directional, .direction = {-0.5f, -0.5f, -1.0f}}};
    settings.shading.shadows = {.meshes = true, .softness = 0.5f};
    return settings;
}

groom::Mesh wall() {
    groom::Mesh mesh = quad();
    for (glm::vec3& position : mesh.positions) position.z = -0.35f;
    return mesh;
}

double meanOf(const Pixels& pixels) {
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels.size(); ++i) sum += i % 4 < 3 ? pixels[i] : 0;
    return sum / static_cast<double>(pixels.size());
}

// A deep shadow map counts the strands on the rays through its texels, and takes the mean of four
// of them. With texels of a quarter of a strand the pictures have the same light, and differ at the
// edges of shadows. Those of 256 texels are farther off.
TEST_F(TracedShadow, IsThatOfAFineMap) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    const TemporaryFolder folder;
    const groom::Groom groom = tangledGroom(12);
    const groom::Mesh mesh = wall();
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> pairs;
    for (const ShadingModel model : {ShadingModel::kajiya_kay, ShadingModel::dual_scattering}) {
        Settings settings = litTangle();
        settings.shading.model = model;
        const auto draw = [&](HairShadows shadows, std::uint32_t resolution) {
            settings.shading.shadows.hair = shadows;
            settings.shading.shadows.resolution = resolution;
            return drawGroom(device(), settings, groom, &mesh);
        };
        const Pixels traced = draw(HairShadows::rays, 4096);
        const Pixels fine = draw(HairShadows::deep_shadow, 4096);
        EXPECT_GT(differingPixels(traced, draw(HairShadows::none, 64), 8), 1000u);
        EXPECT_NEAR(meanOf(traced), meanOf(fine), 0.01 * meanOf(fine));
        const auto write = [&](const Pixels& pixels, const std::string& name) {
            const std::string number = std::to_string(static_cast<int>(model));
            return writePicture(folder.path() / (name + number + ".png"), settings, pixels);
        };
        const auto expected = write(traced, "rays");
        pairs.emplace_back(expected, write(fine, "fine"));
        pairs.emplace_back(expected, write(draw(HairShadows::deep_shadow, 256), "coarse"));
    }
    const std::vector<double> errors = flipErrors(pairs);
    ASSERT_EQ(errors.size(), 4u);
    for (std::size_t i = 0; i < errors.size(); i += 2) {
        EXPECT_LE(errors[i], 0.03);
        EXPECT_GT(errors[i + 1], errors[i]);
    }
}

TEST_F(TracedShadow, OfAStrandDoesNotFallOnIt) {
    Settings settings = litTangle();
    settings.shading.shadows.meshes = false;
    settings.shading.model = ShadingModel::kajiya_kay;
    settings.shading.shadows.stopped = 1.0f;
    settings.strands.density = 1;
    settings.strands.curl.radius = 0.01f;  // turns in front of others
    settings.strands.root_width = settings.strands.tip_width = 0.004f;
    settings.camera.target = {0.0f, 0.1f, 0.0f};
    const groom::Groom one = uprightGroom();
    const Pixels lit = drawGroom(device(), settings, one, nullptr);
    Settings shadowed = settings;
    shadowed.shading.shadows.hair = HairShadows::rays;
    EXPECT_EQ(differingPixels(drawGroom(device(), shadowed, one, nullptr), lit), 0u);
    // Those of others do.
    settings.strands.density = shadowed.strands.density = 40;
    const Pixels many = drawGroom(device(), settings, one, nullptr);
    EXPECT_GT(differingPixels(drawGroom(device(), shadowed, one, nullptr), many), 50u);
}

}  // namespace
}  // namespace hair::rendering
