#include "hair/groom/guides/bind_strands.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <gmock/gmock.h>

#include "hair/groom/guides/choose_guides.h"
#include "hair/random.h"
#include "tests/groom/style/sample_strands.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

using testing::Each;
using testing::ElementsAre;

// A groom on the square [0, size]^2 of the plane y = 0: lattice strands first, then random ones.
struct Patch {
    std::uint32_t side;  // guides along an edge
    std::uint32_t others;
    double size;

    double spacing() const { return size / (side - 1); }
    std::uint32_t strands() const { return side * side + others; }
    glm::dvec3 root(std::uint32_t strand) const {
        if (strand < side * side) return spacing() * glm::dvec3(strand % side, 0.0, strand / side);
        return size * glm::dvec3(random01(3, strand, 1), 0.0, random01(3, strand, 2));
    }
    std::vector<std::uint32_t> guides() const {
        std::vector<std::uint32_t> indices(side * side);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
};

glm::dvec3 boundRoot(const StrandBinding& binding, const Groom& guides) {
    glm::dvec3 root(binding.offset);
    for (int i = 0; i < 3; ++i)
        root += double{binding.weights[i]} *
                glm::dvec3(guides.strand(binding.guides[static_cast<std::size_t>(i)])[0]);
    return root;
}

ReconstructionError errorOf(const Groom& dense, const std::vector<std::uint32_t>& guides) {
    return reconstructionError(dense, pickStrands(dense, guides), bindStrands(dense, guides));
}

TEST(BindStrands, GivesWeightsOfAMeanAndKeepsRoots) {
    const Patch patch{6, 300, 0.1};
    const Groom dense = sampleGroom(patch.strands(), 5, [&](std::uint32_t strand, double t) {
        const double turn = 40.0 * random01(1, strand, 7);
        return patch.root(strand) + t * glm::dvec3(0.1 * std::cos(turn), 0.2, 0.1 * std::sin(turn));
    });
    const Groom guides = pickStrands(dense, patch.guides());
    const auto bindings = bindStrands(dense, patch.guides());
    ASSERT_EQ(bindings.size(), dense.strand_count);
    for (std::uint32_t i = 0; i < dense.strand_count; ++i) {
        const glm::vec3 weights = bindings[i].weights;
        EXPECT_NEAR(double{weights.x} + weights.y + weights.z, 1.0, 1.2e-7);  // two roundings at 1
        EXPECT_GE(std::min({weights.x, weights.y, weights.z}), 0.0f);
        // The offset's and the weights' rounding, at 0.1.
        EXPECT_LT(
            glm::distance(boundRoot(bindings[i], guides), glm::dvec3(dense.strand(i)[0])), 1e-8);
        if (i >= guides.strand_count) continue;
        EXPECT_THAT(bindings[i].guides, Each(i));
        EXPECT_EQ(weights, glm::vec3(1, 0, 0));
        EXPECT_EQ(bindings[i].offset, glm::vec3(0));
    }
}

// If a strand's points are an affine function of its root, the barycentric mean of the guides
// round it is the strand itself. All roots are inside the lattice.
TEST(BindStrands, IsExactForAffineGrooms) {
    const Patch patch{8, 500, 0.2};
    const glm::dmat3 shear{{2.0, 0.5, 0.0}, {0.0, 1.0, 0.0}, {-0.5, 1.0, 1.5}};
    const Groom dense = sampleGroom(patch.strands(), 6, [&](std::uint32_t strand, double t) {
        const glm::dvec3 root = patch.root(strand);
        return root + t * (shear * root) + glm::dvec3(0.1 * t, 0.3 * t, -0.2 * t * t);
    });
    const ReconstructionError error = errorOf(dense, patch.guides());
    EXPECT_LT(error.maximum, 3e-7);  // rounding of floats up to 1
    EXPECT_GE(error.maximum, error.percentile95);
}

// Tips go sideways by c |root|^2. Linear interpolation in a triangle is off by c (R^2 - d^2), d
// from the centre of its circle of radius R, at most c h^2 / 2 in a lattice of spacing h. The
// offset is linear along the strand. So the error falls with the square of the spacing. Binding
// minimises the sum of squares, but accepts 1e-6 of the squares of the distances in exchange for a
// smaller triangle.
TEST(BindStrands, ErrsWithTheSquareOfTheSpacing) {
    constexpr double curvature = 2.0;  // 1 / m
    const auto errorAt = [](std::uint32_t side) {
        const Patch patch{side, 2000, 0.2};
        const Groom dense = sampleGroom(patch.strands(), 6, [&](std::uint32_t strand, double t) {
            const glm::dvec3 root = patch.root(strand);
            return root + t * glm::dvec3(curvature * glm::dot(root, root), 0.3, 0.0);
        });
        const ReconstructionError error = errorOf(dense, patch.guides());
        const double h = patch.spacing();
        const double bound = curvature * h * h / 2.0;
        EXPECT_LT(error.maximum, std::hypot(bound, 0.001 * h) + 1e-7);
        return error.mean;
    };
    const double coarse = errorAt(6);
    const double fine = errorAt(11);
    EXPECT_NEAR(coarse / fine, 4.0, 1.0);
}

// Hair falls to both sides of a parting, and a strand between the two sides is like neither. Guides
// of the other side differ by s in shape. With a weight w they bring a root up to w h nearer that
// is
// d <= h beyond the last guide. The sum of squares (d - w h)^2 + (w s)^2 is least at w = d h /
// (h^2 + s^2).
TEST(BindStrands, HardlyMixesTheSidesOfAParting) {
    const Patch patch{10, 800, 0.1};
    const auto side = [&](std::uint32_t strand) {
        return patch.root(strand).x < 0.05 ? -1.0 : 1.0;
    };
    const Groom dense = sampleGroom(patch.strands(), 6, [&](std::uint32_t strand, double t) {
        return patch.root(strand) + glm::dvec3(0.3 * side(strand) * t, -0.1 * t, 0.0);
    });
    const double apart = 0.6 * std::sqrt((1 + 4 + 9 + 16 + 25) / 25.0 / 5.0);  // root mean square
    const double most = std::pow(patch.spacing() / apart, 2.0);
    const auto bindings = bindStrands(dense, patch.guides());
    for (std::uint32_t i = 0; i < dense.strand_count; ++i) {
        double other = 0.0;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t guide = bindings[i].guides[static_cast<std::size_t>(k)];
            if (side(guide) != side(i)) other += bindings[i].weights[k];
        }
        EXPECT_LE(other, most);
    }
}

TEST(BindStrands, TakesTheTriangleRoundTheRoot) {
    const Patch patch{10, 300, 0.09};
    const Groom dense = sampleGroom(patch.strands(), 3, [&](std::uint32_t strand, double t) {
        return patch.root(strand) + glm::dvec3(0.0, 0.2 * t, 0.0);
    });
    const Groom guides = pickStrands(dense, patch.guides());
    for (const StrandBinding& binding : bindStrands(dense, patch.guides())) {
        glm::dvec3 low(1.0), high(-1.0);
        for (const std::uint32_t guide : binding.guides) {
            low = glm::min(low, glm::dvec3(guides.strand(guide)[0]));
            high = glm::max(high, glm::dvec3(guides.strand(guide)[0]));
        }
        EXPECT_LE(std::max(high.x - low.x, high.z - low.z), 0.01 + 1e-8);  // within one cell
    }
}

TEST(BindStrands, TakesFewerThanThreeGuides) {
    const Groom dense = verticalStrands(3, 2, 0.1, 0.25);
    const auto to_one = bindStrands(dense, {1});
    EXPECT_EQ(to_one[0].weights, glm::vec3(1, 0, 0));
    EXPECT_EQ(to_one[0].offset, glm::vec3(-0.25f, 0, 0));
    EXPECT_THAT(to_one[2].guides, Each(0));
    const auto to_two = bindStrands(dense, {0, 2});
    EXPECT_EQ(to_two[1].weights, glm::vec3(0.5f, 0.5f, 0));
    EXPECT_EQ(to_two[1].offset, glm::vec3(0));
    EXPECT_LT(reconstructionError(dense, pickStrands(dense, {0, 2}), to_two).maximum, 1e-8);
}

TEST(BindStrands, TakesAwkwardStrands) {
    const Groom dense = awkwardStrands();
    for (const std::vector<std::uint32_t>& guides :
         {std::vector{0u}, std::vector{0u, 1u}, std::vector{0u, 2u, 3u},
          std::vector{0u, 1u, 2u, 3u}})
        EXPECT_TRUE(std::isfinite(errorOf(dense, guides).maximum));
    const Groom same(
        sampleGroom(20, 3, [](std::uint32_t, double t) { return glm::dvec3(t, 0, 0); }));
    EXPECT_EQ(errorOf(same, {3, 7, 11, 12}).maximum, 0.0);
}

TEST(BindStrands, ErrsLessWithMoreGuides) {
    const Groom dense = sampleGroom(4000, 8, [](std::uint32_t strand, double t) {
        const double x = random01(5, strand, 1) - 0.5, z = random01(5, strand, 2) - 0.5;
        return 0.2 * glm::dvec3(x, -x * x - z * z, z) +
               t * glm::dvec3(0.1 * std::sin(6.0 * z), 0.2 - 0.2 * t, 0.2 * x * t);
    });
    double last = 1.0;
    for (const std::uint32_t count : {30u, 120u, 480u}) {
        const double error = errorOf(dense, chooseGuides(dense, count, 1)).mean;
        EXPECT_LT(error, 0.5 * last);  // a quarter of it remains, except outside all guides
        last = error;
    }
}

TEST(ReconstructionError, MeasuresVertexAgainstVertex) {
    const Groom dense = sampleGroom(2, 3, [](std::uint32_t strand, double t) {
        return strand == 0 ? glm::dvec3(0, 2 * t, 0) : glm::dvec3(1, 4 * t, 0);
    });
    const Groom guides = pickStrands(dense, {0});
    std::vector<StrandBinding> bindings(2);
    bindings[1].offset = {1, 0, 0};
    // The second is off by 0, 1 and 2.
    const ReconstructionError error = reconstructionError(dense, guides, bindings);
    EXPECT_DOUBLE_EQ(error.mean, 0.5);
    EXPECT_DOUBLE_EQ(error.rms, std::sqrt(5.0 / 6.0));
    EXPECT_DOUBLE_EQ(error.percentile95, 1.0);
    EXPECT_DOUBLE_EQ(error.maximum, 2.0);
    EXPECT_DOUBLE_EQ(error.relative, 0.5 / 3.0);
}

// The test tries all weights in steps. None is better than the search's result by more than the
// weight of nearness.
TEST(NearestMean, IsTheNearestOfAll) {
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        std::array<glm::dvec3, 5> points;
        for (std::uint32_t i = 0; i < 5; ++i)
            points[i] = glm::dvec3(
                            random01(seed, i, 1), random01(seed, i, 2),
                            seed % 3 == 0 ? 0.0 : random01(seed, i, 3)) -
                        glm::dvec3(0.3);
        GramMatrix gram{.count = points.size()};
        Extremes squares;
        for (std::size_t i = 0; i < 5; ++i) {
            squares.add(glm::dot(points[i], points[i]));
            for (std::size_t j = 0; j < 5; ++j) gram.of[i][j] = glm::dot(points[i], points[j]);
        }
        Extremes tried;
        constexpr int steps = 20;
        for (std::size_t i = 0; i < 5; ++i)
            for (std::size_t j = 0; j < i; ++j)
                for (std::size_t k = 0; k < j; ++k)
                    for (int a = 0; a <= steps; ++a)
                        for (int b = 0; a + b <= steps; ++b) {
                            const glm::dvec3 mean = (double(a) * points[i] + double(b) * points[j] +
                                                     double(steps - a - b) * points[k]) /
                                                    double(steps);
                            tried.add(glm::dot(mean, mean));
                        }
        const Mean mean = nearestMean(gram);
        glm::dvec3 found(0.0);
        for (std::size_t i = 0; i < 3; ++i) found += mean.weights[i] * points[mean.members[i]];
        EXPECT_LE(glm::dot(found, found), tried.least() + 1e-6 * squares.greatest());
        EXPECT_TRUE(std::ranges::is_sorted(mean.weights, std::greater<>()));
        EXPECT_GE(mean.weights[2], 0.0);
        EXPECT_NEAR(mean.weights[0] + mean.weights[1] + mean.weights[2], 1.0, 1e-12);
    }
}

}  // namespace
}  // namespace hair::groom
