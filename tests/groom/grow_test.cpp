#include "hair/groom/growth/grow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "engine/pictures.h"
#include "hair/groom/growth/roots.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/groom/surface_meshes.h"
#include "tests/groom/test_meshes.h"
#include "tests/largest_difference.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::HasSubstr;

// A float near 0.3 m is stored to 1.5e-8; a difference of two along three axes to about 5e-8.
constexpr float kPlaceRounding = 1e-7f;

Groom grow(
    const Mesh& mesh, const GrowSettings& settings, std::uint32_t guides, std::uint32_t seed) {
    return grow(mesh, settings, {}, guides, seed);
}

Mesh headMesh() { return importMesh(std::string(HAIRBENCH_SCENES_DIR) + "/assets/head.glb"); }

// Ericson 2004, Real-time collision detection, section 5.1.5, in double precision.
double distanceToTriangle(
    const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto toSegment = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 edge = to - from;
        const double t = std::clamp(glm::dot(p - from, edge) / glm::dot(edge, edge), 0.0, 1.0);
        return glm::distance(p, from + t * edge);
    };
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const bool over = glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
                      glm::dot(glm::cross(c - b, p - b), n) >= 0.0 &&
                      glm::dot(glm::cross(a - c, p - c), n) >= 0.0;
    if (over) return std::abs(glm::dot(p - a, n)) / glm::length(n);
    return std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
}

double distanceToScalp(const Mesh& mesh, const glm::vec3& point) {
    Extremes distances;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.materials[mesh.triangle_materials[i]].name != "scalp") continue;
        const auto& [a, b, c] = mesh.triangles[i];
        distances.add(
            distanceToTriangle(point, mesh.positions[a], mesh.positions[b], mesh.positions[c]));
    }
    return distances.least();
}

std::vector<glm::vec3> rootsOf(const Groom& groom) {
    std::vector<glm::vec3> roots;
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) roots.push_back(groom.strand(i)[0]);
    return roots;
}

bool sameGroom(const Groom& a, const Groom& b) {
    return a.points == b.points && a.root_triangles == b.root_triangles;
}

// The surface has h boundary edges, each once, and is a disc: V - E + F = 1 with 3 F = 2 E - h.
void expectDisc(const Groom& groom) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::set<std::uint32_t> used;
    for (const auto& [a, b, c] : groom.root_triangles) {
        used.insert({a, b, c});
        for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            EXPECT_TRUE(edges.insert(edge).second);
        }
    }
    std::size_t open = 0;
    for (const auto& [from, to] : edges) open += edges.contains({to, from}) ? 0u : 1u;
    EXPECT_EQ(used.size(), groom.strand_count);
    EXPECT_EQ(open, boundaryRootCount(groom.strand_count));
}

TEST(BoundaryRootCount, FollowsTheSquareRootFromTheThesis) {
    EXPECT_EQ(boundaryRootCount(86), 34u);
    EXPECT_EQ(boundaryRootCount(344), 68u);    // 4 * 86
    EXPECT_EQ(boundaryRootCount(1376), 136u);  // 16 * 86
    EXPECT_EQ(boundaryRootCount(3), 3u);
    EXPECT_EQ(boundaryRootCount(8), 8u);  // 10.4, but there are only 8
}

TEST(Grow, GivesThesisCountsFor86Guides) {
    for (const Mesh& mesh : {makeCap(), headMesh()}) {
        const Groom groom = grow(mesh, {}, 86, 1);
        EXPECT_EQ(groom.strand_count, 86u);
        EXPECT_EQ(groom.vertices_per_strand, 8u);
        EXPECT_EQ(groom.points.size(), 86u * 8u);
        EXPECT_EQ(groom.root_triangles.size(), 136u);
        expectDisc(groom);
    }
}

TEST(Grow, GivesEulersCountForAnyNumberOfGuides) {
    const Mesh head = headMesh();
    for (std::uint32_t guides = 3; guides < 120; ++guides) {
        const Groom groom = grow(head, {}, guides, guides);
        const std::uint32_t boundary = boundaryRootCount(guides);
        EXPECT_EQ(groom.root_triangles.size(), 2 * guides - 2 - boundary) << guides << " guides";
        expectDisc(groom);
    }
    EXPECT_EQ(grow(head, {}, 344, 1).root_triangles.size(), 618u);
    EXPECT_EQ(grow(head, {}, 1376, 1).root_triangles.size(), 2614u);
}

// Roots along the hairline are then farther apart than the two sides of the scalp.
TEST(Grow, TakesALongNarrowScalp) {
    const Mesh strip = makeGrid(40, 1, [](std::uint32_t, std::uint32_t) { return false; });
    for (const std::uint32_t guides : {16u, 20u, 86u, 344u}) {
        const Groom groom = grow(strip, {}, guides, 1);
        EXPECT_EQ(groom.root_triangles.size(), 2 * guides - 2 - boundaryRootCount(guides));
        expectDisc(groom);
    }
}

TEST(Grow, PutsRootsOnTheSurface) {
    for (const Mesh& mesh : {makeCap(), headMesh()}) {
        for (const glm::vec3& root : rootsOf(grow(mesh, {}, 86, 3))) {
            EXPECT_LT(distanceToScalp(mesh, root), 1e-6);
        }
    }
}

// Outside means away from the middle of the head: the asset's scalp is star-shaped from there.
TEST(Grow, TurnsRootTrianglesOutward) {
    const glm::vec3 middle{0.0f, -0.01f, -0.015f};
    const Mesh head = headMesh();
    for (const std::uint32_t guides : {86u, 1376u}) {
        const Groom groom = grow(head, {}, guides, 1);
        const std::vector<glm::vec3> roots = rootsOf(groom);
        for (const auto& [a, b, c] : groom.root_triangles) {
            const glm::vec3 normal = glm::cross(roots[b] - roots[a], roots[c] - roots[a]);
            EXPECT_GT(glm::dot(normal, roots[a] - middle), 0.0f);
        }
    }
}

// With perfect spacing the ratio of smallest to mean distance between neighbours is 1. For n
// uniform points the mean is 0.5 sqrt(A / n) and the smallest 0.66 sqrt(A) / n, a ratio of 1.3 /
// sqrt(n): 0.14 for 86. A ratio of one half is far from both.
TEST(Grow, SpreadsRootsWell) {
    for (const Mesh& mesh : {makeCap(), headMesh()}) {
        for (const std::uint32_t guides : {86u, 344u}) {
            for (std::uint32_t seed = 0; seed < 4; ++seed) {
                const std::vector<glm::vec3> roots = rootsOf(grow(mesh, {}, guides, seed));
                Extremes all_nearest;
                double sum = 0.0;
                for (std::size_t i = 0; i < roots.size(); ++i) {
                    Extremes distances;
                    for (std::size_t j = 0; j < roots.size(); ++j) {
                        if (i != j) distances.add(double{glm::distance(roots[i], roots[j])});
                    }
                    all_nearest.add(distances.least());
                    sum += distances.least();
                }
                EXPECT_GT(all_nearest.least(), 0.5 * sum / guides);
            }
        }
    }
}

// The triangles of the roots lie inside a convex cap, so their area is a little smaller: the
// sagitta of edges of about 0.03 on a sphere of radius 0.1 costs some per cent.
TEST(Grow, CoversTheScalpWithRootTriangles) {
    const Mesh cap = makeCap();
    const double area = extractScalp(cap).area();
    const Groom groom = grow(cap, {}, 86, 1);
    const std::vector<glm::vec3> roots = rootsOf(groom);
    double sum = 0.0;
    for (const auto& [a, b, c] : groom.root_triangles) {
        sum += 0.5 * double{glm::length(glm::cross(roots[b] - roots[a], roots[c] - roots[a]))};
    }
    EXPECT_LT(sum, area);
    EXPECT_GT(sum, 0.93 * area);
}

TEST(Grow, RepeatsItself) {
    const Mesh head = headMesh();
    EXPECT_TRUE(sameGroom(grow(head, {}, 200, 5), grow(head, {}, 200, 5)));
}

TEST(Grow, GivesEverySeedItsOwnRoots) {
    const Mesh head = headMesh();
    const std::vector<glm::vec3> first = rootsOf(grow(head, {}, 86, 1));
    const std::vector<glm::vec3> second = rootsOf(grow(head, {}, 86, 2));
    for (std::size_t i = 34; i < 86; ++i) EXPECT_NE(first[i], second[i]);
}

TEST(Grow, MakesSegmentsEquallyLong) {
    const Mesh head = headMesh();
    for (const std::uint32_t vertices : {2u, 8u, 64u}) {
        for (const float droop : {0.0f, 8.0f, 100.0f}) {
            const GrowSettings settings{.vertices = vertices, .length = 0.15f, .droop = droop};
            const Groom groom = grow(head, settings, 86, 1);
            const float length = 0.15f / static_cast<float>(vertices - 1);
            for (std::uint32_t i = 0; i < 86; ++i) {
                const auto strand = groom.strand(i);
                for (std::size_t v = 1; v < vertices; ++v) {
                    EXPECT_NEAR(glm::distance(strand[v - 1], strand[v]), length, kPlaceRounding);
                }
            }
        }
    }
}

// On a sphere the mesh's normals are the roots' directions, except for the flatness of the facets
// (see scalp_test).
TEST(Grow, FollowsTheNormalWithoutCombAndDroop) {
    const Groom groom = grow(makeCap(), {}, 86, 1);
    for (std::uint32_t i = 0; i < 86; ++i) {
        const auto strand = groom.strand(i);
        const glm::vec3 along = glm::normalize(strand[7] - strand[0]);
        EXPECT_GT(glm::dot(along, glm::normalize(strand[0])), 1.0f - 1e-4f);
        for (std::size_t v = 1; v < 7; ++v) {  // the strand is straight
            const float part = static_cast<float>(v) / 7.0f;
            EXPECT_LT(
                glm::distance(strand[v], glm::mix(strand[0], strand[7], part)), kPlaceRounding);
        }
    }
}

// A flat scalp has one normal, so directions are known exactly.
TEST(Grow, AddsTheCombToTheNormal) {
    const Mesh sheet = makeGrid(6, 6, [](std::uint32_t, std::uint32_t) { return false; });
    const GrowSettings settings{.length = 1.0f, .comb = {2.0f, 0.5f, -1.0f}};
    const glm::vec3 expected = glm::normalize(glm::vec3(2.0f, 1.5f, -1.0f));
    const Groom groom = grow(sheet, settings, 20, 1);
    for (std::uint32_t i = 0; i < 20; ++i) {
        const auto strand = groom.strand(i);
        // rounding of floats up to 7
        EXPECT_LT(glm::distance(strand[7] - strand[0], expected), 1e-6f);
    }
}

TEST(Grow, GivesTheScalpsNormalsWhateverTheComb) {
    const Mesh sheet = makeGrid(6, 6, [](std::uint32_t, std::uint32_t) { return false; });
    const Groom groom = grow(sheet, {.comb = {2.0f, 0.5f, -1.0f}}, 20, 1);
    EXPECT_EQ(groom.root_normals, std::vector<glm::vec3>(20, glm::vec3(0.0f, 1.0f, 0.0f)));
}

TEST(Grow, KeepsTheNormalWhereTheCombCancelsIt) {
    const Mesh sheet = makeGrid(6, 6, [](std::uint32_t, std::uint32_t) { return false; });
    const Groom groom = grow(sheet, {.length = 1.0f, .comb = {0.0f, -1.0f, 0.0f}}, 20, 1);
    EXPECT_LT(glm::distance(groom.strand(3)[7] - groom.strand(3)[0], glm::vec3(0, 1, 0)), 1e-6f);
}

// tan(t / 2) = tan(t0 / 2) exp(-droop s), t from the vertical, s at a segment's middle.
TEST(Grow, DroopsByItsFormula) {
    const Mesh sheet = makeGrid(2, 2, [](std::uint32_t, std::uint32_t) { return false; });
    const double droop = 6.0;
    const GrowSettings settings{.length = 0.35f, .comb = {1.0f, 0.0f, 0.0f}, .droop = 6.0f};
    const Groom groom = grow(sheet, settings, 9, 1);
    const double first = 0.75 * std::numbers::pi;  // the angle between (1, 1, 0) and (0, -1, 0)
    for (std::uint32_t i = 0; i < 9; ++i) {
        const auto strand = groom.strand(i);
        for (std::size_t segment = 0; segment < 7; ++segment) {
            const glm::dvec3 along = glm::dvec3(strand[segment + 1]) - glm::dvec3(strand[segment]);
            const double angle = std::atan2(along.x, -along.y);
            const double s = 0.05 * (static_cast<double>(segment) + 0.5);
            const double expected = 2.0 * std::atan(std::tan(0.5 * first) * std::exp(-droop * s));
            // Points near 2 are stored to 1.2e-7, segments are 0.05 long.
            EXPECT_NEAR(angle, expected, 1e-5);
            EXPECT_EQ(along.z, 0.0);
        }
    }
}

// The differential equation itself, by Runge-Kutta in 20,000 steps. The midpoint rule with 63
// segments stays within (droop l)^2 / 24 of the length in total.
TEST(Grow, DroopsByItsDifferentialEquation) {
    const Mesh head = headMesh();
    const GrowSettings settings{
        .vertices = 64, .length = 0.3f, .comb = {0.1f, 0.2f, -0.3f}, .droop = 10.0f};
    const Groom straight =
        grow(head, {.vertices = 2, .length = 0.3f, .comb = settings.comb}, 86, 1);
    const Groom groom = grow(head, settings, 86, 1);
    const auto bend = [](const glm::dvec3& d) { return 10.0 * (glm::dvec3(0, -1, 0) + d.y * d); };
    for (std::uint32_t i = 0; i < 86; i += 5) {
        glm::dvec3 position(straight.strand(i)[0]);
        glm::dvec3 direction = glm::normalize(glm::dvec3(straight.strand(i)[1]) - position);
        constexpr int steps = 20000;
        const double h = 0.3 / steps;
        for (int step = 0; step < steps; ++step) {
            const glm::dvec3 k1 = bend(direction);
            const glm::dvec3 k2 = bend(direction + 0.5 * h * k1);
            const glm::dvec3 k3 = bend(direction + 0.5 * h * k2);
            const glm::dvec3 k4 = bend(direction + h * k3);
            position += h * (direction + h / 6.0 * (k1 + k2 + k3));
            direction += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
        const double segment = 10.0 * 0.3 / 63.0;
        EXPECT_LT(
            glm::distance(position, glm::dvec3(groom.strand(i)[63])),
            0.3 * segment * segment / 24.0 + 1e-6);
    }
}

// A sheet with a picture of 4 by 1 pixels over its x: 0, 1/5, 3/5 and 1 of the brightness.
class GrowWithPictures : public testing::Test {
protected:
    GrowWithPictures() {
        for (const glm::vec3& position : sheet_.positions)
            sheet_.texture_coordinates.emplace_back(position.x / 4.0f, position.z / 4.0f);
        std::vector<std::uint8_t> pixels;
        for (const std::uint8_t grey : {0, 51, 153, 255})
            pixels.insert(pixels.end(), {grey, grey, grey, 255});
        engine::writePng(folder_.file("maps/steps.png"), 4, 1, pixels);
    }
    Groom grow(const GrowSettings& settings, std::uint32_t guides) const {
        return groom::grow(sheet_, settings, folder_.path(), guides, 1);
    }

    TemporaryFolder folder_;
    Mesh sheet_ = makeGrid(4, 4, [](std::uint32_t, std::uint32_t) { return false; });
};

double lengthOf(std::span<const glm::vec3> strand) {
    double length = 0.0;
    for (std::size_t i = 1; i < strand.size(); ++i)
        length += double{glm::distance(strand[i - 1], strand[i])};
    return length;
}

TEST_F(GrowWithPictures, MultipliesLengthsByTheMap) {
    const Groom groom = grow({.vertices = 5, .length = 2.0f, .length_map = "maps/steps.png"}, 300);
    const std::array<double, 6> values{0.0, 0.0, 0.2, 0.6, 1.0, 1.0};  // at x = -0.5, 0.5, ...
    for (std::uint32_t i = 0; i < 300; ++i) {
        const double x = double{groom.strand(i)[0].x} + 0.5;
        const auto step = std::min(static_cast<std::size_t>(x), std::size_t{4});
        const double part = x - static_cast<double>(step);
        const double map = (1.0 - part) * values[step] + part * values[step + 1];
        // Points up to 4 are stored to 2.4e-7, and there are four segments.
        EXPECT_NEAR(lengthOf(groom.strand(i)), std::max(2.0 * map, 0.001), 2e-6);
    }
}

TEST_F(GrowWithPictures, KeepsRootsUnderTheMask) {
    const Groom groom = grow({.mask = "maps/steps.png"}, 400);
    EXPECT_EQ(groom.strand_count, 400u);
    for (std::uint32_t i = 0; i < 400; ++i) EXPECT_GT(groom.strand(i)[0].x, 0.5f);
}

TEST_F(GrowWithPictures, SaysWhatIsWrongWithAPicture) {
    EXPECT_EQ(
        errorText([&] { grow({.mask = "maps/gone.png"}, 10); }),
        folder_.file("maps/gone.png").string() + ": no such file");
    sheet_.texture_coordinates.clear();
    for (const GrowSettings& settings :
         {GrowSettings{.mask = "maps/steps.png"}, GrowSettings{.length_map = "maps/steps.png"}}) {
        EXPECT_THAT(errorText([&] { grow(settings, 10); }), HasSubstr("no texture coordinates"));
    }
}

// Lengths are uniform from 0.4 to 1. The mean of n has the standard deviation 0.6 / sqrt(12 n); the
// test allows five.
TEST(Grow, VariesLengths) {
    const Groom groom =
        grow(makeCap(), {.length = 1.0f, .length_variation = 0.6f, .droop = 2.0f}, 1000, 1);
    double sum = 0.0;
    Extremes lengths;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto strand = groom.strand(i);
        const double length = lengthOf(strand);
        EXPECT_LE(length, 1.0 + 1e-5);
        EXPECT_GE(length, 0.4 - 1e-5);
        for (std::size_t v = 1; v < strand.size(); ++v)
            EXPECT_NEAR(double{glm::distance(strand[v - 1], strand[v])}, length / 7.0, 1e-6);
        sum += length;
        lengths.add(length);
    }
    EXPECT_NEAR(sum / 1000.0, 0.7, 5.0 * 0.6 / std::sqrt(12000.0));
    EXPECT_LT(lengths.least(), 0.41);
}

// "*" takes everything, even on a mesh without names.
TEST(Grow, TakesAWholeMesh) {
    Mesh sphere = makeSphere(0.1, 24, 12);
    sphere.materials[0].name = "";
    for (const std::uint32_t guides : {1u, 2u, 3u, 50u, 1000u}) {
        const Groom groom = grow(sphere, {.scalp = "*"}, guides, 1);
        EXPECT_EQ(groom.strand_count, guides);
        EXPECT_EQ(groom.root_normals.size(), guides);
        EXPECT_FALSE(groom.root_triangles.empty());
    }
}

TEST(Grow, CombsAwayFromAParting) {
    GrowSettings settings;
    settings.parting = {.from = {0.0f, 0.05f, 0.2f}, .to = {0.0f, 0.12f, -0.03f}, .strength = 2.0f};
    const Groom groom = grow(makeCap(), settings, 500, 1);
    for (std::uint32_t i = 0; i < 500; ++i) {
        const glm::vec3 root = groom.strand(i)[0];
        if (root.z < -0.02f || std::abs(root.x) < 0.0003f) continue;
        const glm::vec3 along = groom.strand(i)[1] - root;
        // The strand leans away from the parting more than the normal alone does.
        EXPECT_GT(along.x / root.x, glm::length(along) / 0.1f);
    }
}

TEST(Grow, RefusesMeshesWithoutAScalp) {
    Mesh mesh = makeCap();
    mesh.materials[1].name = "felt";
    EXPECT_EQ(
        errorText([&] { grow(mesh, {}, 86, 1); }),
        "nothing in the mesh is named 'scalp'; materials: 'skin', 'felt'; parts: none; vertex "
        "groups: none");
}

}  // namespace
}  // namespace hair::groom
