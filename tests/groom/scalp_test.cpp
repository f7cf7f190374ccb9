#include "hair/groom/growth/scalp.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/growth/parting.h"
#include "hair/random.h"
#include "tests/error_text.h"
#include "tests/groom/test_meshes.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::HasSubstr;

TEST(Scalp, TakesOnlyItsMaterial) {
    const Scalp scalp =
        extractScalp(makeCap({.opening = 1.2f, .hairline = 0.75f, .rings = 8, .sectors = 12}));
    // Rings of 0.15 rad: five of them are scalp, the first 12 triangles, the others 24.
    EXPECT_EQ(scalp.triangles.size(), 12u + 4u * 24u);
    EXPECT_EQ(scalp.positions.size(), 1u + 5u * 12u);
    EXPECT_EQ(traceHairline(scalp).vertices.size(), 12u);
}

// A fine mesh of a spherical cap has nearly its area, 2 pi r^2 (1 - cos t): chords shorten by t^2 /
// 24 per step, 0.1 % here along the azimuth and less along the rings.
TEST(Scalp, MeasuresTheAreaOfACap) {
    const Scalp scalp = extractScalp(makeCap({.opening = 1.5f, .hairline = 2.0f}));
    const double area = 2.0 * std::numbers::pi * 0.01 * (1.0 - std::cos(1.5));
    EXPECT_NEAR(scalp.area(), area, 0.005 * area);
    EXPECT_LT(scalp.area(), area);
}

TEST(Scalp, WeldsVerticesAtTheSamePlace) {
    const Mesh grid = makeGrid(4, 3, kNoHole);
    Mesh soup = grid;
    soup.positions.clear();
    soup.normals.clear();
    for (std::size_t i = 0; i < grid.triangles.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            soup.triangles[i][corner] = static_cast<std::uint32_t>(soup.positions.size());
            soup.positions.push_back(grid.positions[grid.triangles[i][corner]]);
            soup.normals.emplace_back(corner == 0, 1.0f, 0.0f);
        }
    }
    const Scalp scalp = extractScalp(soup);
    EXPECT_EQ(scalp.positions.size(), grid.positions.size());
    for (const glm::vec3& normal : scalp.normals) EXPECT_NEAR(glm::length(normal), 1.0f, 1e-6f);
    EXPECT_DOUBLE_EQ(scalp.area(), 12.0);
}

// Seen from above (+y), with +x right and -z up, counter-clockwise; an edge has the scalp on its
// left.
TEST(Hairline, IsWalkedCounterClockwise) {
    const Scalp scalp = extractScalp(makeGrid(3, 2, kNoHole));
    const std::vector<std::uint32_t> hairline = traceHairline(scalp).vertices;
    ASSERT_EQ(hairline.size(), 10u);
    double twice_area = 0.0;
    for (std::size_t i = 0; i < 10; ++i) {
        const glm::vec3& a = scalp.positions[hairline[i]];
        const glm::vec3& b = scalp.positions[hairline[(i + 1) % 10]];
        EXPECT_EQ(glm::distance(a, b), 1.0f);
        twice_area += glm::cross(glm::dvec3(a), glm::dvec3(b)).y;
    }
    EXPECT_EQ(twice_area, 12.0);
}

TEST(Hairline, IsOneLoop) {
    const auto ring =
        makeGrid(3, 3, [](std::uint32_t x, std::uint32_t z) { return x == 1 && z == 1; });
    EXPECT_EQ(
        errorText([&] { traceHairline(extractScalp(ring)); }),
        "the scalp has 2 boundary loops, but 1 is needed");
    const auto islands = makeGrid(3, 3, [](std::uint32_t x, std::uint32_t) { return x == 1; });
    EXPECT_EQ(
        errorText([&] { traceHairline(extractScalp(islands)); }),
        "the scalp has 2 boundary loops, but 1 is needed");
    Mesh closed;  // a tetrahedron
    closed.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    closed.normals.resize(4, glm::vec3(0, 1, 0));
    closed.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    closed.triangle_materials.resize(4, 0);
    closed.materials = {{.name = "scalp"}};
    EXPECT_EQ(
        errorText([&] { traceHairline(extractScalp(closed)); }),
        "the scalp has 0 boundary loops, but 1 is needed");
}

TEST(Hairline, NeedsASurface) {
    const auto corner = makeGrid(2, 2, [](std::uint32_t x, std::uint32_t z) { return x != z; });
    EXPECT_EQ(
        errorText([&] { traceHairline(extractScalp(corner)); }),
        "the scalp's boundary touches itself at (1.000000, 0.000000, 1.000000)");
    Mesh fin = makeGrid(1, 1, kNoHole);
    fin.positions.emplace_back(0.5f, 1.0f, 0.5f);
    fin.normals.emplace_back(0.0f, 1.0f, 0.0f);
    fin.triangles.push_back({0, 3, 4});
    fin.triangle_materials.push_back(0);
    EXPECT_THAT(errorText([&] { traceHairline(extractScalp(fin)); }), HasSubstr("not a surface"));
}

// A closed piece beside a disc adds no boundary loop.
TEST(Hairline, RefusesASecondPiece) {
    Mesh mesh = makeGrid(1, 1, kNoHole);
    for (const glm::vec3 corner :
         {glm::vec3(5, 0, 0), glm::vec3(6, 0, 0), glm::vec3(5, 1, 0), glm::vec3(5, 0, 1)}) {
        mesh.positions.push_back(corner);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
    }
    for (const auto& triangle :
         {std::array{4u, 6u, 5u}, {4u, 5u, 7u}, {4u, 7u, 6u}, {5u, 6u, 7u}}) {
        mesh.triangles.push_back(triangle);
        mesh.triangle_materials.push_back(0);
    }
    EXPECT_EQ(
        errorText([&] { traceHairline(extractScalp(mesh)); }),
        "the scalp is not a disc: it has 2 pieces and the Euler characteristic 3");
}

// A part p of the area gets n p of n uniform points, with the standard deviation sqrt(n p (1 -
// p)); the test allows five.
TEST(SampleSurface, IsUniformInArea) {
    const Scalp scalp = extractScalp(makeGrid(4, 2, kNoHole));
    constexpr std::uint32_t count = 20000;
    std::array<int, 8> hits{};
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
        const SurfacePoint point =
            sampleSurface(scalp, {random01(1, i, 0), random01(1, i, 1), random01(1, i, 2)});
        ASSERT_EQ(point.position.y, 0.0f);
        const auto column = std::min(static_cast<std::size_t>(point.position.x), std::size_t{3});
        ++hits[column + 4 * (point.position.z >= 1.0f ? 1 : 0)];
        sum += glm::dvec3(point.position);
    }
    for (const int hit : hits) EXPECT_NEAR(hit, 2500, 5 * std::sqrt(20000.0 / 8.0 * 7.0 / 8.0));
    EXPECT_NEAR(sum.x / count, 2.0, 5 * 4.0 / std::sqrt(12.0 * count));
    EXPECT_NEAR(sum.z / count, 1.0, 5 * 2.0 / std::sqrt(12.0 * count));
}

TEST(SampleSurface, TakesTheLimitsOfItsNumbers) {
    const Scalp scalp = extractScalp(makeCap());
    const float most = 1.0f - 0x1p-24f;
    for (const auto& random :
         {std::array{0.0f, 0.0f, 0.0f}, {most, most, most}, {most, 0.0f, most}}) {
        const SurfacePoint point = sampleSurface(scalp, random);
        EXPECT_LE(glm::length(point.position), 0.1f + 1e-6f);
        EXPECT_NEAR(glm::length(point.normal), 1.0f, 1e-6f);
    }
}

// On a sphere the normal at a point is its direction. A facet's blended normals between vertices
// 0.13 rad apart differ from it by a few times the square of that.
TEST(SampleSurface, InterpolatesNormals) {
    const Scalp scalp = extractScalp(makeCap());
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const SurfacePoint point =
            sampleSurface(scalp, {random01(3, i, 0), random01(3, i, 1), random01(3, i, 2)});
        EXPECT_GT(glm::dot(point.normal, glm::normalize(point.position)), 1.0f - 1e-4f);
    }
}

std::vector<SurfacePoint> evenly(const Scalp& scalp, std::uint32_t count) {
    const Hairline hairline = traceHairline(scalp);
    std::vector<SurfacePoint> points;
    for (std::uint32_t i = 0; i < count; ++i)
        points.push_back(hairlinePoint(scalp, hairline, hairline.length() * i / count));
    return points;
}

TEST(Hairline, IsMeasuredByArcLength) {
    const Scalp scalp = extractScalp(makeGrid(3, 2, kNoHole));
    const Hairline hairline = traceHairline(scalp);
    EXPECT_DOUBLE_EQ(hairline.length(), 10.0);
    const std::vector<SurfacePoint> points = evenly(scalp, 20);
    for (std::size_t i = 0; i < 20; ++i) {
        EXPECT_NEAR(glm::distance(points[i].position, points[(i + 1) % 20].position), 0.5f, 1e-6f);
    }
    EXPECT_EQ(points[0].position, scalp.positions[hairline.vertices[0]]);
    for (std::size_t i = 0; i < 20; i += 2) {
        EXPECT_EQ(points[i].position, scalp.positions[hairline.vertices[i / 2]]);
    }
    EXPECT_EQ(hairlinePoint(scalp, hairline, 10.5).position, points[1].position);
}

// There are fewer points than edges, and their number does not divide the number of edges. On a
// circle the chords are still equal, except for the sagitta of the mesh's own 48 edges.
TEST(Hairline, IsEvenOnACircle) {
    const Scalp scalp = extractScalp(makeCap());
    const std::vector<SurfacePoint> points = evenly(scalp, 7);
    const float chord = glm::distance(points[0].position, points[1].position);
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_NEAR(
            glm::distance(points[i].position, points[(i + 1) % 7].position), chord, 0.005f * chord);
    }
}

TEST(Hairline, FindsTheLengthNearestToAPoint) {
    const Scalp scalp = extractScalp(makeGrid(3, 2, kNoHole));
    const Hairline hairline = traceHairline(scalp);
    for (const double length : {0.0, 0.3, 1.0, 4.7, 9.9}) {
        const glm::dvec3 point(hairlinePoint(scalp, hairline, length).position);
        const glm::dvec3 above = point + glm::dvec3(0.0, 0.2, 0.0);
        // Positions are stored to 1.2e-7 near 3.
        EXPECT_NEAR(nearestLength(scalp, hairline, above), length, 5e-7);
    }
}

}  // namespace
}  // namespace hair::groom
