#include "hair/groom/growth/grow.h"

#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/groom/surface_meshes.h"
#include "tests/groom/test_meshes.h"

namespace hair::groom {
namespace {

// The vector along the surface that, added to the unit normal, gives this direction.
glm::dvec3 added(const glm::dvec3& direction, const glm::dvec3& normal) {
    return direction / glm::dot(direction, normal) - normal;
}

// A scalp on the plane y = 0 from (0, 0) to (8, 8), facing up.
class DirectionFieldTest : public testing::Test {
protected:
    SurfacePoint at(double x, double z) const {
        const MeshPoint point = surface_({x, 0.0, z});
        return surfacePoint(scalp_, point.triangle, point.weights);
    }
    glm::dvec3 addedAt(const GrowSettings& settings, double x, double z) const {
        std::optional<PartingLine> line;
        if (settings.parting.strength > 0.0f) line.emplace(scalp_, surface_, settings.parting);
        const DirectionField field(settings, surface_, line ? &*line : nullptr);
        return added(field(at(x, z)), {0.0, 1.0, 0.0});
    }

    Scalp scalp_ = extractScalp(makeGrid(8, 8, [](auto, auto) { return false; }));
    NearestSurface surface_{scalp_.positions, scalp_.triangles};
};

// Numbers of the settings are floats.
constexpr double kRounding = 1e-6;

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::distance(a, b), kRounding) << "(" << a.x << ", " << a.y << ", " << a.z << ")";
}

// In a view from above with +x to the right, +z points down: counter-clockwise is from +x to -z.
TEST_F(DirectionFieldTest, TurnsCounterClockwiseAtTheWhorl) {
    GrowSettings settings;
    settings.whorl = {.position = {4.0f, 0.3f, 4.0f}, .strength = 0.5f, .radius = 1.5f};
    expectNear(addedAt(settings, 5.5, 4.0), {0.0, 0.0, -0.5});
    expectNear(addedAt(settings, 4.0, 2.5), {-0.5, 0.0, 0.0});
    expectNear(addedAt(settings, 2.5, 4.0), {0.0, 0.0, 0.5});
    expectNear(addedAt(settings, 4.0, 5.5), {0.5, 0.0, 0.0});
}

TEST_F(DirectionFieldTest, IsStrongestAtTheWhorlsRadius) {
    GrowSettings settings;
    settings.whorl = {.position = {4.0f, 0.0f, 4.0f}, .strength = -2.0f, .radius = 1.0f};
    double before = 0.0;
    for (double r = 0.05; r < 3.9; r += 0.05) {
        const glm::dvec3 vector = addedAt(settings, 4.0 + r, 4.0);
        const double strength = glm::length(vector);
        EXPECT_GT(vector.z, 0.0);  // clockwise
        if (r < 1.01) {
            EXPECT_GT(strength, before);
        } else if (r > 1.04) {
            EXPECT_LT(strength, before);
        }
        EXPECT_LE(strength, 2.0 + kRounding);
        EXPECT_NEAR(strength, 2.0 * r * std::exp(0.5 - 0.5 * r * r), 1e-5);  // 20 times larger
        before = strength;
    }
    expectNear(addedAt(settings, 4.0, 4.0), glm::dvec3(0.0));
}

TEST_F(DirectionFieldTest, CombsAwayFromThePartingOnBothSides) {
    GrowSettings settings;
    settings.parting = {
        .from = {2.0f, 0.1f, 4.0f}, .to = {6.0f, 0.1f, 4.0f}, .strength = 3.0f, .reach = 0.5f};
    for (const double x : {2.5, 4.0, 5.5}) {
        expectNear(addedAt(settings, x, 4.5), {0.0, 0.0, 3.0 / std::exp(1.0)});
        expectNear(addedAt(settings, x, 3.5), {0.0, 0.0, -3.0 / std::exp(1.0)});
        expectNear(addedAt(settings, x, 5.0), {0.0, 0.0, 3.0 / std::exp(2.0)});
    }
}

// Exactly beyond the end there is no side. Elsewhere the direction from the end is oblique.
TEST_F(DirectionFieldTest, FadesBeyondThePartingsEnds) {
    GrowSettings settings;
    settings.parting = {
        .from = {2.0f, 0.0f, 4.0f}, .to = {6.0f, 0.0f, 4.0f}, .strength = 3.0f, .reach = 1.0f};
    expectNear(addedAt(settings, 7.0, 4.0), glm::dvec3(0.0));
    const double root2 = std::sqrt(2.0);
    expectNear(addedAt(settings, 7.0, 5.0), {0.0, 0.0, 3.0 * std::exp(-root2) / root2});
    expectNear(addedAt(settings, 1.0, 3.0), {0.0, 0.0, -3.0 * std::exp(-root2) / root2});
}

TEST_F(DirectionFieldTest, AddsEverything) {
    GrowSettings settings;
    settings.comb = {0.25f, 0.0f, 0.5f};
    settings.whorl = {.position = {4.0f, 0.0f, 4.0f}, .strength = 0.5f, .radius = 1.0f};
    settings.parting = {
        .from = {5.0f, 0.0f, 2.0f}, .to = {5.0f, 0.0f, 6.0f}, .strength = 1.0f, .reach = 1.0f};
    // 1 m to the right of the centre and 1 mm to the right of the line.
    const double whorl = 0.5 * 1.001 * std::exp(0.5 * (1.0 - 1.001 * 1.001));
    expectNear(addedAt(settings, 5.001, 4.0), {0.25 + std::exp(-0.001), 0.0, 0.5 - whorl});
}

TEST_F(DirectionFieldTest, LiftsDirectionsOutOfTheSurface) {
    GrowSettings settings;
    settings.comb = {3.0f, -2.0f, 0.0f};
    settings.whorl = {.position = {0.0f, 0.0f, 0.0f}, .strength = 1e-6f, .radius = 0.01f};
    const DirectionField lifted(settings, surface_, nullptr);
    expectNear(lifted(at(4.0, 4.0)), {std::sqrt(1.0 - 0.0025), 0.05, 0.0});
    settings.whorl.strength = 0.0f;  // the comb alone acts as set
    const DirectionField combed(settings, surface_, nullptr);
    expectNear(combed(at(4.0, 4.0)), glm::normalize(glm::dvec3(3.0, -1.0, 0.0)));
}

// On a sphere the directions are along its surface everywhere, and round the axis through the
// whorl's centre.
TEST(DirectionField, FollowsACurvedSurface) {
    const Scalp scalp = extractScalp(makeSphere(0.1, 64, 32));
    const NearestSurface surface(scalp.positions, scalp.triangles);
    GrowSettings settings;
    settings.whorl = {.position = {0.0f, 0.15f, 0.0f}, .strength = 1.0f, .radius = 0.05f};
    const DirectionField field(settings, surface, nullptr);
    for (std::uint32_t i = 0; i < scalp.triangles.size(); i += 37) {
        const SurfacePoint point = surfacePoint(scalp, i, glm::dvec3(1.0 / 3.0));
        const glm::dvec3 vector = added(field(point), glm::dvec3(point.normal));
        const glm::dvec3 position(point.position);
        EXPECT_NEAR(glm::dot(vector, glm::dvec3(point.normal)), 0.0, kRounding);
        EXPECT_GE(glm::dot(vector, glm::cross({0.0, 1.0, 0.0}, position)), 0.0);
        EXPECT_NEAR(vector.y, 0.0, 1e-4);  // the normals of a mesh are not quite a sphere's
    }
}

}  // namespace
}  // namespace hair::groom
