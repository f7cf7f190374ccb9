// Compares our path tracer with Mitsuba 3, which shares no code with it, on the same files.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "benchmarks/reference/mitsuba.h"
#include "engine/files.h"
#include "engine/float_pictures.h"
#include "hair/groom/groom.h"
#include "hair/random.h"
#include "hair/reference/path_tracer.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"
#include "tests/cli/reference_python.h"
#include "tests/path_tracer/mitsuba_folder.h"
#include "tests/temporary_folder.h"

namespace hair::reference {
namespace {

// ---- Scenes -------------------------------------------------------------------------------------

// Radii are not much smaller than the scenes. Mitsuba moves the origins of rays by 9e-5 (1 + the
// greatest coordinate in cm), which is then below 1 % of a radius.

float numberOf(std::uint32_t index, std::uint32_t purpose) { return random01(3, index, purpose); }

struct Drawn {
    Settings settings;
    groom::StrandSet strands;
    std::vector<groom::Mesh> meshes;
    std::vector<float> powers;  // of the points' colours; empty: one colour
};

void addStrand(Drawn& drawn, const std::vector<glm::vec3>& points, float root, float tip) {
    groom::StrandSet& strands = drawn.strands;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float along = static_cast<float>(i) / static_cast<float>(points.size() - 1);
        strands.points.push_back(points[i]);
        strands.widths.values.push_back(2 * std::lerp(root, tip, along));
    }
    strands.ends.push_back(static_cast<std::uint32_t>(strands.points.size()));
}

Drawn withCamera(const glm::vec3& color, float distance, float field_of_view) {
    Drawn drawn;
    Settings& settings = drawn.settings;
    settings.camera = {
        .position = {0, 0, distance}, .field_of_view = field_of_view, .far_plane = 1000};
    settings.render.width = 24;
    settings.render.height = 24;
    settings.render.background = glm::vec3(0);
    settings.shading.color = color;
    settings.shading.cuticle_tilt = 5;  // greater than in hair, so that a wrong sign shows
    settings.shading.lights.clear();
    return drawn;
}

// Returns a wide fibre from the lower left to the upper right, lit from the front and from behind.
Drawn fiber() {
    Drawn drawn = withCamera({0.5f, 0.3f, 0.15f}, 12, 20);
    addStrand(drawn, {{-6, -2, -0.4f}, {6, 2, 0.4f}}, 0.5f, 0.5f);
    drawn.settings.shading.lights = {
        {.type = LightType::directional, .direction = {0.5f, -0.4f, -1}},
        {.position = {-4, 3, -6}, .color = {1, 0.8f, 0.6f}}};
    return drawn;
}

// Returns six layers of upright fibres, with a spherical light.
Drawn bundle(const glm::vec3& light) {
    Drawn drawn = withCamera({0.5f, 0.3f, 0.15f}, 8, 24);
    for (std::uint32_t i = 0; i < 6 * 24; ++i) {
        const float x =
            0.3f * (static_cast<float>(i % 24) - 11.5f) + 0.2f * (numberOf(i, 0) - 0.5f);
        const float z = -0.3f * static_cast<float>(i / 24) + 0.2f * (numberOf(i, 1) - 0.5f);
        addStrand(drawn, {{x, -4, z}, {x, 4, z}}, 0.1f, 0.1f);
    }
    drawn.settings.shading.lights = {
        {.type = LightType::sphere, .position = light, .radius = 1.0f}};
    return drawn;
}

// Returns the same from the front, where each fibre has its own colour, lighter at the top.
Drawn coloredBundle() {
    Drawn drawn = bundle({3, 2, 9});
    const groom::StrandSet straight = std::exchange(drawn.strands, {});
    for (std::uint32_t i = 0; i < straight.strandCount(); ++i) {
        const glm::vec3 root = straight.points[straight.first(i)];
        const float power = 0.3f + 1.4f * numberOf(i, 5);
        addStrand(drawn, {root, root + glm::vec3(0, 4, 0), root + glm::vec3(0, 8, 0)}, 0.1f, 0.1f);
        drawn.powers.insert(drawn.powers.end(), {power, 0.6f * power, 0.2f * power});
    }
    return drawn;
}

// Returns fair, curved, tapered hair on a matt floor, with a point light.
Drawn tuft(const glm::vec3& light) {
    Drawn drawn = withCamera({0.8f, 0.65f, 0.45f}, 9, 26);
    for (std::uint32_t i = 0; i < 160; ++i) {
        const float angle = glm::two_pi<float>() * numberOf(i, 2);
        const float out = std::sqrt(numberOf(i, 3));
        const glm::vec3 side(std::cos(angle), 0, std::sin(angle));
        const glm::vec3 other(-side.z, 0, side.x);
        const float wave = glm::two_pi<float>() * numberOf(i, 4);
        std::vector<glm::vec3> points;
        for (int k = 0; k < 9; ++k) {
            const float t = static_cast<float>(k) / 8;
            points.push_back(
                (0.7f * out + 0.9f * out * t * t) * side +
                0.15f * t * std::sin(wave + 8 * t) * other +
                glm::vec3(0, -1.6f + (3.4f - 1.2f * out) * t - 0.8f * t * t, 0));
        }
        addStrand(drawn, points, 0.06f, 0.02f);
    }
    groom::Mesh floor;
    floor.positions = {{-4, -1.6f, -4}, {-4, -1.6f, 4}, {4, -1.6f, 4}, {4, -1.6f, -4}};
    floor.normals.assign(4, {0, 1, 0});
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    floor.triangle_materials = {0, 0};
    floor.materials.resize(1);
    floor.materials[0].base_color = {0.7f, 0.6f, 0.5f};
    drawn.meshes.push_back(floor);
    drawn.settings.shading.lights = {{.position = light}};
    return drawn;
}

void writeFolder(const Drawn& drawn, const std::filesystem::path& folder) {
    benchmarks::reference::MitsubaParts parts{.hair_file = "hair.txt"};
    engine::writeFileAtomically(folder / "hair.txt", [&](std::ostream& out) {
        benchmarks::reference::writeMitsubaCurves(out, drawn.strands);
    });
    if (!drawn.powers.empty()) {
        parts.absorption_file = "absorption.exr";
        benchmarks::reference::writeMitsubaAbsorption(
            folder / parts.absorption_file, drawn.strands, drawn.powers,
            rendering::absorption(drawn.settings.shading));
    }
    for (const groom::Mesh& mesh : drawn.meshes) {
        parts.meshes.push_back({.file = "mesh.ply", .color = mesh.materials[0].base_color});
        engine::writeFileAtomically(folder / "mesh.ply", [&](std::ostream& out) {
            benchmarks::reference::writeMaterialPly(out, mesh, 0, {});
        });
    }
    engine::writeFileAtomically(folder / "scene.xml", [&](std::ostream& out) {
        benchmarks::reference::writeMitsubaScene(out, drawn.settings, parts);
    });
}

// ---- Comparison ---------------------------------------------------------------------------------

// Mean and standard error of the picture by Mitsuba 3.9.1 (scalar_rgb), linear RGB, with 1024
// samples a pixel and seeds 0 to 15. HAIRBENCH_TRACED_SCENES=DIR test_path_tracer writes the scenes
// to DIR. `.deps/reference/bin/python tests/path_tracer/mitsuba_means.py 1024 DIR/*` prints these
// numbers.
struct Published {
    const char* name;
    std::function<Drawn()> draw;
    std::uint32_t samples;  // of our path tracer, per pixel
    glm::dvec3 mean;
    glm::dvec3 error;
    double known = 0;  // relative difference of the two tracers beside their errors
};

constexpr double kMitsubaSamples = 1024;

void PrintTo(const Published& published, std::ostream* out) { *out << published.name; }

const Published kPublished[]{
    {"fiber", fiber, 1024, {0.195716, 0.102360, 0.044056}, {0.001097, 0.000514, 0.000171}},
    {"bundle_front",
     [] { return bundle({3, 2, 9}); },
     320,
     {0.213556, 0.109079, 0.048991},
     {0.000863, 0.000308, 0.000119}},
    {"bundle_back",
     [] { return bundle({4, 5, -8}); },
     320,
     {0.482835, 0.184205, 0.041641},
     {0.002527, 0.001127, 0.000405}},
    {"colored_bundle",
     coloredBundle,
     320,
     {0.273709, 0.195557, 0.129753},
     {0.001562, 0.001182, 0.000822},
     0.023},
    {"tuft_front",
     [] { return tuft({4, 5, 9}); },
     320,
     {0.109216, 0.080026, 0.046569},
     {0.000775, 0.000508, 0.000201}},
    {"tuft_back",
     [] { return tuft({-3, 4, -9}); },
     320,
     {0.211144, 0.180777, 0.132309},
     {0.001246, 0.001114, 0.000853}},
};

// Has the folder with a scene's files.
class SceneFolder {
public:
    explicit SceneFolder(const Published& published) : path_(temporary_.path()) {
        if (const char* const kept = std::getenv("HAIRBENCH_TRACED_SCENES"))
            path_ = std::filesystem::path(kept) / published.name;
        std::filesystem::create_directories(path_);
        writeFolder(published.draw(), path_);
    }
    const std::filesystem::path& path() const { return path_; }

private:
    TemporaryFolder temporary_;
    std::filesystem::path path_;
};

// Expects means to be equal within three standard errors of their difference. Ours is known to be
// up to 2.3 % darker from the front (scenes/references/README.md, Two path tracers), which shows in
// fair fibres.
void expectNear(
    const TracedPicture& ours, const glm::dvec3& mean, const glm::dvec3& error, double most,
    double known = 0) {
    const glm::dvec3 our_mean = ours.mean();
    const glm::dvec3 our_error = ours.standardError();
    for (int c = 0; c < 3; ++c) {
        const double both = std::hypot(our_error[c], error[c]);
        EXPECT_LT(both / mean[c], most) << "too few samples to tell, channel " << c;
        EXPECT_NEAR(our_mean[c] / mean[c], 1, 3 * both / mean[c] + known)
            << "channel " << c << ": " << our_mean[c] << " +- " << our_error[c] << ", Mitsuba "
            << mean[c] << " +- " << error[c];
    }
}

class PathTracerAgainstMitsuba : public testing::TestWithParam<Published> {};

TEST_P(PathTracerAgainstMitsuba, HasItsMeanLight) {
    const Published& published = GetParam();
    const SceneFolder folder(published);
    const TracedFolder read = readMitsubaFolder(folder.path());
    const PathTracer tracer(read.scene);
    expectNear(
        tracer.trace(read.camera, published.samples, 1), published.mean, published.error, 0.02,
        published.known);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, PathTracerAgainstMitsuba, testing::ValuesIn(kPublished),
    [](const auto& scene) { return std::string(scene.param.name); });

// Runs the installed Mitsuba, instead of using its recorded means.
TEST(PathTracerAgainstMitsuba, HasTheMeanLightOfOneThatRunsNow) {
    if (!hasReferencePython()) GTEST_SKIP() << kNoReference;
    constexpr std::uint32_t kSamples = 128;
    const Published& published = kPublished[1];
    const SceneFolder folder(published);
    const std::filesystem::path file = folder.path() / "mitsuba.exr";
    benchmarks::reference::traceMitsuba(folder.path(), kSamples, file);
    const engine::FloatPixels pixels = engine::readFloatImage(file);
    const TracedFolder read = readMitsubaFolder(folder.path());
    ASSERT_EQ(pixels.width, read.camera.width);
    ASSERT_EQ(pixels.height, read.camera.height);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < pixels.rgb.size(); i += 3)
        sum += glm::dvec3(pixels.rgb[i], pixels.rgb[i + 1], pixels.rgb[i + 2]);
    const double count = static_cast<double>(pixels.width) * pixels.height;
    expectNear(
        PathTracer(read.scene).trace(read.camera, kSamples, 2), sum / count,
        std::sqrt(kMitsubaSamples / kSamples) * published.error, 0.02);
}

}  // namespace
}  // namespace hair::reference
