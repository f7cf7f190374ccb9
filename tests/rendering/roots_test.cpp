#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "hair/rendering/renderer.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/rendering/device_hair.h"

// The places of strands in their root triangles: thesis 2.3.2.
namespace hair::rendering {
namespace {

class RootsTest : public GpuTest {
protected:
    // Roots of all strands, [triangle][strand].
    static std::vector<glm::vec3>
    roots(const groom::Groom& groom, std::uint32_t density, std::uint32_t seed = 1) {
        const DeviceHair hair(device(), groom);
        const StrandPoints points = evaluateStrandPoints(
            device(), {.seed = seed, .strands = {.density = density, .tessellation = 1}},
            hair.view());
        std::vector<glm::vec3> result;
        for (std::uint32_t triangle = 0; triangle < points.plan.triangles; ++triangle) {
            for (std::uint32_t strand = 0; strand < density; ++strand) {
                result.push_back(points.at(triangle, strand, 0, 0).position);
            }
        }
        return result;
    }
};

// Ten roundings of the curve on numbers of up to 3, those of the reflected points.
constexpr float kWeightTolerance = 30 * kUlp;

TEST_F(RootsTest, WeightsAreBarycentric) {
    for (const glm::vec3& weights : roots(unitTriangles(136), 64)) {
        EXPECT_GE(std::min({weights.x, weights.y, weights.z}), -kWeightTolerance);
        EXPECT_NEAR(weights.x + weights.y + weights.z, 1.0f, 3 * kWeightTolerance);
    }
}

// Uniform in the triangle: E[w] = 1/3, Var[w] = 1/18; E[w^2] = 1/6, Var[w^2] = 1/15 - 1/36 = 7/180;
// E[w w'] = 1/12, Var[w w'] = 1/90 - 1/144 = 1/240 (Dirichlet distribution with all parameters 1).
// The mean of n is within 4 deviations; the random numbers are the same on every run.
TEST_F(RootsTest, FillTheTriangleEvenly) {
    glm::dvec3 mean(0.0);
    glm::dvec3 squares(0.0);
    glm::dvec3 products(0.0);
    const std::vector<glm::vec3> all = roots(unitTriangles(136), 64);
    for (const glm::dvec3 w : all) {
        mean += w;
        squares += w * w;
        products += glm::dvec3(w.x * w.y, w.y * w.z, w.z * w.x);
    }
    const auto count = static_cast<double>(all.size());
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mean[i] / count, 1.0 / 3.0, 4.0 * std::sqrt(1.0 / 18.0 / count));
        EXPECT_NEAR(squares[i] / count, 1.0 / 6.0, 4.0 * std::sqrt(7.0 / 180.0 / count));
        EXPECT_NEAR(products[i] / count, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 240.0 / count));
    }
}

// The seed of this strand, found by search, gives u = 8299944 / 2^24 and v = 8477273 / 2^24. Their
// sum 1 + 2^-24 rounds to 1. Unfolded, its third weight would be negative.
TEST_F(RootsTest, FoldsWhatIsBeyondTheEdgeByOneBit) {
    const glm::vec3 weights = roots(unitTriangles(1), 24, 130704).back();
    EXPECT_NEAR(weights.x, 1.0f - 8299944.0f * kUlp, kWeightTolerance);
    EXPECT_NEAR(weights.y, 1.0f - 8477273.0f * kUlp, kWeightTolerance);
}

// The published program has one pattern for all triangles. Two 24-bit numbers a strand: among 8,704
// strands an accidental pair has probability 8704^2 / 2 / 2^48 = 1.3e-7.
TEST_F(RootsTest, NoTwoStrandsAreTheSame) {
    std::set<std::tuple<float, float, float>> different;
    for (const glm::vec3& w : roots(unitTriangles(136), 64)) different.insert({w.x, w.y, w.z});
    EXPECT_EQ(different.size(), 8704u);
}

TEST_F(RootsTest, SeedChoosesTheStrands) {
    const std::vector<glm::vec3> first = roots(unitTriangles(3), 64, 1);
    EXPECT_EQ(first, roots(unitTriangles(3), 64, 1));
    const std::vector<glm::vec3> other = roots(unitTriangles(3), 64, 2);
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NE(first[i], other[i]);
}

// A root triangle with corners on the unit sphere, `edge` apart, and the sphere's normals.
groom::Groom onSphere(double edge) {
    const double sine = edge / std::sqrt(3.0);  // of the angle to the axis
    std::array<std::vector<glm::vec3>, 3> guides;
    std::vector<glm::vec3> normals;
    for (std::size_t i = 0; i < 3; ++i) {
        const double turn = 2.0 * std::acos(-1.0) * static_cast<double>(i) / 3.0;
        const glm::dvec3 root(
            sine * std::cos(turn), std::sqrt(1.0 - sine * sine), sine * std::sin(turn));
        guides[i] = {root, 1.25 * root};
        normals.push_back(root);
    }
    groom::Groom groom = oneTriangle(guides);
    groom.root_normals = normals;
    return groom;
}

// With edges of length e on a unit sphere, weights w and S = sum of w w' e^2 over the edges, at
// most e^2 / 3:
//   flat:   |p|^2 = 1 - S
//   lifted: |q|^2 = 1 - sum over the edges ij of w_i w_j e^2 sum_k w_k (d_ki^2 + d_kj^2) / 4 +
//   |L|^2
// where d_ki is the length of edge ki, sum_k is at most 2 e^2 and |L| at most e^2 / 6. So
//   -e^4 / 6 <= |q|^2 - 1 <= e^4 / 36,
// fourth order, where the flat triangle is off by second order.
TEST_F(RootsTest, LiftPutsThemOnASphereToFourthOrder) {
    for (const double edge : {0.2, 0.4, 0.8}) {
        const double fourth = edge * edge * edge * edge;
        constexpr double kSquaredRounding = 40 * kUlp;  // of numbers of size 1, squared
        for (const glm::dvec3 root : roots(onSphere(edge), 1000)) {
            EXPECT_GE(glm::dot(root, root) - 1.0, -fourth / 6.0 - kSquaredRounding) << edge;
            EXPECT_LE(glm::dot(root, root) - 1.0, fourth / 36.0 + kSquaredRounding) << edge;
        }
        groom::Groom flat = onSphere(edge);
        flat.root_normals.clear();
        Extremes squares;
        for (const glm::dvec3 root : roots(flat, 1000)) squares.add(glm::dot(root, root));
        // S > 0.3 e^2 is a disc round the centroid that has 0.24 of the triangle's area.
        EXPECT_LT(squares.least(), 1.0 - 0.3 * edge * edge) << edge;
    }
}

// The whole strand moves with its root.
TEST_F(RootsTest, LiftMovesTheStrandAsAWhole) {
    const groom::Groom lifted = tangledGroom(6);
    groom::Groom flat = lifted;
    flat.root_normals.clear();
    const Settings settings{.strands = {.density = 30, .tessellation = 2}};
    const DeviceHair lifted_hair(device(), lifted);
    const DeviceHair flat_hair(device(), flat);
    const StrandPoints a = evaluateStrandPoints(device(), settings, lifted_hair.view());
    const StrandPoints b = evaluateStrandPoints(device(), settings, flat_hair.view());
    for (std::uint32_t strand = 0; strand < 30; ++strand) {
        const glm::vec3 offset = a.at(2, strand, 0, 0).position - b.at(2, strand, 0, 0).position;
        EXPECT_GT(glm::length(offset), 0.0f);
        for (std::uint32_t i = 0; i < 5 * 3; ++i) {
            const auto& moved = a.at(2, strand, i / 3, i % 3);
            const auto& still = b.at(2, strand, i / 3, i % 3);
            // Two sums and two differences of numbers below 1.
            EXPECT_LT(glm::distance(moved.position - still.position, offset), 4 * 2 * kUlp);
            EXPECT_EQ(moved.tangent, still.tangent);
        }
    }
}

}  // namespace
}  // namespace hair::rendering
