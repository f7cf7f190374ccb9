#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/shadow_probe.h"

// Shadow maps of a square.
namespace hair::rendering {
namespace {

using MeshShadowTest = GpuTest;

constexpr float kHalf = 0.05f;  // m, of the square's side

// The rounding of the filter's weights: up to 49 of them, each with three roundings of 2^-24.
constexpr float kMapRounding = 1e-5f;

// A square round the origin, with this normal.
groom::Mesh square(const glm::vec3& normal) {
    const glm::vec3 a = glm::normalize(glm::cross(normal, glm::vec3(0.3f, 1.0f, 0.2f)));
    const glm::vec3 b = glm::cross(normal, a);
    return {
        .positions = {kHalf * (-a - b), kHalf * (a - b), kHalf * (a + b), kHalf * (b - a)},
        .normals = std::vector<glm::vec3>(4, normal),
        .triangles = {{0, 1, 2}, {0, 2, 3}},
        .triangle_materials = {0, 0},
        .materials = {{.name = "square"}}};
}

// A square across z; its sides are along x and y.
groom::Mesh squareAcrossZ() {
    groom::Mesh mesh = square({0.0f, 0.0f, 1.0f});
    mesh.positions = {
        {-kHalf, -kHalf, 0.0f}, {kHalf, -kHalf, 0.0f}, {kHalf, kHalf, 0.0f}, {-kHalf, kHalf, 0.0f}};
    return mesh;
}

Settings meshShadows(const LightSettings& light) {
    Settings settings;
    settings.render.hair = false;
    settings.shading.lights = {light};
    settings.shading.shadows.meshes = true;
    settings.shading.shadows.resolution = 256;
    return settings;
}

// The light's map shows the square's circle, side sqrt(2) kHalf to each side; parallel light.
constexpr float kMeshTexel = 2.0f * 1.4143f * kHalf / 256.0f;

// No hair.
StrandView bald() {
    StrandView view;
    view.vertices_per_guide = 2;
    return view;
}

std::vector<glm::vec3> grid(float reach, float z) {
    std::vector<glm::vec3> points;
    for (int i = -30; i <= 30; ++i)
        for (int k = -30; k <= 30; ++k)
            points.emplace_back(
                reach * static_cast<float>(i) / 30.0f, reach * static_cast<float>(k) / 30.0f, z);
    return points;
}

void expectGeometry(
    const engine::Device& device, const Settings& settings, const RenderAssets& assets,
    const std::vector<glm::vec3>& points) {
    const LightSettings& light = settings.shading.lights[0];
    const auto paths = findPaths(device, settings, bald(), assets, points);
    std::size_t lit = 0;
    std::size_t unlit = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 to_light =
            light.type == LightType::directional ? -light.direction : light.position - points[i];
        // The path to the light meets the square's plane here.
        const glm::vec3 at = points[i] - points[i].z / to_light.z * to_light;
        const float outside = std::max(std::abs(at.x), std::abs(at.y)) - kHalf;
        // Softness, and half a texel for rasterisation. In perspective, a light's map is up to
        // twice as coarse at the distances here.
        const float filter = 2.0f * (settings.shading.shadows.softness + 0.5f) * kMeshTexel;
        if (std::abs(outside) < filter) continue;
        ASSERT_NEAR(paths[i].meshes, outside > 0.0f ? 1.0f : 0.0f, kMapRounding) << i;
        ASSERT_EQ(paths[i].strands, 0.0f);
        ++(outside > 0.0f ? lit : unlit);
    }
    EXPECT_GT(lit, 500u);
    EXPECT_GT(unlit, 500u);
}

TEST_F(MeshShadowTest, SquareShadesWhatIsBehindIt) {
    const groom::Mesh mesh = squareAcrossZ();
    const LightSettings directional{
        .type = LightType::directional, .direction = {0.0f, 0.0f, -1.0f}};
    const LightSettings oblique{.type = LightType::directional, .direction = {0.3f, -0.2f, -1.0f}};
    const LightSettings point{.position = {0.1f, 0.2f, 1.0f}};
    const LightSettings sphere{.type = LightType::sphere, .position = {0.0f, 0.0f, 0.4f}};
    for (const LightSettings& light : {directional, oblique, point, sphere}) {
        Settings settings = meshShadows(light);
        for (const float softness : {0.0f, 1.0f, 2.5f}) {
            settings.shading.shadows.softness = softness;
            // The second ones are beyond the far end of the light's depth range.
            expectGeometry(device(), settings, {.head = &mesh}, grid(0.09f, -0.03f));
            expectGeometry(device(), settings, {.head = &mesh}, grid(0.12f, -0.2f));
        }
    }
}

TEST_F(MeshShadowTest, WhatIsBeforeTheSquareIsLit) {
    const groom::Mesh mesh = squareAcrossZ();
    const Settings settings = meshShadows({.position = {0.1f, 0.2f, 1.0f}});
    for (const FoundPath& path :
         findPaths(device(), settings, bald(), {.head = &mesh}, grid(0.09f, 0.01f)))
        ASSERT_NEAR(path.meshes, 1.0f, kMapRounding);
}

// Flat surfaces don't shade themselves at any angle to the light down to 6 degrees. The shadow of
// a surface begins half a texel along the light behind it. A surface turned by 5 degrees more also
// needs the distance that it rises within the filter.
TEST_F(MeshShadowTest, SurfacesShadeNotThemselvesButWhatIsCloseBehind) {
    const glm::vec3 down(0.0f, 0.0f, -1.0f);
    for (const float degrees : {0.0f, 20.0f, 45.0f, 70.0f, 83.0f}) {
        const float angle = degrees * 0.0174533f;
        const glm::vec3 normal = glm::normalize(
            glm::vec3(0.8f * std::sin(angle), 0.6f * std::sin(angle), std::cos(angle)));
        const groom::Mesh mesh = square(normal);
        for (const LightType type : {LightType::directional, LightType::point}) {
            Settings settings =
                meshShadows({.type = type, .position = {0.0f, 0.0f, 1.0f}, .direction = down});
            const glm::vec3 a = 0.5f * (mesh.positions[1] - mesh.positions[0]);
            const glm::vec3 b = 0.5f * (mesh.positions[2] - mesh.positions[1]);
            std::vector<gpu::ShadowProbe> on;
            std::vector<gpu::ShadowProbe> behind;
            // share of the square in which the filter sees nothing else
            const float inside = std::cos(angle) > 0.3f ? 0.9f : 0.5f;
            for (const glm::vec3& point : grid(inside, 0.0f)) {
                const glm::vec3 place = point.x * a + point.y * b;
                on.push_back({place, 0, normal});
                const glm::vec3 light(0.0f, 0.0f, 1.0f);
                const glm::vec3 away =
                    type == LightType::point ? glm::normalize(place - light) : down;
                const float cosine = glm::dot(normal, -away);
                if (cosine < 0.1f) continue;
                // 0.1 texels for rounding; 5 % for texels that are larger behind.
                const float turned = 0.0873f * 1.5f / (cosine * cosine);
                behind.push_back({place + 1.05f * (0.6f + turned) * kMeshTexel * away, 0, normal});
            }
            for (const FoundPath& path : findPaths(device(), settings, bald(), {.head = &mesh}, on))
                ASSERT_NEAR(path.meshes, 1.0f, kMapRounding) << degrees;
            for (const FoundPath& path :
                 findPaths(device(), settings, bald(), {.head = &mesh}, behind))
                ASSERT_EQ(path.meshes, 0.0f) << degrees;
        }
    }
}

// Strands don't know the surface that they lie on. On it they are lit up to a slope of 63 degrees,
// and they are shaded from 2 (softness + 0.5) texels behind it.
TEST_F(MeshShadowTest, StrandsOnASurfaceAreLit) {
    const glm::vec3 down(0.0f, 0.0f, -1.0f);
    const glm::vec3 normal = glm::normalize(glm::vec3(1.0f, 0.0f, 1.0f));
    const groom::Mesh mesh = square(normal);
    const Settings settings = meshShadows({.type = LightType::directional, .direction = down});
    const glm::vec3 a = 0.5f * (mesh.positions[1] - mesh.positions[0]);
    const glm::vec3 b = 0.5f * (mesh.positions[2] - mesh.positions[1]);
    std::vector<glm::vec3> on;
    std::vector<glm::vec3> behind;
    for (const glm::vec3& point : grid(0.9f, 0.0f)) {
        on.push_back(point.x * a + point.y * b);
        // The bias of 3 texels, and 1.5 texels for the slope of the surface within the filter.
        behind.push_back(on.back() + (3.0f + 1.5f + 0.1f) * kMeshTexel * down);
    }
    for (const FoundPath& path : findPaths(device(), settings, bald(), {.head = &mesh}, on))
        ASSERT_NEAR(path.meshes, 1.0f, kMapRounding);
    for (const FoundPath& path : findPaths(device(), settings, bald(), {.head = &mesh}, behind))
        ASSERT_EQ(path.meshes, 0.0f);
}

}  // namespace
}  // namespace hair::rendering
