#include "hair/rendering/strand_offsets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/groom/build_groom.h"
#include "hair/groom/files.h"
#include "hair/random.h"
#include "hair/rendering/renderer.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/device_hair.h"
#include "tests/rendering/pictures.h"
#include "tests/temporary_folder.h"

// Tests that the strands of a file are drawn unchanged, for any guides.
namespace hair::rendering {
namespace {

// The promised errors of strands at rest, and of a rigid motion, m.
constexpr double kAtRest = 0.05e-3;
constexpr double kRigid = 1e-5;

// The distance of two places; throws on a NaN or an infinity.
double apart(const glm::dvec3& a, const glm::dvec3& b) {
    const double distance = glm::distance(a, b);
    if (!std::isfinite(distance)) throw std::runtime_error("a point is not finite");
    return distance;
}

double number(std::uint32_t strand, std::uint32_t purpose) { return random01(7, strand, purpose); }

// A curl or a wave with its own phase, length and size, on a spherical cap of radius 0.1 m.
class Wisp {
public:
    explicit Wisp(std::uint32_t strand)
        : phase_(kTurn * number(strand, 1)), length_(0.15 + 0.15 * number(strand, 2)),
          radius_(0.002 + 0.006 * number(strand, 3)), turns_(20.0 + 15.0 * number(strand, 4)),
          flatness_(strand % 2 == 0 ? 1.0 : 0.0) {
        const double height = 0.2 + 0.8 * number(strand, 5);
        const double angle = kTurn * number(strand, 6);
        const double aside = std::sqrt(1.0 - height * height);
        up_ = {aside * std::cos(angle), height, aside * std::sin(angle)};
        across_ = glm::normalize(glm::cross(up_, glm::dvec3(0.3, 0.1, 1.0)));
        root_ = 0.1 * up_ - at(0.0);
    }

    // u in [0, 1]; the farther out the strand is, the more it bends down.
    glm::dvec3 at(double u) const {
        const double s = u * length_;
        const double grows = std::min(u / 0.1, 1.0);
        const double angle = kTurn * turns_ * s + phase_;
        const glm::dvec3 middle = s * up_ - glm::dvec3(0.0, 0.8 * s * s, 0.0);
        return root_ + middle +
               radius_ * grows *
                   (std::cos(angle) * across_ +
                    flatness_ * std::sin(angle) * glm::cross(up_, across_));
    }

private:
    double phase_, length_, radius_, turns_, flatness_;
    glm::dvec3 up_, across_;
    glm::dvec3 root_{0.0};
};

// Strand `i` has sizes[i % sizes.size()] points. With a `bunching` of 1, the points are evenly
// spaced along the curve; with more, they are nearer to the root.
groom::StrandSet
wisps(std::uint32_t count, std::span<const std::uint32_t> sizes, double bunching = 1.0) {
    groom::StrandSet set{.metres_per_unit = 1.0};
    for (std::uint32_t strand = 0; strand < count; ++strand) {
        const Wisp wisp(strand);
        const std::uint32_t points = sizes[strand % sizes.size()];
        for (std::uint32_t k = 0; k < points; ++k)
            set.points.emplace_back(wisp.at(std::pow(k / (points - 1.0), bunching)));
        set.ends.push_back(static_cast<std::uint32_t>(set.points.size()));
    }
    return set;
}

groom::Groom groomOf(
    const groom::StrandSet& strands, std::uint32_t guides, std::uint32_t vertices = 0,
    const StyleSettings& style = {}) {
    const TemporaryFolder folder;
    groom::exportStrands(strands, folder.file("strands.ply"));
    return groom::buildGroom(
        {.file = "strands.ply", .vertices = vertices, .guides = guides, .style = style}, nullptr,
        folder.path(), 1);
}

// The strands in the drawn order.
std::vector<std::uint32_t> drawnOrder(const groom::Groom& groom, std::uint32_t seed) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> keys;
    for (std::uint32_t i = 0; i < groom.bindings.size(); ++i)
        keys.emplace_back(hash(seed, i, gpu::kOrderPurpose), i);
    std::ranges::sort(keys);
    std::vector<std::uint32_t> order;
    for (const auto& [key, i] : keys) order.push_back(i);
    return order;
}

groom::Groom withoutResiduals(groom::Groom groom) {
    groom.bound_ends.clear();
    groom.bound_points.clear();
    return groom;
}

Settings ownStrands(std::uint32_t tessellation, Curve curve = Curve::bspline) {
    return {
        .strands = {.source = StrandSource::groom, .tessellation = tessellation, .curve = curve}};
}

class StrandResidualsTest : public GpuTest {
protected:
    // Strands of `groom` when its guides have the positions of those of `now`.
    static StrandPoints evaluate(
        const groom::Groom& groom, const Settings& settings, const groom::Groom& now,
        const glm::mat4& head = glm::mat4(1.0f)) {
        const DeviceHair rest(device(), groom, settings);
        const DeviceHair moved(device(), withoutResiduals(now), {});
        StrandView view = rest.view();
        view.guides = moved.view().guides;
        view.head = head;
        return evaluateStrandPoints(device(), settings, view);
    }
    static StrandPoints evaluate(const groom::Groom& groom, const Settings& settings) {
        return evaluate(groom, settings, groom);
    }

    // The drawn polyline of a strand, root first.
    static std::vector<glm::dvec3> line(const StrandPoints& points, std::uint32_t strand) {
        std::vector<glm::dvec3> line;
        for (std::uint32_t segment = 0; segment < points.plan.segments; ++segment)
            for (std::uint32_t k = segment == 0 ? 0 : 1; k <= points.plan.forced_tessellation; ++k)
                line.emplace_back(points.at(0, strand, segment, k).position);
        return line;
    }

    // The greatest distance from a point of the file to the drawn point at the same place; drawn
    // points are `times` times as dense.
    static double farthest(
        const groom::Groom& groom, const groom::StrandSet& file, const Settings& settings,
        std::uint32_t times) {
        const StrandPoints points = evaluate(groom, settings);
        EXPECT_EQ(points.plan.strands(), file.strandCount());
        const std::vector<std::uint32_t> order = drawnOrder(groom, settings.seed);
        double greatest = 0.0;
        for (std::uint32_t drawn = 0; drawn < order.size(); ++drawn) {
            const auto strand = file.strand(order[drawn]);
            const std::vector<glm::dvec3> polyline = line(points, drawn);
            if (polyline.size() != (strand.size() - 1) * times + 1)
                throw std::runtime_error("other numbers of points");
            for (std::size_t k = 0; k < strand.size(); ++k)
                greatest = std::max(greatest, apart(polyline[k * times], glm::dvec3(strand[k])));
        }
        return greatest;
    }
};

double toSegment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0.0 ? glm::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
    return apart(point, a + t * along);
}

// The greatest distance of a point of the file from the drawn line.
double farthestFrom(std::span<const glm::vec3> strand, const std::vector<glm::dvec3>& line) {
    double greatest = 0.0;
    for (const glm::vec3& point : strand) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            nearest = std::min(nearest, toSegment(glm::dvec3(point), line[i], line[i + 1]));
        greatest = std::max(greatest, nearest);
    }
    return greatest;
}

// ---- At rest ------------------------------------------------------------------------------------

TEST_F(StrandResidualsTest, StrandsGoThroughTheFilesPoints) {
    constexpr std::uint32_t kPoints = 24;
    const groom::StrandSet file = wisps(600, std::array{kPoints});
    for (const std::uint32_t guides : {3u, 30u, 300u, 600u}) {
        const groom::Groom groom = groomOf(file, guides);
        ASSERT_EQ(groom.bindings.size(), 600u);
        for (const Curve curve : {Curve::bspline, Curve::bspline_unpinned, Curve::catmull_rom})
            EXPECT_LT(farthest(groom, file, ownStrands(3, curve), 3), kAtRest) << guides;
        // The residuals matter: without them curls are several millimetres off.
        EXPECT_GT(farthest(withoutResiduals(groom), file, ownStrands(3), 3), 2e-3) << guides;
    }
}

TEST_F(StrandResidualsTest, StrandsGoThroughTheFilesPointsHoweverGuidesAreMixed) {
    const groom::StrandSet file = wisps(200, std::array{16u});
    const groom::Groom groom = groomOf(file, 20);
    Settings settings = ownStrands(2);
    for (const Interpolation way : {Interpolation::single, Interpolation::mixed}) {
        settings.strands.interpolation = way;
        settings.strands.blend = 0.3f;
        EXPECT_LT(farthest(groom, file, settings, 2), kAtRest);
    }
}

// The curves space the points evenly to 2 %. At 900 pieces the points of the file are next to
// drawn ones, and the rest is the arc between them.
TEST_F(StrandResidualsTest, StrandsOfAnyNumberOfPointsGoThroughThem) {
    for (const double bunching : {1.0, 2.5}) {
        const groom::StrandSet file = wisps(200, std::array{2u, 3u, 16u, 21u, 46u, 100u}, bunching);
        for (const std::uint32_t guides : {3u, 30u, 150u}) {
            const groom::Groom groom = groomOf(file, guides, 16);
            ASSERT_EQ(groom.vertices_per_strand, 16u);
            const StrandPoints points = evaluate(groom, ownStrands(60));
            const std::vector<std::uint32_t> order = drawnOrder(groom, 1);
            ASSERT_EQ(points.plan.strands(), order.size());
            double greatest = 0.0;
            for (std::uint32_t drawn = 0; drawn < order.size(); ++drawn)
                greatest = std::max(
                    greatest, farthestFrom(file.strand(order[drawn]), line(points, drawn)));
            // A strand of 0.3 m in 900 pieces with turns of radius 2 mm has a sagitta of 7 um.
            EXPECT_LT(greatest, kAtRest) << guides << ' ' << bunching;
        }
    }
}

// Between points, too, the strand is that of the file, as far as the points define it. The cubic's
// slopes are off by h^2 / 6 of the third derivative, and the curve by at most h^3 / 24 of it.
TEST_F(StrandResidualsTest, StrandsAreSmoothBetweenThePoints) {
    constexpr std::uint32_t kPoints = 121;
    const groom::StrandSet file = wisps(100, std::array{kPoints});
    const groom::Groom groom = groomOf(file, 10);
    const StrandPoints points = evaluate(groom, ownStrands(4));
    const std::vector<std::uint32_t> order = drawnOrder(groom, 1);
    double greatest = 0.0;
    for (std::uint32_t drawn = 0; drawn < order.size(); ++drawn) {
        const Wisp wisp(order[drawn]);
        const std::vector<glm::dvec3> polyline = line(points, drawn);
        ASSERT_EQ(polyline.size(), (kPoints - 1) * 4 + 1);
        for (std::size_t i = 0; i < polyline.size(); ++i)
            greatest = std::max(
                greatest,
                apart(polyline[i], wisp.at(static_cast<double>(i) / (polyline.size() - 1.0))));
    }
    // h = 2.5 mm with 35 turns a metre round 8 mm: 8 mm (0.55)^3 / 24 = 55 um. At the kink in the
    // radius at a tenth of the length it is h / 8 of the slope's change, 8 mm / 30 mm.
    EXPECT_LT(greatest, 0.1e-3);
}

TEST_F(StrandResidualsTest, TangentsAreThoseOfTheCurveAtRest) {
    const groom::StrandSet file = wisps(50, std::array{16u});
    const groom::Groom groom = groomOf(file, 5);
    constexpr std::uint32_t kPieces = 64;
    const StrandPoints points = evaluate(groom, ownStrands(kPieces));
    for (std::uint32_t strand = 0; strand < 50; ++strand) {
        for (std::uint32_t segment = 0; segment < 15; ++segment) {
            for (std::uint32_t k = 1; k < kPieces; ++k) {
                const glm::dvec3 before(points.at(0, strand, segment, k - 1).position);
                const glm::dvec3 behind(points.at(0, strand, segment, k + 1).position);
                const glm::dvec3 slope = (behind - before) * (kPieces / 2.0);
                const glm::dvec3 tangent(points.at(0, strand, segment, k).tangent);
                // Positions round to 1.5e-8, 32 times: 1e-6 of some 0.02 m, and differences leave
                // out a sixth of the third derivative, some 0.1 m, by 1 / 64 squared.
                ASSERT_LT(apart(slope, tangent), 1e-4) << segment << ' ' << k;
            }
        }
    }
}

TEST_F(StrandResidualsTest, StyledStrandsAreThoseThatStylingMade) {
    const groom::StrandSet file = wisps(100, std::array{31u});
    StyleSettings style;
    style.frizz.amplitude = 0.004f;
    const groom::Groom all = groomOf(file, 0, 16, style);
    const groom::Groom groom = groomOf(file, 10, 16, style);
    // With all strands as guides these are the styled strands.
    groom::StrandSet styled{.points = all.points};
    for (std::uint32_t i = 1; i <= 100; ++i) styled.ends.push_back(16 * i);
    EXPECT_LT(farthest(groom, styled, ownStrands(3), 3), kAtRest);
    // If styling does nothing, all 31 points of the file stay.
    style.frizz.amplitude = 0.0f;
    EXPECT_EQ(groomOf(file, 10, 16, style).bound_points.size(), 3100u);
}

TEST_F(StrandResidualsTest, StrandsOfNoLengthStayWhereTheyAre) {
    groom::StrandSet file = wisps(20, std::array{12u});
    for (std::uint32_t strand : {3u, 11u}) {
        for (std::uint32_t k = 0; k < 12; ++k) file.points[12 * strand + k] = {0.02f, 0.12f, 0.01f};
    }
    for (std::uint32_t k = 4; k < 9; ++k) file.points[12 * 5 + k] = file.points[12 * 5 + 3];
    const groom::Groom groom = groomOf(file, 4);
    EXPECT_LT(farthest(groom, file, ownStrands(2), 2), kAtRest);
    for (const std::uint32_t vertices : {2u, 7u, 30u}) {
        const groom::Groom other = groomOf(file, 4, vertices);
        const StrandPoints points = evaluate(other, ownStrands(64));
        const std::vector<std::uint32_t> order = drawnOrder(other, 1);
        for (std::uint32_t drawn = 0; drawn < order.size(); ++drawn) {
            // 64 pieces between two guide vertices: a sagitta of 0.3 mm on a radius of 2 mm.
            EXPECT_LT(
                farthestFrom(file.strand(order[drawn]), line(points, drawn)),
                vertices == 2 ? 1.5e-3 : kAtRest)
                << vertices << ' ' << order[drawn];
        }
    }
}

// ---- In motion ----------------------------------------------------------------------------------

groom::Groom moved(groom::Groom groom, const glm::dmat4& matrix) {
    for (glm::vec3& point : groom.points)
        point = glm::vec3(matrix * glm::dvec4(glm::dvec3(point), 1.0));
    return groom;
}

TEST_F(StrandResidualsTest, ARigidMotionOfTheHeadCarriesStrandsRigidly) {
    const groom::StrandSet file = wisps(200, std::array{20u});
    const groom::Groom groom = groomOf(file, 12);
    const StrandPoints rest = evaluate(groom, ownStrands(3));
    for (const double angle : {0.3, 2.0, 3.1415926, 4.5}) {
        const glm::dmat4 matrix = glm::rotate(
            glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, -0.1, 0.3)), angle,
            glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
        const StrandPoints turned =
            evaluate(groom, ownStrands(3), moved(groom, matrix), glm::mat4(matrix));
        ASSERT_EQ(turned.records.size(), rest.records.size());
        double greatest = 0.0;
        for (std::size_t i = 0; i < rest.records.size(); ++i) {
            const glm::dvec4 expected = matrix * glm::dvec4(rest.records[i].position, 1.0f);
            greatest = std::max(greatest, apart(turned.records[i].position, glm::dvec3(expected)));
        }
        EXPECT_LT(greatest, kRigid) << angle;
    }
}

// A strand without weights follows the head for any motion of the guides. It has its own points,
// turned and moved, and its own width.
TEST_F(StrandResidualsTest, AStrandWithoutWeightsFollowsTheHeadAlone) {
    groom::Groom groom = groomOf(wisps(40, std::array{20u}), 12);
    const std::size_t own = groom.bindings.size();
    const groom::StrandSet lashes = wisps(30, std::array{6u});
    for (std::uint32_t i = 0; i < lashes.strandCount(); ++i) {
        const auto points = lashes.strand(i);
        groom.bindings.push_back(
            {.weights = glm::vec3(0.0f), .offset = points[0], .width = 0.0001f});
        groom.bound_points.insert(groom.bound_points.end(), points.begin(), points.end());
        groom.bound_ends.push_back(static_cast<std::uint32_t>(groom.bound_points.size()));
    }
    Settings settings = ownStrands(3);
    settings.strands.root_width = settings.strands.tip_width = 0.0004f;
    const StrandPoints rest = evaluate(groom, settings);
    const glm::dmat4 matrix = glm::rotate(
        glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, -0.1, 0.3)), 1.3,
        glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
    groom::Groom blown = moved(groom, matrix);
    for (std::size_t i = 0; i < blown.points.size(); ++i)
        blown.points[i].x += 0.1f * static_cast<float>(i % groom.vertices_per_strand);
    const StrandPoints turned = evaluate(groom, settings, blown, glm::mat4(matrix));
    const std::vector<std::uint32_t> order = drawnOrder(groom, settings.seed);
    double farthest = 0.0;
    double from_points = 0.0;
    std::size_t found = 0;
    for (std::uint32_t drawn = 0; drawn < order.size(); ++drawn) {
        if (order[drawn] < own) continue;
        ++found;
        const std::vector<glm::dvec3> before = line(rest, drawn);
        const std::vector<glm::dvec3> after = line(turned, drawn);
        ASSERT_EQ(before.size(), after.size());
        for (std::size_t k = 0; k < before.size(); ++k) {
            const glm::dvec3 expected(matrix * glm::dvec4(before[k], 1.0));
            farthest = std::max(farthest, apart(after[k], expected));
        }
        EXPECT_FLOAT_EQ(rest.at(0, drawn, 2, 1).width, 0.0001f);
        const auto points = groom.boundStrand(order[drawn]);
        from_points = std::max(
            {from_points, apart(before.front(), glm::dvec3(points.front())),
             apart(before.back(), glm::dvec3(points.back()))});
    }
    EXPECT_EQ(found, 30u);
    EXPECT_LT(farthest, kRigid);
    EXPECT_LT(from_points, 5e-5);  // the limit in docs/grooms.md for the distance of a strand from
                                   // its points
}

// Three straight guides up, 0.01 m a segment, and a curl about their middle without an offset at
// the ends: its root is theirs.
groom::Groom straightGuides(std::uint32_t vertices) {
    const auto guide = [&](float x, float z) {
        std::vector<glm::vec3> points;
        for (std::uint32_t k = 0; k < vertices; ++k)
            points.emplace_back(x, 0.01f * static_cast<float>(k), z);
        return points;
    };
    groom::Groom groom =
        oneTriangle({guide(-0.01f, 0.0f), guide(0.02f, 0.0f), guide(0.0f, 0.015f)});
    groom.bindings = {{.guides = {0, 1, 2}, .weights = {0.5f, 0.25f, 0.25f}}};
    for (std::uint32_t k = 0; k < vertices; ++k) {
        const double grows = std::min(0.25 * k, 1.0);
        groom.bound_points.emplace_back(
            grows * 0.008 * std::sin(1.1 * k), 0.01 * k,
            0.00375 + grows * 0.008 * std::cos(1.1 * k));
    }
    groom.bound_ends = {vertices};
    return groom;
}

// From vertex 6 on the guides are turned as a whole, by less than half a turn. If the turn is
// about an axis across them, it is the smallest rotation from their direction at rest.
TEST_F(StrandResidualsTest, GuidesThatBendTurnResidualsWithThem) {
    constexpr std::uint32_t kVertices = 20;
    constexpr std::uint32_t kBend = 6;
    const groom::Groom groom = straightGuides(kVertices);
    for (const double angle : {0.2, 1.5, 2.8}) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 0.0, 0.7));
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), angle, axis);
        groom::Groom bent = groom;
        for (std::uint32_t guide = 0; guide < 3; ++guide) {
            const glm::dvec3 pivot(groom.strand(guide)[kBend]);
            for (std::uint32_t k = kBend; k < kVertices; ++k) {
                glm::vec3& point = bent.points[guide * kVertices + k];
                point = glm::vec3(
                    pivot + glm::dvec3(turn * glm::dvec4(glm::dvec3(point) - pivot, 0.0)));
            }
        }
        const StrandPoints points = evaluate(groom, ownStrands(2), bent);
        // Up to the bend, the mean of the guides' points is expected; beyond it, a straight line.
        const glm::dvec3 root(0.0, 0.0, 0.00375);
        const glm::dvec3 pivot = root + glm::dvec3(0.0, 0.01 * kBend, 0.0);
        for (std::uint32_t k = 0; k < kVertices; ++k) {
            if (k + 2 > kBend && k < kBend + 2) continue;  // the curve rounds the corner there
            const glm::dvec3 rest(groom.bound_points[k]);
            const glm::dvec3 expected =
                k < kBend ? rest : pivot + glm::dvec3(turn * glm::dvec4(rest - pivot, 0.0));
            const std::uint32_t segment = std::min(k, kVertices - 2);
            const auto& record = points.at(0, 0, segment, k == kVertices - 1 ? 2 : 0);
            EXPECT_LT(apart(record.position, expected), kRigid) << angle << ' ' << k;
        }
    }
}

// Guides swing past each other in small steps. Two of them turn by almost half a turn in opposite
// ways, so that they point away from each other in between. Nothing jumps.
TEST_F(StrandResidualsTest, SwingWithoutAJump) {
    constexpr std::uint32_t kVertices = 8;
    constexpr int kSteps = 400;
    const groom::Groom groom = straightGuides(kVertices);
    const Settings settings = ownStrands(2);
    std::vector<glm::dvec3> before;
    double greatest = 0.0;
    for (int step = 0; step <= kSteps; ++step) {
        const double angle = 3.0 * step / kSteps;
        groom::Groom now = groom;
        for (std::uint32_t guide = 0; guide < 3; ++guide) {
            const glm::dvec3 root(groom.strand(guide)[0]);
            const double turn = guide == 0 ? angle : guide == 1 ? -angle : 0.5 * angle;
            const glm::dmat4 matrix =
                glm::rotate(glm::dmat4(1.0), turn, glm::normalize(glm::dvec3(1.0, 0.0, 0.3)));
            for (std::uint32_t k = 1; k < kVertices; ++k) {
                glm::vec3& point = now.points[guide * kVertices + k];
                point = glm::vec3(
                    root + glm::dvec3(matrix * glm::dvec4(glm::dvec3(point) - root, 0.0)));
            }
        }
        const std::vector<glm::dvec3> here = line(evaluate(groom, settings, now), 0);
        for (std::size_t i = 0; i < before.size(); ++i)
            greatest = std::max(greatest, apart(here[i], before[i]));
        before = here;
    }
    // The guides' tips move by 0.07 m times the step. A residual of 8 mm turns by at most 2 / (1/2)
    // times as much as guides do, because the heaviest weight is 1/2.
    EXPECT_LT(greatest, (0.07 + 4.0 * 0.0085) * 3.0 / kSteps + kRigid);
}

// With guides that are folded back on themselves, straight or without length, the point is finite,
// and no farther from the mean than the residual reaches.
TEST_F(StrandResidualsTest, AreFiniteWhereFramesDegenerate) {
    constexpr std::uint32_t kVertices = 9;
    const groom::Groom groom = straightGuides(kVertices);
    const Settings settings = ownStrands(3);
    const auto check = [&](const groom::Groom& now) {
        const StrandPoints with = evaluate(groom, settings, now);
        const StrandPoints without = evaluate(withoutResiduals(groom), settings, now);
        ASSERT_EQ(with.records.size(), without.records.size());
        for (std::size_t i = 0; i < with.records.size(); ++i) {
            EXPECT_LE(apart(with.records[i].position, without.records[i].position), 0.0105);
            EXPECT_TRUE(std::isfinite(glm::length(with.records[i].tangent)));
        }
    };
    groom::Groom now = groom;
    for (std::uint32_t guide = 0; guide < 3; ++guide)  // back along itself from vertex 4 on
        for (std::uint32_t k = 4; k < kVertices; ++k)
            now.points[guide * kVertices + k] = groom.strand(guide)[8 - k];
    check(now);
    now = groom;
    for (std::uint32_t guide = 0; guide < 3; ++guide)  // upside down from the root on
        for (std::uint32_t k = 1; k < kVertices; ++k) now.points[guide * kVertices + k].y *= -1.0f;
    check(now);
    for (std::uint32_t guide = 0; guide < 3; ++guide)  // all points at the root
        for (std::uint32_t k = 1; k < kVertices; ++k)
            now.points[guide * kVertices + k] = groom.strand(guide)[0];
    check(now);
}

// ---- The table ----------------------------------------------------------------------------------

std::vector<std::uint32_t> inOrder(const groom::Groom& groom) {
    std::vector<std::uint32_t> order(groom.bindings.size());
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

TEST(StrandResiduals, TakeEightBytesAPoint) {
    const groom::StrandSet file = wisps(300, std::array{32u, 10u});
    const groom::Groom groom = groomOf(file, 30, 12);
    const StrandResiduals residuals = makeStrandResiduals(groom, {}, inOrder(groom));
    EXPECT_EQ(sizeof(residuals.samples[0]), 8u);
    EXPECT_EQ(residuals.samples.size(), 1 + file.points.size());
    ASSERT_EQ(residuals.strands.size(), 300u);
    std::uint32_t first = 1;
    for (std::uint32_t i = 0; i < 300; ++i) {
        EXPECT_EQ(residuals.strands[i].first, first);
        EXPECT_EQ(residuals.strands[i].count, i % 2 == 0 ? 32u : 10u);
        first += residuals.strands[i].count;
    }
}

// Points at the guides' vertices are found at once. Bunched points, up to 46 per strand, are found
// in 6 halvings.
TEST(StrandResiduals, AreSearchedWhereTheyAreUneven) {
    const auto halvings = [](double bunching, std::uint32_t vertices) {
        const groom::Groom groom = groomOf(wisps(50, std::array{46u}, bunching), 10, vertices);
        return makeStrandResiduals(groom, {}, inOrder(groom)).samples.front().x;
    };
    EXPECT_EQ(halvings(2.5, 46), 0u);
    EXPECT_EQ(halvings(2.5, 12), 6u);
}

// Rounding is half of a 32,767th of the greatest residual in each of three directions.
TEST(StrandResiduals, LeaveWhatRoundingLeaves) {
    const groom::StrandSet file = wisps(300, std::array{32u});
    for (const std::uint32_t guides : {3u, 30u}) {
        const groom::Groom groom = groomOf(file, guides);
        const StrandResiduals residuals = makeStrandResiduals(groom, {}, inOrder(groom));
        EXPECT_GT(residuals.kept.greatest, 2e-3);
        EXPECT_GT(residuals.left.greatest, 0.0);
        EXPECT_LE(
            residuals.left.greatest,
            std::sqrt(3.0) / 2.0 / 32767.0 * residuals.kept.greatest * (1.0 + 1e-6));
        EXPECT_LE(residuals.left.mean, residuals.left.greatest);
        for (const StrandResidual& strand : residuals.strands)
            EXPECT_GE(strand.reach, 32766.0f * strand.step);
    }
}

// A point every 2 um of a strand of 0.14 m: of 70,001 points, 65,536 have places of their own.
TEST(StrandResiduals, LeaveOutPointsAtThePlacesOfOthers) {
    groom::Groom groom = straightGuides(15);
    groom.bound_points.clear();
    for (int k = 0; k <= 70000; ++k) groom.bound_points.emplace_back(0.0, 2e-6 * k, 0.00375);
    groom.bound_ends = {70001};
    const StrandResiduals residuals = makeStrandResiduals(groom, {}, inOrder(groom));
    EXPECT_LE(residuals.samples.size(), 1 + 65536u);
    EXPECT_GT(residuals.samples.size(), 60000u);
    EXPECT_LT(residuals.left.greatest, 5e-6);
}

}  // namespace
}  // namespace hair::rendering
