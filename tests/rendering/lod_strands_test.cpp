#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "hair/rendering/renderer.h"
#include "hair/rendering/strand_plan.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/rendering/device_hair.h"

// Levels of detail of strands as points: thesis 2.3.8.1, but without jumps.
namespace hair::rendering {
namespace {

// A place on a strand's polyline: in each segment, at `t`. Absent if it is not drawn.
struct Place {
    glm::vec3 position;
    glm::vec3 tangent;
    float width;
};

// The place at t of the drawn line of a segment, for any tessellation.
std::optional<Place> placeOnLine(
    const StrandPoints& points, std::uint32_t triangle, std::uint32_t strand, std::uint32_t segment,
    float t) {
    const std::uint32_t pieces = points.plan.forced_tessellation;
    if (strand >= points.plan.forced_density) return std::nullopt;
    const float place = t * static_cast<float>(pieces);
    const std::uint32_t piece = std::min(static_cast<std::uint32_t>(place), pieces - 1);
    const float part = place - static_cast<float>(piece);
    const auto& a = points.at(triangle, strand, segment, piece);
    const auto& b = points.at(triangle, strand, segment, piece + 1);
    return Place{
        glm::mix(a.position, b.position, part), glm::mix(a.tangent, b.tangent, part),
        std::lerp(a.width, b.width, part)};
}

class LodStrandsTest : public GpuTest {
protected:
    static StrandPoints evaluate(const groom::Groom& groom, const Settings& settings) {
        const DeviceHair hair(device(), groom, settings);
        return evaluateStrandPoints(device(), settings, hair.view());
    }

    static StrandPoints evaluateAt(StrandSettings strands, float level) {
        return evaluate(tangledGroom(8), {.strands = strands, .lod = {.level = level}});
    }

    // The greatest change of any strand's line, relative to lengths of about 1, and of its width,
    // relative to the full width. A strand that isn't drawn has no width.
    static double greatestChange(const StrandPoints& a, const StrandPoints& b) {
        Extremes changes;
        const std::uint32_t strands = std::max(a.plan.forced_density, b.plan.forced_density);
        for (std::uint32_t strand = 0; strand < strands; ++strand) {
            for (int i = 0; i <= 24; ++i) {
                const float t = static_cast<float>(i) / 24.0f;
                const auto from = placeOnLine(a, 1, strand, 3, t);
                const auto to = placeOnLine(b, 1, strand, 3, t);
                const auto width = [](const auto& p) { return p ? double{p->width} : 0.0; };
                const double full = width(placeOnLine(a, 1, 0, 3, t));
                changes.add(std::abs(width(from) - width(to)) / full);
                if (!from || !to) continue;
                changes.add(double{glm::distance(from->position, to->position)});
                changes.add(double{glm::distance(from->tangent, to->tangent)});
            }
        }
        return changes.greatest();
    }
};

// A thousandth of a level is 0.07 % of a count. With 30 strands that is 0.02 of one strand's
// width. It moves the ends of pieces by 0.1 % of the line's bend, some 0.1 m. Counts rounded to
// whole numbers or at halves would lose a whole strand there, a change of 1. Pieces dropped in
// place would move by a tenth of that bend.
TEST_F(LodStrandsTest, NothingJumpsWhereCountsFall) {
    constexpr float kStep = 1e-3f;
    constexpr float kBound = 0.03f;
    const auto changeAt = [&](const StrandSettings& strands, float level) {
        const float before = std::max(level - 0.5f * kStep, 0.0f);
        return greatestChange(evaluateAt(strands, before), evaluateAt(strands, before + kStep));
    };
    for (const float count : {30.0f, 29.0f, 20.5f, 2.0f})
        EXPECT_LT(changeAt({.density = 30, .tessellation = 4}, std::log2(30.0f / count)), kBound)
            << count << " strands";
    for (const std::uint32_t tessellation : {4u, 5u}) {
        const StrandSettings strands{.density = 1, .tessellation = tessellation};
        for (const float pieces : {3.0f, 2.0f, 1.0f}) {
            if (pieces >= static_cast<float>(tessellation)) continue;
            const float level = std::log2(static_cast<float>(tessellation) / pieces);
            EXPECT_LT(changeAt(strands, level), 1e-3) << pieces << " pieces of " << tessellation;
        }
    }
}

TEST_F(LodStrandsTest, BigStepsAreSeen) {  // otherwise the test above could not fail
    const StrandSettings strands{.density = 30, .tessellation = 4};
    EXPECT_GT(greatestChange(evaluateAt(strands, 0.5f), evaluateAt(strands, 0.6f)), 0.1);
}

// Between the nested sets, ends that remain are on the curve. The others are on their way from the
// curve to the line: 6 -> 3 -> 1.
TEST_F(LodStrandsTest, EndsMoveFromTheCurveToTheLine) {
    const StrandSettings strands{.density = 4, .tessellation = 6};
    const StrandPoints fine = evaluateAt(strands, 0.0f);
    struct Row {
        float wanted;
        std::uint32_t pieces;
        std::uint32_t step;
        double morph;
    };
    for (const Row& row :
         {Row{4.5f, 6, 2, 0.5}, {3.0f, 3, 3, 1.0}, {2.0f, 3, 3, 0.5}, {1.5f, 3, 3, 0.25}}) {
        const StrandPoints points = evaluateAt(strands, std::log2(6.0f / row.wanted));
        ASSERT_EQ(points.plan.forced_tessellation, row.pieces);
        const auto fineAt = [&](std::uint32_t i) {
            return glm::dvec3(fine.at(2, 0, 4, 6 / row.pieces * i).position);
        };
        for (std::uint32_t i = 0; i <= row.pieces; ++i) {
            const std::uint32_t past = i % row.step;
            glm::dvec3 expected = fineAt(i);
            if (past != 0) {
                const double part = static_cast<double>(past) / row.step;
                const glm::dvec3 line =
                    glm::mix(fineAt(i - past), fineAt(i - past + row.step), part);
                expected = glm::mix(line, expected, row.morph);
            }
            // The level in 24 bits puts the wanted pieces off by about 1e-6.
            EXPECT_LT(glm::distance(glm::dvec3(points.at(2, 0, 4, i).position), expected), 1e-6)
                << row.wanted << " " << i;
        }
    }
}

// The slope of a segment at i / 6 from its points at 0, 2/6, 4/6 and 1: a cubic's exactly, as the
// derivative of Lagrange's polynomial through four of its points.
glm::dvec3 slopeOfCubic(const std::array<glm::dvec3, 7>& points, std::uint32_t i) {
    constexpr std::array<std::uint32_t, 4> kNodes{0, 2, 4, 6};
    const auto at = [](std::uint32_t place) { return place / 6.0; };
    glm::dvec3 slope(0.0);
    for (const std::uint32_t j : kNodes) {
        double weight = 0.0;
        for (const std::uint32_t m : kNodes) {
            if (m == j) continue;
            double product = 1.0 / (at(j) - at(m));
            for (const std::uint32_t l : kNodes)
                if (l != j && l != m) product *= (at(i) - at(l)) / (at(j) - at(l));
            weight += product;
        }
        slope += weight * points[j];
    }
    return slope;
}

// Tests tangents. The tangents of ends that stay are the curve's slopes. On the way to the line a
// tangent goes to a mean of those of the line's ends.
TEST_F(LodStrandsTest, TangentsMoveWithTheirEnds) {
    const StrandSettings strands{.density = 4, .tessellation = 6};
    const StrandPoints fine = evaluateAt(strands, 0.0f);
    std::array<glm::dvec3, 7> curve;
    for (std::uint32_t i = 0; i <= 6; ++i) curve[i] = fine.at(2, 0, 4, i).position;
    // Points of up to 0.75 m have some 20 roundings. slopeOfCubic() multiplies each by up to (11 +
    // 18 + 9 + 2) / (6 / 3) = 20.
    constexpr double kTolerance = 20 * 20 * 0x1p-24 * 0.75;
    struct Row {
        float wanted;
        std::uint32_t pieces;
        std::uint32_t step;
        double morph;
    };
    for (const Row& row :
         {Row{6.0f, 6, 1, 1.0},
          {4.5f, 6, 2, 0.5},
          {3.0f, 3, 3, 1.0},
          {2.0f, 3, 3, 0.5},
          {1.5f, 3, 3, 0.25}}) {
        const StrandPoints points = evaluateAt(strands, std::log2(6.0f / row.wanted));
        ASSERT_EQ(points.plan.forced_tessellation, row.pieces);
        const auto slopeAt = [&](std::uint32_t i) {
            return slopeOfCubic(curve, 6 / row.pieces * i);
        };
        Extremes morphed;
        for (std::uint32_t i = 0; i <= row.pieces; ++i) {
            const std::uint32_t past = i % row.step;
            glm::dvec3 expected = slopeAt(i);
            if (past != 0) {
                const double part = static_cast<double>(past) / row.step;
                const glm::dvec3 line =
                    glm::mix(slopeAt(i - past), slopeAt(i - past + row.step), part);
                expected = glm::mix(line, expected, row.morph);
            }
            morphed.add(glm::distance(expected, slopeAt(i)));
            EXPECT_LT(
                glm::distance(glm::dvec3(points.at(2, 0, 4, i).tangent), expected), kTolerance)
                << row.wanted << " " << i;
        }
        if (row.morph < 1.0) {
            // the test can tell the two apart
            EXPECT_GT(morphed.greatest(), 5.0 * kTolerance) << row.wanted;
        }
    }
}

// Joints of the guide segments stay closed to the last bit, and are equal to those of level 0.
TEST_F(LodStrandsTest, JointsHaveNoGaps) {
    const StrandSettings strands{
        .density = 5, .tessellation = 4, .variation = {.amplitude = 0.01f}};
    const StrandPoints fine = evaluateAt(strands, 0.0f);
    for (const float level : {0.3f, 0.9f, 1.7f, 3.5f}) {
        const StrandPoints points = evaluateAt(strands, level);
        const std::uint32_t last = points.plan.forced_tessellation;
        for (std::uint32_t segment = 0; segment + 1 < points.plan.segments; ++segment) {
            const glm::vec3 end = points.at(0, 0, segment, last).position;
            EXPECT_EQ(end, points.at(0, 0, segment + 1, 0).position) << level;
            EXPECT_EQ(end, fine.at(0, 0, segment, 4).position) << level;
        }
    }
}

// The sum over strands of width times length is equal to that of level 0, except for the shorter
// polylines: none is longer than at level 0 or shorter than the chords of the guide segments. The
// widths of all strands add up to the same everywhere; sums of 50 floats are off by about 1e-6.
TEST_F(LodStrandsTest, AreaIsKept) {
    groom::Groom groom = tangledGroom(8);
    groom.root_triangles = {{0, 0, 0}};  // all strands have one length
    const auto pointsAt = [&](float level) {
        return evaluate(
            groom, {.strands = {.density = 50, .tessellation = 8}, .lod = {.level = level}});
    };
    const auto area = [](const StrandPoints& points) {
        double sum = 0.0;
        for (std::uint32_t strand = 0; strand < points.plan.forced_density; ++strand) {
            for (std::uint32_t segment = 0; segment < 7; ++segment) {
                for (std::uint32_t i = 0; i < points.plan.forced_tessellation; ++i) {
                    const auto& a = points.at(0, strand, segment, i);
                    const auto& b = points.at(0, strand, segment, i + 1);
                    sum += 0.5 * (a.width + b.width) * glm::distance(a.position, b.position);
                }
            }
        }
        return sum;
    };
    const StrandPoints fine = pointsAt(0.0f);
    double chords = 0.0;
    for (std::uint32_t segment = 0; segment < 7; ++segment) {
        const auto& a = fine.at(0, 0, segment, 0);
        const auto& b = fine.at(0, 0, segment, 8);
        chords += 50 * 0.5 * (a.width + b.width) * glm::distance(a.position, b.position);
    }
    for (const float level : {0.1f, 0.5f, 0.77f, 1.0f, 2.3f, 3.0f, 4.4f, 5.6f}) {
        const StrandPoints points = pointsAt(level);
        EXPECT_LT(area(points), area(fine) * (1.0 + 1e-5)) << level;
        EXPECT_GT(area(points), chords * (1.0 - 1e-5)) << level;
        double width = 0.0;
        for (std::uint32_t strand = 0; strand < points.plan.forced_density; ++strand)
            width += points.at(0, strand, 2, 0).width;
        EXPECT_NEAR(width / (50.0 * fine.at(0, 0, 2, 0).width), 1.0, 1e-5) << level;
    }
    EXPECT_NEAR(area(pointsAt(5.6f)) / chords, 1.0, 1e-5);
}

// The host bounds the strands of a head, and the device counts them.
TEST_F(LodStrandsTest, AHeadsDistanceBoundsItsStrands) {
    const groom::Groom groom = tangledGroom(8);
    Settings settings{
        .strands = {.density = 200, .tessellation = 1, .root_width = 1e-4f, .tip_width = 1e-4f},
        .lod = {.mode = LodMode::distance, .near_distance = 0.5f, .far_distance = 30.0f}};
    const DeviceHair hair(device(), groom, settings);
    const glm::vec3 centre = hair.view().centre;
    std::uint32_t most = 0;
    std::uint32_t bound = 0;
    for (const float distance : {1.0f, 2.0f, 5.0f, 25.0f})
        for (const glm::vec3 direction :
             {glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(-0.6f, 0.8f, 0.0f),
              glm::vec3(0.0f, 0.0f, -1.0f)}) {
            settings.camera.position = centre + distance * direction;
            const StrandPoints points = evaluateStrandPoints(device(), settings, hair.view());
            most = 0;
            for (std::uint32_t triangle = 0; triangle < points.plan.triangles; ++triangle)
                for (std::uint32_t i = 0; i < points.plan.forced_density; ++i)
                    if (points.at(triangle, i, 0, 0).width >= 0.0f) most = std::max(most, i + 1);
            bound = mostStrands(points.plan, settings.lod, hair.view(), settings.camera.position);
            EXPECT_LE(most, bound) << distance << " m";
        }
    // At 25 m roots are at most a twentieth farther than the sphere's nearest point, which is
    // 0.05 levels or 4 % of the strands.
    EXPECT_LT(bound, 1.1 * most + 2.0);
    EXPECT_LT(bound, 200u);
}

// A strand drawn at a level is drawn at every lower one, for any motion of the camera.
TEST_F(LodStrandsTest, StrandsLeaveInOneOrder) {
    Settings settings{
        .strands = {.density = 40, .tessellation = 2},
        .lod = {
            .mode = LodMode::distance,
            .near_distance = 1.0f,
            .far_distance = 16.0f,
            .maximum_level = 4.0f}};
    std::uint32_t before = 40;
    const groom::Groom groom = tangledGroom(3);
    for (const float distance : {1.0f, 1.6f, 2.9f, 6.0f, 13.0f, 30.0f}) {
        settings.camera.position = {0.0f, 0.0f, distance};
        const StrandPoints points = evaluate(groom, settings);
        std::uint32_t drawn = 0;
        while (drawn < 40 && points.at(0, drawn, 0, 0).width >= 0.0f) ++drawn;
        for (std::uint32_t strand = drawn; strand < 40; ++strand)
            EXPECT_EQ(points.at(0, strand, 0, 0).width, -1.0f);
        EXPECT_LE(drawn, before) << distance;
        before = drawn;
    }
    EXPECT_LT(before, 40u);
}

// The host's counts along a path equal the device's.
TEST_F(LodStrandsTest, HostCountsWhatTheDeviceDraws) {
    const groom::Groom groom = tangledGroom(3);
    Settings settings{
        .strands = {.density = 40, .tessellation = 2, .root_width = 1e-4f, .tip_width = 1e-4f},
        .lod = {
            .mode = LodMode::distance,
            .near_distance = 1.0f,
            .far_distance = 16.0f,
            .maximum_level = 4.0f}};
    const DeviceHair hair(device(), groom, settings);
    for (const float distance : {0.5f, 1.7f, 4.4f, 40.0f}) {
        settings.camera.position = {0.0f, 0.0f, distance};
        const StrandPoints points = evaluateStrandPoints(device(), settings, hair.view());
        std::uint64_t drawn = 0;
        for (std::uint32_t i = 0; i < 4 * 40; ++i)
            drawn += points.at(i / 40, i % 40, 0, 0).width >= 0.0f;
        const DistanceLod state = distanceLod(groom, groom.points, hair.view(), settings);
        EXPECT_EQ(state.strands, drawn) << distance;
    }
}

// ---- Levels by cluster --------------------------------------------------------------------------

// The weights of the strands of a triangle in the order in which clusters keep them: a root of
// unitTriangles() is at its weights.
std::vector<glm::dvec3> weightsOf(const StrandPoints& points, std::uint32_t triangle) {
    std::vector<glm::dvec3> weights;
    for (std::uint32_t strand = 0; strand < points.plan.forced_density; ++strand)
        weights.emplace_back(points.at(triangle, strand, 0, 0).position);
    return weights;
}

// Half of the sum of the differences, and 2 more if strands follow one guide and these two don't
// follow the same.
double apart(const glm::dvec3& a, const glm::dvec3& b, bool follows_one) {
    const auto heaviest = [](const glm::dvec3& w) {
        return w.x >= w.y && w.x >= w.z ? 0 : w.y >= w.z ? 1 : 2;
    };
    const glm::dvec3 difference = glm::abs(a - b);
    return 0.5 * (difference.x + difference.y + difference.z) +
           (follows_one && heaviest(a) != heaviest(b) ? 2.0 : 0.0);
}

// The least number that, divided by sqrt(k + 1), bounds how far a strand is from the first k.
double coveringOf(const std::vector<glm::dvec3>& weights, bool follows_one) {
    std::vector<double> nearest(weights.size(), 1e9);
    double covering = 0.0;
    for (std::size_t kept = 1; kept < weights.size(); ++kept) {
        for (std::size_t i = 0; i < weights.size(); ++i)
            nearest[i] = std::min(nearest[i], apart(weights[i], weights[kept - 1], follows_one));
        covering = std::max(
            covering, std::ranges::max(nearest) * std::sqrt(static_cast<double>(kept) + 1.0));
    }
    return covering;
}

// The device places strands in the host's order, and the first k cover the others as promised.
TEST_F(LodStrandsTest, ClustersBeginWithStrandsThatCoverTheRest) {
    const groom::Groom groom = unitTriangles(5);
    for (const std::uint32_t density : {2u, 7u, 64u, 200u})
        for (const Interpolation interpolation : {Interpolation::multi, Interpolation::single}) {
            Settings settings{
                .seed = 9, .strands = {.interpolation = interpolation, .density = density}};
            const StrandPoints all = evaluate(groom, settings);
            settings.lod = {.mode = LodMode::cluster, .error = 0.01f};
            settings.camera.position = {0.3f, 0.3f, 1.5f};
            const StrandPoints ordered = evaluate(groom, settings);
            const ClusterOrder order = orderClusters(9, 5, settings.strands);
            double covering_before = 0.0;
            double covering_of_order = 0.0;
            for (std::uint32_t triangle = 0; triangle < 5; ++triangle) {
                const auto before = weightsOf(all, triangle);
                const auto weights = weightsOf(ordered, triangle);
                for (std::uint32_t i = 0; i < density; ++i)
                    ASSERT_EQ(weights[i], before[order.strands[triangle * density + i]]);
                auto numbers = std::vector(
                    order.strands.begin() + triangle * density,
                    order.strands.begin() + (triangle + 1) * density);
                std::ranges::sort(numbers);
                for (std::uint32_t i = 0; i < density; ++i) ASSERT_EQ(numbers[i], i);

                const bool follows_one = interpolation == Interpolation::single;
                const double covering = order.coverings[triangle];
                ASSERT_LE(coveringOf(weights, follows_one), covering) << density << " strands";
                covering_before += coveringOf(before, follows_one);
                covering_of_order += covering;
            }
            // The order is worth its cost: that of level 0 is random.
            if (density >= 64) {
                EXPECT_LT(covering_of_order, 0.9 * covering_before);
            }
        }
}

// A camera and its picture in double precision.
class Projection {
public:
    explicit Projection(const Settings& settings)
        : eye_(settings.camera.position),
          forward_(glm::normalize(
              glm::dvec3(settings.camera.target) - glm::dvec3(settings.camera.position))),
          right_(glm::normalize(glm::cross(forward_, glm::dvec3(settings.camera.up)))),
          height_(settings.render.height), width_(settings.render.width),
          scale_(0.5 * height_ / std::tan(glm::radians(settings.camera.field_of_view * 0.5))) {}

    // px from the middle of the picture.
    glm::dvec2 operator()(const glm::dvec3& point) const {
        const glm::dvec3 seen = point - eye_;
        const glm::dvec3 up = glm::cross(right_, forward_);
        return scale_ / depth(point) * glm::dvec2(glm::dot(seen, right_), glm::dot(seen, up));
    }
    double depth(const glm::dvec3& point) const { return glm::dot(point - eye_, forward_); }
    double pixelsPerMetre(const glm::dvec3& point) const { return scale_ / depth(point); }
    bool shows(const glm::dvec3& point) const {
        if (depth(point) <= 0.0) return false;
        const glm::dvec2 place = glm::abs((*this)(point));
        return place.x <= 0.5 * width_ && place.y <= 0.5 * height_;
    }

private:
    glm::dvec3 eye_;
    glm::dvec3 forward_;
    glm::dvec3 right_;
    double height_;
    double width_;
    double scale_;
};

// The line of a drawn strand at kPlaces places of each segment, root first.
struct DrawnLine {
    std::vector<glm::dvec3> points;
    std::vector<double> widths;  // m
};

constexpr std::uint32_t kPlaces = 8;

// Drawn strands of a triangle. `pieces` is set to the pieces of a segment.
std::vector<DrawnLine>
linesOf(const StrandPoints& points, std::uint32_t triangle, std::uint32_t& pieces) {
    pieces = 0;
    while (pieces < points.plan.forced_tessellation &&
           points.at(triangle, 0, 0, pieces + 1).width >= 0.0f)
        ++pieces;
    std::vector<DrawnLine> lines;
    for (std::uint32_t strand = 0; strand < points.plan.forced_density; ++strand) {
        if (points.at(triangle, strand, 0, 0).width < 0.0f) break;
        DrawnLine& line = lines.emplace_back();
        for (std::uint32_t segment = 0; segment < points.plan.segments; ++segment)
            for (std::uint32_t i = 0; i <= kPlaces; ++i) {
                const double place = static_cast<double>(pieces) * i / kPlaces;
                const std::uint32_t piece = std::min(static_cast<std::uint32_t>(place), pieces - 1);
                const auto& a = points.at(triangle, strand, segment, piece);
                const auto& b = points.at(triangle, strand, segment, piece + 1);
                line.points.push_back(
                    glm::mix(glm::dvec3(a.position), glm::dvec3(b.position), place - piece));
                line.widths.push_back(std::lerp(double{a.width}, double{b.width}, place - piece));
            }
    }
    return lines;
}

// The greatest distance between two lines in the picture at the same place along them, px, where
// it shows one of them.
double apartInPicture(const Projection& projection, const DrawnLine& a, const DrawnLine& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.points.size(); ++i)
        if (projection.shows(a.points[i]) || projection.shows(b.points[i]))
            greatest =
                std::max(greatest, glm::distance(projection(a.points[i]), projection(b.points[i])));
    return greatest;
}

struct ClusterCase {
    const char* name;
    void (*change)(Settings&);
    bool follows_one = false;
};

// The bounds of points_pass.h hold for the device's points, projected in double precision.
TEST_F(LodStrandsTest, ClustersKeepTheirErrorInPixels) {
    const groom::Groom groom = tangledGroom(8);
    constexpr double kRounding = 1e-3;  // px: points of 1 m in 24 bits, at most 1e4 px per metre
    for (const ClusterCase& each :
         {ClusterCase{"as it is", [](Settings&) {}},
          ClusterCase{"catmull_rom", [](Settings& s) { s.strands.curve = Curve::catmull_rom; }},
          ClusterCase{"unpinned", [](Settings& s) { s.strands.curve = Curve::bspline_unpinned; }},
          ClusterCase{
              "single", [](Settings& s) { s.strands.interpolation = Interpolation::single; }, true},
          ClusterCase{
              "mixed", [](Settings& s) { s.strands.interpolation = Interpolation::mixed; }, true},
          ClusterCase{"contacts", [](Settings& s) { s.strands.collision_rule = true; }, true},
          ClusterCase{"offsets", [](Settings& s) { s.strands.variation.amplitude = 0.002f; }},
          ClusterCase{"strips", [](Settings& s) { s.lod.merged = MergedStrands::strip; }},
          ClusterCase{"narrow view", [](Settings& s) { s.camera.field_of_view = 12.0f; }}}) {
        Settings settings{
            .strands = {.density = 50, .tessellation = 8, .root_width = 2e-3f, .tip_width = 1e-3f}};
        settings.render.width = 400;
        settings.render.height = 300;
        each.change(settings);
        const DeviceHair hair(device(), groom, settings);
        const StrandPoints full = evaluateStrandPoints(device(), settings, hair.view());
        std::uint32_t fewest = 50;
        std::uint32_t fewest_pieces = 8;
        double greatest = 0.0;  // share of the error
        settings.lod.mode = LodMode::cluster;
        for (const float error : {1.0f, 6.0f})
            for (const glm::vec3 eye :
                 {glm::vec3(0.0f, 0.1f, 0.4f), glm::vec3(-2.0f, 0.5f, 2.0f),
                  glm::vec3(4.0f, 20.0f, 56.0f)}) {
                settings.lod.error = error;
                settings.camera.position = eye;
                settings.camera.target = {0.1f, 0.1f, 0.0f};
                const StrandPoints drawn = evaluateStrandPoints(device(), settings, hair.view());
                const Projection projection(settings);
                for (std::uint32_t triangle = 0; triangle < 4; ++triangle) {
                    std::uint32_t pieces = 0;
                    const auto all = linesOf(full, triangle, pieces);
                    const auto kept = linesOf(drawn, triangle, pieces);
                    fewest = std::min(fewest, static_cast<std::uint32_t>(kept.size()));
                    fewest_pieces = std::min(fewest_pieces, pieces);
                    for (const DrawnLine& line : all) {
                        double nearest = 1e9;
                        for (const DrawnLine& other : kept)
                            nearest = std::min(nearest, apartInPicture(projection, line, other));
                        ASSERT_LE(nearest, error + kRounding) << each.name << ", eye at " << eye.z;
                        greatest = std::max(greatest, nearest / error);
                    }
                    const ClusterOrder order = orderClusters(1, 4, settings.strands);
                    for (std::size_t i = 0; i < kept.size(); ++i) {
                        const DrawnLine& own = all[order.strands[triangle * 50 + i]];
                        ASSERT_LE(apartInPicture(projection, kept[i], own), 0.1 * error + kRounding)
                            << each.name << ", eye at " << eye.z;
                        for (std::size_t at = 0; at < own.points.size(); ++at) {
                            if (!projection.shows(own.points[at])) continue;
                            const bool strip = settings.lod.merged == MergedStrands::strip;
                            const double spread =
                                strip || kept.size() == all.size() ? 1.0 : gpu::kMostMergedSpread;
                            const double out = 0.5 * (spread * kept[i].widths[at] - own.widths[at]);
                            ASSERT_LE(
                                out * projection.pixelsPerMetre(own.points[at]),
                                0.9 * error + kRounding)
                                << each.name;
                        }
                    }
                }
            }
        // The picture is coarser, and not much less than the error allows: the bounds of the four
        // parts don't add up in one place.
        EXPECT_LT(fewest, each.follows_one ? 40u : 20u) << each.name;
        EXPECT_LE(fewest_pieces, 2u) << each.name;
        EXPECT_GT(greatest, 0.05) << each.name;
    }
}

// The strands between parallel guides, seen along them from afar: the guides' distances are those
// in the picture, and nothing else takes a share of the error. The bound is for the worst place
// along the order and for the longest edge of the triangle, so some of it stays unused, but less
// than 3/5.
TEST_F(LodStrandsTest, ClustersAreAsCoarseAsTheirErrorLets) {
    const groom::Groom groom = uprightGroom();
    Settings settings{
        .strands = {.density = 200, .tessellation = 2, .root_width = 1e-5f, .tip_width = 1e-5f}};
    settings.render.width = 400;
    settings.render.height = 300;
    settings.camera = {
        .position = {0.017f, 30.0f, 0.017f},
        .target = {0.017f, 0.0f, 0.017f},
        .up = {0.0f, 0.0f, 1.0f},
        .field_of_view = 2.0f};
    const DeviceHair hair(device(), groom, settings);
    std::uint32_t pieces = 0;
    const auto all = linesOf(evaluateStrandPoints(device(), settings, hair.view()), 0, pieces);
    double greatest = 0.0;
    settings.lod.mode = LodMode::cluster;
    for (const float error : {3.5f, 5.0f, 7.0f, 10.0f}) {
        settings.lod.error = error;
        const StrandPoints drawn = evaluateStrandPoints(device(), settings, hair.view());
        const Projection projection(settings);
        const auto kept = linesOf(drawn, 0, pieces);
        ASSERT_LT(kept.size(), all.size());
        for (const DrawnLine& line : all) {
            double nearest = 1e9;
            for (const DrawnLine& other : kept)
                nearest = std::min(nearest, apartInPicture(projection, line, other));
            ASSERT_LE(nearest, 0.9 * error + 1e-3) << error;
            greatest = std::max(greatest, nearest / error);
        }
    }
    EXPECT_GT(greatest, 0.4);
}

// Strands at one place: only their width limits how many one of them stands for.
TEST_F(LodStrandsTest, ClustersStickOutByTheirError) {
    std::vector<glm::vec3> guide;
    for (int v = 0; v < 8; ++v) guide.emplace_back(0.0f, 0.04f * static_cast<float>(v), 0.0f);
    constexpr float kWidth = 1e-4f;  // m
    constexpr float kError = 3.0f;
    Settings settings{
        .strands = {.density = 200, .tessellation = 1, .root_width = kWidth, .tip_width = kWidth}};
    settings.render.width = 300;
    settings.render.height = 300;
    settings.camera = {
        .position = {0.0f, 0.01f, 1.0f}, .target = {0.0f, 0.01f, 0.0f}, .field_of_view = 2.0f};
    settings.lod = {.mode = LodMode::cluster, .error = kError};
    const StrandPoints drawn = evaluate(oneTriangle(guide), settings);
    const double px = Projection(settings).pixelsPerMetre(glm::dvec3(0.0));
    const double width = drawn.at(0, 0, 0, 0).width;
    const double out = 0.5 * (gpu::kMostMergedSpread * width - kWidth) * px;
    EXPECT_LE(out, 0.9 * kError);
    // The picture's corner stretches by 0.06 %.
    EXPECT_GT(out, 0.9 * kError * 0.99);
}

// Moving the eye by a part of its distance from the hair changes the levels by as much: strands'
// widths, whose number grows with the square, by four times that part in all (what one strand
// loses, others gain), and their places by a fifth of it times the error. A strand that came or
// went at once would change the widths by 1/50, and a point left out its place by 1/10 of the
// error.
TEST_F(LodStrandsTest, ClustersHaveNoJumps) {
    const groom::Groom groom = tangledGroom(8);
    constexpr double kStep = 1e-3;
    constexpr float kError = 2.0f;
    Settings settings{.strands = {.density = 50, .tessellation = 8}};
    settings.render.width = 400;
    settings.render.height = 300;
    settings.camera.target = {0.1f, 0.1f, 0.0f};
    settings.lod = {.mode = LodMode::cluster, .error = kError};
    const DeviceHair hair(device(), groom, settings);
    const auto at = [&](double distance) {
        settings.camera.position =
            settings.camera.target +
            static_cast<float>(distance) * glm::normalize(glm::vec3(0.3f, 0.1f, 1.0f));
        return evaluateStrandPoints(device(), settings, hair.view());
    };
    constexpr double kReach = 0.9;  // m, of the hair, from the target
    double moved = 0.0;
    for (double distance = 1.3; distance < 60.0; distance *= 1.07) {
        const double step = kStep * (distance - kReach);
        const StrandPoints before = at(distance);
        const Projection projection(settings);
        const StrandPoints behind = at(distance + step);
        for (std::uint32_t triangle = 0; triangle < 4; ++triangle) {
            std::uint32_t pieces = 0;
            const auto a = linesOf(before, triangle, pieces);
            const auto b = linesOf(behind, triangle, pieces);
            double change = 0.0;
            double width = 0.0;
            for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
                const double from = i < a.size() ? a[i].widths[0] : 0.0;
                const double to = i < b.size() ? b[i].widths[0] : 0.0;
                change += std::abs(from - to);
                width += from;
                if (i < std::min(a.size(), b.size())) {
                    const double places = apartInPicture(projection, a[i], b[i]);
                    ASSERT_LE(places, 0.2 * kStep * kError + 2e-4) << distance;
                    moved = std::max(moved, places);
                }
            }
            ASSERT_LE(change / width, 4.0 * kStep + 1e-5) << distance;
        }
    }
    EXPECT_GT(moved, 0.0);  // points were left out on the way
}

TEST_F(LodStrandsTest, ClustersRefuseStrandsWithoutABound) {
    const groom::Groom groom = tangledGroom(4);
    Settings settings{.lod = {.mode = LodMode::cluster}};
    settings.strands.collision = StrandCollision::push_out;
    const DeviceHair hair(device(), groom);
    const auto refused = [&] {
        try {
            evaluateStrandPoints(device(), settings, hair.view());
        } catch (const engine::Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(refused().find("/lod/mode"), std::string::npos);
    settings.strands.collision = StrandCollision::none;
    EXPECT_EQ(refused(), "");
    settings.strands.source = StrandSource::groom;
    EXPECT_NE(refused().find("/strands/source"), std::string::npos);
}

}  // namespace
}  // namespace hair::rendering
