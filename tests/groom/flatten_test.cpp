#include "hair/groom/growth/scalp.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "tests/error_text.h"
#include "tests/groom/test_meshes.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::HasSubstr;

void expectKeepsOrientation(const Scalp& scalp) {
    const Flattening flattening = flatten(scalp);
    for (const auto& [i, j, k] : scalp.triangles) {
        const glm::dvec2 a = flattening(scalp.positions[i]);
        const glm::dvec2 b = flattening(scalp.positions[j]) - a;
        const glm::dvec2 c = flattening(scalp.positions[k]) - a;
        EXPECT_GT(b.x * c.y - b.y * c.x, 0.0);
    }
}

// From the centre of a sphere every facet faces the eye. The tried depths are 1/255 of the root of
// the area (0.24 m) apart. The map is stereographic: a polar angle t maps to the radius tan(t /
// 2).
TEST(Flatten, ProjectsASphereFromItsCentre) {
    const glm::vec3 centre{0.3f, -0.2f, 0.1f};
    const Scalp scalp = extractScalp(makeCap({.centre = centre, .sectors = 64}));
    const Flattening flattening = flatten(scalp);
    EXPECT_NEAR(glm::distance(flattening.centre, glm::dvec3(centre)), 0.0, 0.002);
    EXPECT_NEAR(flattening.axis.y, 1.0, 1e-5);
    for (const float polar : {0.0f, 0.5f, 1.0f, 1.5f}) {
        const glm::vec3 point =
            centre +
            0.1f * glm::vec3(std::sin(polar) * 0.6f, std::cos(polar), std::sin(polar) * 0.8f);
        EXPECT_NEAR(glm::length(flattening(point)), std::tan(0.5 * polar), 0.02);
    }
}

TEST(Flatten, KeepsOrientation) {
    expectKeepsOrientation(extractScalp(makeCap()));
    expectKeepsOrientation(extractScalp(makeCap({.opening = 2.6f, .hairline = 2.5f})));
    expectKeepsOrientation(extractScalp(makeCap({.opening = 0.2f, .hairline = 0.2f})));
}

TEST(Flatten, PullsTheCentreOutOfAFlatScalp) {
    const Scalp scalp = extractScalp(makeGrid(5, 4, kNoHole));
    EXPECT_LT(flatten(scalp).centre.y, 0.0);
    expectKeepsOrientation(scalp);
}

TEST(Flatten, RefusesAScalpThatFolds) {
    // A sheet of three squares in a row, folded flat along both lines: from every place, one of
    // them is seen from outside.
    Mesh mesh = makeGrid(3, 1, kNoHole);
    for (glm::vec3& position : mesh.positions) {
        if (position.x == 2.0f) position = {0.2f, 0.3f, position.z};
        if (position.x == 3.0f) position = {1.2f, 0.6f, position.z};
    }
    EXPECT_THAT(errorText([&] { flatten(extractScalp(mesh)); }), HasSubstr("folds over itself"));
}

// A sphere with a C-shaped hole, wide along the equator. The mean normal points away from the
// hole's middle, to the scalp.
TEST(Flatten, RefusesAScalpOnBothEndsOfItsAxis) {
    Mesh mesh = makeCap({.opening = 3.0f, .hairline = 4.0f});
    const auto last_ring = static_cast<std::uint32_t>(mesh.positions.size()) - 48;
    mesh.positions.emplace_back(0.0f, -0.1f, 0.0f);
    mesh.normals.emplace_back(0.0f, -1.0f, 0.0f);
    for (std::uint32_t s = 0; s < 48; ++s) {
        mesh.triangles.push_back({last_ring + s, last_ring + 48, last_ring + (s + 1) % 48});
        mesh.triangle_materials.push_back(1);
    }
    // After the apex's 48 triangles a ring has 96, two for each sector.
    for (std::uint32_t ring = 8; ring < 18; ++ring) {
        for (std::uint32_t sector = 0; sector < 16; ++sector) {
            if (ring >= 11 && ring < 15 && sector >= 4)
                continue;  // inside the C, which is open at its end
            const std::size_t triangle = 48 + 96 * (ring - 1) + 2 * sector;
            mesh.triangle_materials[triangle] = mesh.triangle_materials[triangle + 1] = 0;
        }
    }
    EXPECT_THAT(
        errorText([&] { flatten(extractScalp(mesh)); }), HasSubstr("wraps all the way round"));
}

TEST(Flatten, RefusesAnAlmostClosedScalp) {
    const Scalp scalp =
        extractScalp(makeCap({.opening = 3.12f, .hairline = 3.2f, .rings = 64, .sectors = 16}));
    EXPECT_THAT(errorText([&] { flatten(scalp); }), HasSubstr("can't be flattened"));
}

}  // namespace
}  // namespace hair::groom
