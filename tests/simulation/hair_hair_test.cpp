#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "hair/reference/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"
#include "tests/simulation/volume_rig.h"

// Tests friction and repulsion of hair-hair contact.
namespace hair::simulation {
namespace {

SimulationSettings contact(float friction, float repulsion, float crowding = 1.0f) {
    SimulationSettings settings;
    settings.hair_hair = {
        .friction = friction, .repulsion = repulsion, .crowding = crowding, .resolution = 32};
    return settings;
}

// Hair that sticks to hair.
SimulationSettings sticky(float cohesion, float coefficient = 0.0f, float repulsion = 0.0f) {
    SimulationSettings settings = contact(0.0f, repulsion, 0.5f);
    settings.hair_hair.cohesion = cohesion;
    settings.hair_hair.friction_coefficient = coefficient;
    return settings;
}

// Hair that attracts hair, not yet crowded unless asked.
SimulationSettings wetAnd(SimulationSettings settings, float attraction) {
    settings.hair_hair.attraction = attraction;
    return settings;
}

SimulationSettings wet(float attraction, float crowding = 100.0f) {
    return wetAnd(contact(0.0f, 0.0f, crowding), attraction);
}

// Sum of share times vector, and sum of share times the vector's length.
struct Balance {
    glm::dvec3 sum{0.0};
    double size = 0.0;
};

template <class Vectors>
Balance balance(const groom::Groom& groom, const Vectors& vectors) {
    const auto shares = lengthShares(groom);
    Balance result;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        result.sum += shares[i] * glm::dvec3(vectors[i]);
        result.size += shares[i] * glm::length(glm::dvec3(vectors[i]));
    }
    return result;
}

double greatestLength(const std::vector<glm::vec3>& vectors) {
    Extremes lengths;
    for (const glm::vec3& v : vectors) lengths.add(double{glm::length(v)});
    return lengths.greatest();
}

std::vector<glm::vec3> moved(std::vector<glm::vec3> points, const glm::vec3& by) {
    for (glm::vec3& point : points) point += by;
    return points;
}

// Returns straight strands through a box of `width`, with random gaps.
groom::Groom bundle(std::uint32_t strands, double width, const glm::dvec3& along) {
    groom::Groom groom{.strand_count = strands, .vertices_per_strand = 8};
    std::mt19937 random(3);
    for (std::uint32_t s = 0; s < strands; ++s) {
        const glm::dvec3 middle = 0.5 * width * randomVector(random);
        for (int v = 0; v < 8; ++v)
            groom.points.emplace_back(middle + (v - 3.5) * kReferenceSegment * along);
    }
    return groom;
}

groom::Groom both(groom::Groom a, const groom::Groom& b) {
    a.strand_count += b.strand_count;
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    return a;
}

using HairOnHair = GpuTest;

// Forces between two vertices are opposite, so that only rounding is left of their sum. A vertex's
// part of a cell is rounded to 2^-31 of the whole at most, 5e-7 of its share of 1e-3.
constexpr double kPairRounding = 1e-5;

// Acceleration of every vertex by other forces. It is not zero, so that a pass that writes zeros is
// noticed.
constexpr glm::vec3 kOthers(1.5f, -9.81f, 0.25f);

TEST_F(HairOnHair, LeavesALoneStrandAlone) {
    const groom::Groom groom = wavyGroom(1, 16, 0.005);
    VolumeRig rig(device(), groom, contact(1.0f, 1.0f, 0.1f));
    const auto accelerations =
        rig.accelerations(disturbed(groom, 0.002, 1), disturbed(groom, 0.002, 2), {}, kOthers);
    // The device may round differently in two shaders: 1e-6 of 0.002 m / (1/60 s)^2 and of 1
    // m^2/s^2 / 10 mm.
    EXPECT_LT(largestDifference(accelerations, std::vector(groom.points.size(), kOthers)), 1e-4);
}

TEST_F(HairOnHair, AttractsNoLoneStrand) {
    const groom::Groom groom = wavyGroom(1, 16, 0.005);
    for (const float crowding : {0.1f, 100.0f}) {
        VolumeRig rig(device(), groom, wet(1.0f, crowding));
        const auto accelerations =
            rig.accelerations(disturbed(groom, 0.002, 1), disturbed(groom, 0.002, 2), {}, kOthers);
        // The tolerance of LeavesALoneStrandAlone.
        EXPECT_LT(
            largestDifference(accelerations, std::vector(groom.points.size(), kOthers)), 1e-4);
    }
}

// The energy per length of two parallel strands with the mass per length m is -f m b(x) / b(0) at
// the distance of x cells, with the quintic B-spline b, here as a difference of truncated powers.
TEST_F(HairOnHair, AttractsByTheEnergyOfTwoStrands) {
    constexpr double kAttraction = 1e-3;  // m^2/s^2; not limited by the step
    const auto slope = [](double x) {
        constexpr double kBinomials[] = {1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0};
        double sum = 0.0;
        for (int i = 0; i < 7; ++i)
            sum += kBinomials[i] * std::pow(std::max(x + 3.0 - i, 0.0), 4.0) / 24.0;
        return sum;
    };
    // Six segments in a cell, so that the sum over vertices is an integral.
    constexpr std::uint32_t kVertices = 97;
    const groom::Groom one = straightGroom(1, kVertices, 0.15 / 96.0);
    const double cell = volumeGrid(both(one, one), wet(0.0f).hair_hair.resolution).cell;
    double greatest = 0.0;
    for (double x = 0.25; x < 3.0; x += 0.25)
        greatest = std::max(greatest, -slope(x) / 0.55 * kAttraction / cell);
    // Strands of the groom lie on each other: the grid is the same for all distances.
    VolumeRig rig(device(), both(one, one), wet(kAttraction));
    for (const double x : {0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
        const double expected = -slope(x) / 0.55 * kAttraction / cell;
        glm::dvec2 mean(0.0);
        for (int place = 0; place < 32; ++place) {
            const glm::dvec3 shift(cell * (place % 16) / 16.0, 0.0, cell * (place / 16) / 4.0);
            const glm::dvec3 apart(x * cell, 0.0, 0.0);
            auto points = moved(one.points, shift - 0.5 * apart);
            const auto other = moved(one.points, shift + 0.5 * apart);
            points.insert(points.end(), other.begin(), other.end());
            const auto accelerations = rig.accelerations(points, points);
            const glm::dvec2 pulled(
                accelerations[kVertices / 2].x, -accelerations[kVertices + kVertices / 2].x);
            mean += pulled / 32.0;
            // Sums of splines over the cells of both grids are up to 12 % of this off, as another
            // program found.
            for (int i = 0; i < 2; ++i)
                EXPECT_NEAR(pulled[i], expected, 0.13 * greatest) << x << " cells at " << place;
        }
        // The mean over places is an integral, of which 16 places leave 0.15 %.
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(mean[i], expected, 0.003 * greatest) << x;
    }
}

TEST_F(HairOnHair, SticksToNoLoneStrand) {
    const groom::Groom groom = wavyGroom(1, 16, 0.005);
    VolumeRig rig(device(), groom, sticky(1.0f, 1.0f, 1.0f));
    for (unsigned step = 0; step < 6; step += 2) {
        const auto accelerations = rig.nextAccelerations(
            disturbed(groom, 0.002, step), disturbed(groom, 0.002, step + 1), {}, kOthers);
        // The tolerance of LeavesALoneStrandAlone.
        EXPECT_LT(
            largestDifference(accelerations, std::vector(groom.points.size(), kOthers)), 1e-4);
    }
}

// Two strands on top of each other share every cell equally. Each sees half of the jump Y of their
// potential, so friction changes each velocity by Y / 2 up to the yield, and by the yield beyond
// it: (840 / 239 + 64 / 13) / 4 of the cohesion times the step over the cell. In the first step the
// potential is the velocity, and then twice the velocity plus what was elastic before.
TEST_F(HairOnHair, HoldsUpToItsYieldStress) {
    const groom::Groom one = straightGroom(1, 6);
    const groom::Groom groom = both(one, one);
    constexpr double kCohesion = 5e-4;  // m^2/s^2
    SimulationSettings settings = sticky(kCohesion);
    const double cell = volumeGrid(groom, settings.hair_hair.resolution).cell;
    const double step = settings.time_step;
    const double greatest = (840.0 / 239.0 + 64.0 / 13.0) / 4.0 * kCohesion * step / cell;  // m/s
    const auto apart = [&](double velocity) {
        const glm::vec3 way(static_cast<float>(velocity * step), 0.0f, 0.0f);
        auto previous = moved(one.points, -way);
        const auto other = moved(one.points, way);
        previous.insert(previous.end(), other.begin(), other.end());
        return previous;
    };
    VolumeRig rig(device(), groom, settings);
    const auto expectHeld = [&](const std::vector<glm::vec3>& accelerations, double expected) {
        for (std::size_t i = 0; i < accelerations.size(); ++i)
            EXPECT_NEAR(accelerations[i].x * step, i < 6 ? -expected : expected, 0.02 * greatest);
    };
    // The strands pass by each other, by up to 2e-3 of a cell in a step.
    const double velocity = 0.4 * greatest;
    ASSERT_LT(velocity * step, 2e-3 * cell);
    expectHeld(rig.accelerations(groom.points, apart(velocity)), velocity);
    expectHeld(rig.nextAccelerations(groom.points, apart(velocity)), 2.0 * velocity);
    expectHeld(rig.nextAccelerations(groom.points, apart(velocity)), greatest);
    // Hair flows, so that its potential stays `greatest`: the elastic displacement and the last
    // velocity.
    for (int i = 0; i < 20; ++i)
        expectHeld(rig.nextAccelerations(groom.points, apart(velocity)), greatest);
    const double elastic = greatest - velocity;
    expectHeld(
        rig.nextAccelerations(groom.points, apart(-0.2 * velocity)), elastic - 0.4 * velocity);
    expectHeld(rig.nextAccelerations(groom.points, groom.points), elastic - 0.2 * velocity);
    expectHeld(rig.nextAccelerations(groom.points, apart(-velocity)), elastic - 2.2 * velocity);
}

// Hair that turns with the head by 0.02 in a step. Its way in the next step along its velocity is
// an arc's tangent, off by the angle's square: 0.02 of the way that hair on a resting head would
// go.
TEST_F(HairOnHair, SticksNoHairThatTurnsWithTheHead) {
    const groom::Groom groom = wavyGroom(60, 9);
    VolumeRig rig(device(), groom, sticky(1000.0f));
    const RigidMotion later{
        .rotation = glm::angleAxis(0.02, glm::dvec3(0.0, 1.0, 0.0)), .translation = {}};
    std::vector<glm::vec3> previous;
    for (const glm::vec3& point : groom.points)
        previous.emplace_back(glm::inverse(later.rotation) * glm::dvec3(point));
    rig.forget();
    const auto turned = rig.nextAccelerations(groom.points, previous, later, {}, RigidMotion{});
    rig.forget();
    const auto at_rest = rig.nextAccelerations(groom.points, previous);
    EXPECT_LT(greatestLength(turned), 0.05 * greatestLength(at_rest));
}

TEST_F(HairOnHair, HasNoFrictionWhereAllMoveAlike) {
    const groom::Groom groom = wavyGroom(60, 9);
    VolumeRig rig(device(), groom, contact(1.0f, 0.0f));
    const glm::vec3 way(0.02f, -0.01f, 0.005f);  // in a step: 1.4 m/s
    const auto accelerations =
        rig.accelerations(moved(groom.points, way), groom.points, {}, kOthers);
    // Floats of up to 0.4 m store the displacement to 3e-8 m, 2e-6 of it. That much of the velocity
    // is lost.
    EXPECT_LT(
        largestDifference(accelerations, std::vector(groom.points.size(), kOthers)),
        60.0 * 60.0 * 1e-7);
}

// Strands on top of each other share every cell equally, so each sees their mean velocity, here 0.
// It loses the set part of its velocity v in 1/60 s, at any time step.
TEST_F(HairOnHair, LosesThePartOfTheDifferenceThatItIsSetTo) {
    const groom::Groom one = straightGroom(1, 6);
    const groom::Groom groom = both(one, one);
    for (const float part : {0.05f, 0.5f, 1.0f})
        for (const float steps : {0.25f, 1.0f, 3.0f}) {
            SimulationSettings settings = contact(part, 0.0f);
            settings.time_step = steps / 60.0f;
            // Without prediction, which this does not test, strands stay on top of each other.
            const glm::vec3 way(1e-5f, 0.0f, 0.0f);
            auto previous = moved(one.points, -way);
            const auto other = moved(one.points, way);
            previous.insert(previous.end(), other.begin(), other.end());
            VolumeRig rig(device(), groom, settings);
            const auto accelerations = rig.accelerations(groom.points, previous);
            const double velocity = 1e-5 / settings.time_step;
            const double lost = velocity * (1.0 - std::pow(1.0 - double{part}, double{steps}));
            // A float of up to 0.1 m stores 1e-5 m with an error of 4e-9 m. In cells of about 9 mm
            // the two strands have moved apart by 2e-5 m.
            for (std::size_t i = 0; i < accelerations.size(); ++i)
                EXPECT_NEAR(
                    accelerations[i].x * settings.time_step, i < 6 ? -lost : lost, 0.005 * lost);
        }
}

// Two bundles cross at right angles and move through each other.
TEST_F(HairOnHair, DragsCrossingBundlesTogether) {
    const groom::Groom groom = both(bundle(40, 0.03, {1, 0, 0}), bundle(40, 0.03, {0, 1, 0}));
    const std::size_t half = groom.points.size() / 2;
    VolumeRig rig(device(), groom, contact(0.5f, 0.0f));
    const glm::vec3 way(0.0f, 0.0f, 1.0f / 60.0f / 60.0f);  // 1/60 m/s
    auto previous = groom.points;
    for (std::size_t i = 0; i < half; ++i) previous[i] -= way;
    const auto accelerations = rig.accelerations(groom.points, previous);

    const Balance all = balance(groom, accelerations);
    EXPECT_LT(glm::length(all.sum), kPairRounding * all.size);
    double first = 0.0;
    double second = 0.0;
    const auto shares = lengthShares(groom);
    for (std::size_t i = 0; i < half; ++i) {
        first += shares[i] * accelerations[i].z;
        second += shares[half + i] * accelerations[half + i].z;
        EXPECT_LE(accelerations[i].z, 1e-5);
        EXPECT_GE(accelerations[half + i].z, -1e-5);
    }
    EXPECT_LT(first, 0.0);
    EXPECT_GT(second, 0.0);
}

// Other forces change the velocities of a pair of strands on top of each other equally in every
// step. Friction then balances them at the set rate, at any time step.
TEST_F(HairOnHair, BearsASteadyDifferenceByItsRate) {
    const groom::Groom one = straightGroom(1, 6);
    const groom::Groom groom = both(one, one);
    for (const float part : {0.05f, 0.5f, 0.8f})
        for (const float steps : {0.25f, 1.0f, 2.0f}) {
            SimulationSettings settings = contact(part, 0.0f);
            settings.time_step = steps / 60.0f;
            const glm::vec3 way(1e-5f, 0.0f, 0.0f);
            auto previous = moved(one.points, -way);
            const auto other = moved(one.points, way);
            previous.insert(previous.end(), other.begin(), other.end());
            VolumeRig rig(device(), groom, settings);
            auto accelerations = rig.accelerations(groom.points, previous);
            // The error of a step is at most 3/4 of the previous step's.
            for (int step = 0; step < 40; ++step)
                accelerations = rig.nextAccelerations(groom.points, previous);
            const double rate = -60.0 * std::log(1.0 - double{part});
            const double expected = rate * 1e-5 / settings.time_step;
            // As in LosesThePartOfTheDifferenceThatItIsSetTo.
            for (std::size_t i = 0; i < accelerations.size(); ++i)
                EXPECT_NEAR(accelerations[i].x, i < 6 ? -expected : expected, 0.005 * expected);
        }
}

// With any velocities, predicted forces of a pair are opposite like known ones.
TEST_F(HairOnHair, KeepsMomentumWhateverItForesees) {
    const groom::Groom groom = wavyGroom(80, 9);
    VolumeRig rig(device(), groom, contact(0.6f, 0.0f));
    rig.accelerations(disturbed(groom, 0.01, 1), disturbed(groom, 0.01, 2));
    for (unsigned step = 3; step < 9; step += 2) {
        const auto accelerations =
            rig.nextAccelerations(disturbed(groom, 0.01, step), disturbed(groom, 0.01, step + 1));
        const Balance all = balance(groom, accelerations);
        EXPECT_GT(all.size, 1.0);
        EXPECT_LT(glm::length(all.sum), kPairRounding * all.size);
    }
}

TEST_F(HairOnHair, KeepsMomentumInYield) {
    const groom::Groom groom = wavyGroom(80, 9);
    for (const float cohesion : {0.01f, 1.0f, 1000.0f}) {
        VolumeRig rig(device(), groom, sticky(cohesion));
        rig.accelerations(disturbed(groom, 0.01, 1), disturbed(groom, 0.01, 2));
        for (unsigned step = 3; step < 9; step += 2) {
            const auto accelerations = rig.nextAccelerations(
                disturbed(groom, 0.01, step), disturbed(groom, 0.01, step + 1));
            const Balance all = balance(groom, accelerations);
            EXPECT_GT(all.size, 0.01);
            // Little is left of large potentials in yield, and their rounding is.
            EXPECT_LT(glm::length(all.sum), 10.0 * kPairRounding * all.size) << cohesion;
        }
    }
}

TEST_F(HairOnHair, SticksLikeTheReference) {
    for (const std::uint32_t vertices : {2u, 9u, 33u})
        for (const SimulationSettings& settings :
             {sticky(0.2f), sticky(0.0f, 0.6f, 0.3f), sticky(3.0f, 0.3f, 0.2f), sticky(1000.0f),
              wetAnd(sticky(0.0f, 0.6f, 0.3f), 0.1f)}) {
            const groom::Groom groom = wavyGroom(67, vertices, 0.15 / vertices);
            VolumeRig rig(device(), groom, settings);
            const RigidMotion frame{
                .rotation = glm::angleAxis(0.1, glm::dvec3(0.0, 1.0, 0.0)),
                .translation = {0.01, -0.02, 0.0}};
            rig.forget();
            std::vector<glm::dvec3> kept;
            for (unsigned step = 1; step < 6; step += 2) {
                const auto positions = disturbed(groom, 0.003, step);
                const auto previous = disturbed(groom, 0.003, step + 1);
                const auto accelerations = rig.nextAccelerations(positions, previous, frame);
                const auto expected = rig.expected(positions, previous, frame, &kept);
                // The tolerance of IsLikeTheReference, twice for each step: of the velocity and of
                // the elastic displacement.
                EXPECT_LT(
                    largestDifference(accelerations, expected),
                    2e-5 * (step + 1) * greatestLength(accelerations))
                    << vertices << " " << settings.hair_hair.cohesion << " " << step;
            }
        }
}

TEST_F(HairOnHair, ForeseesLikeTheReference) {
    const groom::Groom groom = wavyGroom(67, 9, 0.15 / 9);
    VolumeRig rig(device(), groom, contact(0.4f, 0.2f, 0.5f));
    rig.accelerations(disturbed(groom, 0.003, 1), disturbed(groom, 0.003, 2));
    std::vector<glm::dvec3> kept;
    rig.expected(disturbed(groom, 0.003, 1), disturbed(groom, 0.003, 2), {}, &kept);
    const auto positions = disturbed(groom, 0.003, 3);
    const auto previous = disturbed(groom, 0.003, 4);
    const auto accelerations = rig.nextAccelerations(positions, previous);
    const auto expected = rig.expected(positions, previous, {}, &kept);
    // The tolerance of IsLikeTheReference for two steps.
    EXPECT_LT(largestDifference(accelerations, expected), 4e-5 * greatestLength(accelerations));
    EXPECT_GT(
        largestDifference(expected, rig.expected(positions, previous)),
        0.1 * greatestLength(accelerations));
}

// With any velocities and no prediction, the greatest friction takes energy and never reverses the
// motion.
TEST_F(HairOnHair, FrictionOnlyTakesEnergy) {
    const groom::Groom groom = wavyGroom(80, 9);
    const auto shares = lengthShares(groom);
    for (const float part : {0.3f, 1.0f}) {
        VolumeRig rig(device(), groom, contact(part, 0.0f));
        const auto positions = disturbed(groom, 0.01, 1);
        const auto previous = disturbed(groom, 0.01, 2);
        const auto accelerations = rig.accelerations(positions, previous);
        const double step = contact(part, 0.0f).time_step;
        double before = 0.0;
        double after = 0.0;
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const glm::dvec3 velocity = (glm::dvec3(positions[i]) - glm::dvec3(previous[i])) / step;
            const glm::dvec3 then = velocity + step * glm::dvec3(accelerations[i]);
            before += shares[i] * glm::dot(velocity, velocity);
            after += shares[i] * glm::dot(then, then);
        }
        EXPECT_LT(after, before);
        const Balance all = balance(groom, accelerations);
        EXPECT_LT(glm::length(all.sum), kPairRounding * all.size);
    }
}

TEST_F(HairOnHair, ExpandsACompressedBundle) {
    const groom::Groom groom = bundle(60, 0.08, {0, 1, 0});
    VolumeRig rig(device(), groom, contact(0.0f, 0.3f));
    auto compressed = groom.points;
    for (glm::vec3& point : compressed) point *= glm::vec3(0.3f, 1.0f, 0.3f);
    const auto accelerations = rig.accelerations(compressed, compressed);

    const Balance all = balance(groom, accelerations);
    EXPECT_GT(all.size, 0.1);
    // Newton's third law holds except for the sampling in cells, about 1 % (hair_hair.h).
    EXPECT_LT(glm::length(all.sum), 0.02 * all.size);
    const auto shares = lengthShares(groom);
    double outward = 0.0;  // the virial: positive if forces push apart
    for (std::size_t i = 0; i < shares.size(); ++i)
        outward += shares[i] *
                   (compressed[i].x * accelerations[i].x + compressed[i].z * accelerations[i].z);
    EXPECT_GT(outward, 0.0);
}

TEST_F(HairOnHair, DoesNotRepelWhereThereIsRoom) {
    const groom::Groom groom = bundle(60, 0.08, {0, 1, 0});
    VolumeRig rig(device(), groom, contact(0.0f, 1.0f, 100.0f));
    EXPECT_EQ(
        largestDifference(
            rig.accelerations(groom.points, groom.points, {}, kOthers),
            std::vector(groom.points.size(), kOthers)),
        0.0);
}

// Short strands on a lattice with two per cell get longer along x, by half in the middle's distance
// from a face.
constexpr int kSide = 29;  // 14 cells
constexpr double kGap = 0.1;  // m
constexpr double kHalf = 0.5 * (kSide - 1) * kGap;
constexpr double kMeanLength = 1e-3;  // m
constexpr std::uint32_t kLatticeResolution = 18;

groom::Groom denserAlongX() {
    groom::Groom groom{.strand_count = kSide * kSide * kSide, .vertices_per_strand = 2};
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
        const glm::dvec3 root =
            kGap * glm::dvec3(i % kSide, i / kSide % kSide, i / kSide / kSide) - kHalf;
        groom.points.emplace_back(root);
        groom.points.emplace_back(
            root + glm::dvec3(0.0, kMeanLength * (1.0 + 0.5 * root.x / kHalf), 0.0));
    }
    return groom;
}

// Compares accelerations of the lattice with those along x that `expected` gives for the place x in
// [-1, 1].
template <class Expected>
void expectAlongX(
    const groom::Groom& groom, const std::vector<glm::vec3>& accelerations, double tolerance,
    Expected expected) {
    for (std::size_t i = 0; i < groom.points.size(); i += 2) {
        const glm::dvec3 place = glm::dvec3(groom.points[i]) / kHalf;
        // A vertex feels hair up to 3 cells away, 3/7 of the half. The edges must be farther away
        // than that.
        if (std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}) > 0.5) continue;
        const glm::dvec3 along(expected(place.x), 0.0, 0.0);
        EXPECT_LT(glm::distance(glm::dvec3(accelerations[i]), along), tolerance) << place.x;
    }
}

// A gas with the speed of sound sqrt(k): a = -dP/dx / density = -k d(ln density)/dx.
TEST_F(HairOnHair, PushesLikeTheGasItStandsFor) {
    const groom::Groom groom = denserAlongX();
    SimulationSettings settings = contact(0.0f, 0.2f, 0.1f);
    settings.hair_hair.resolution = kLatticeResolution;
    VolumeRig rig(device(), groom, settings);
    const auto accelerations = rig.accelerations(groom.points, groom.points);
    // Density changes by 1/14 per cell, up to a tenth of itself, and its logarithm bends by the
    // square of that. The spline has a variance of a quarter of a cell, and is applied twice.
    // Lengths are rounded to 1e-4. The least acceleration is 0.8 of that in the middle.
    expectAlongX(groom, accelerations, 0.008 * 0.2 * 0.5 / kHalf, [](double x) {
        return -0.2 * 0.5 / kHalf / (1.0 + 0.5 * x);
    });
}

// Hair with the length n per volume has the energy -f n cell^2 / 0.3025 per mass, because a strand
// alone fills 0.3025 of a cell's face. It goes where there is more, unless it is crowded
// everywhere.
TEST_F(HairOnHair, AttractsToMoreHairUnlessItIsCrowded) {
    constexpr double kAttraction = 0.05;  // m^2/s^2
    const groom::Groom groom = denserAlongX();
    SimulationSettings settings = wet(kAttraction);
    settings.hair_hair.resolution = kLatticeResolution;
    // Not limited by the step: the greatest density is 1.5 times the mean.
    settings.hair_hair.crowding = 3.0f;
    const double cell = volumeGrid(groom, kLatticeResolution).cell;
    const double expected =
        kAttraction / 0.3025 * cell * cell * kMeanLength * 0.5 / kHalf / std::pow(kGap, 3.0);
    VolumeRig loose(device(), groom, settings);
    // The gradient is linear, so only a strand's own part, a few hundredths of a cell's hair, is
    // sampled.
    expectAlongX(
        groom, loose.accelerations(groom.points, groom.points), 0.01 * expected,
        [&](double) { return expected; });
    settings.hair_hair.crowding = 0.1f;
    settings.hair_hair.attraction *= 30.0f;  // the same below the crowding
    VolumeRig crowded(device(), groom, settings);
    expectAlongX(
        groom, crowded.accelerations(groom.points, groom.points), 0.01 * 30.0 * expected,
        [](double) { return 0.0; });
}

// In hair with N strands through a cell's face where it is crowded, the step bears an attraction of
// 0.3025 / 2 (cell / step)^2 / N, half of that beside cohesion.
TEST_F(HairOnHair, SaysWhereTheStepLimitsAttraction) {
    const groom::Groom groom = denserAlongX();
    SimulationSettings settings = wet(0.0f, 3.0f);
    settings.hair_hair.resolution = kLatticeResolution;
    const VolumeGrid grid = volumeGrid(groom, kLatticeResolution);
    double length = 0.0;
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand)
        for (std::size_t i = 1; i < groom.vertices_per_strand; ++i)
            length += double{glm::distance(groom.strand(strand)[i], groom.strand(strand)[i - 1])};
    const double strands = 3.0 * meanRestDensity(groom, grid) * length / grid.cell;
    const double speed = grid.cell / double{settings.time_step};
    const double theory = 0.3025 / 2.0 * speed * speed / strands;
    const auto limit = [&] {
        const std::vector<StepLimit> limits = limitedBySteps(groom, settings);
        EXPECT_EQ(limits.size(), 1u);
        return limits.empty() ? StepLimit{} : limits[0];
    };
    settings.hair_hair.attraction = static_cast<float>(4.0 * theory);
    const StepLimit found = limit();
    EXPECT_STREQ(found.field, "/simulation/hair_hair/attraction");
    EXPECT_EQ(found.set, double{settings.hair_hair.attraction});
    EXPECT_NEAR(found.used / theory, 1.0, 1e-5);
    EXPECT_NEAR(found.longest_step / double{settings.time_step}, 0.5, 1e-5);

    // The device uses what it says, except for the rounding of the number.
    const auto accelerations = [&] {
        VolumeRig rig(device(), groom, settings);
        return rig.accelerations(groom.points, groom.points);
    };
    const auto limited = accelerations();
    EXPECT_GT(greatestLength(limited), 0.0);
    settings.hair_hair.attraction = static_cast<float>(found.used);
    EXPECT_LT(largestDifference(accelerations(), limited), 1e-5 * greatestLength(limited));

    settings.hair_hair.attraction = static_cast<float>(4.0 * theory);
    settings.hair_hair.cohesion = 0.1f;
    EXPECT_NEAR(limit().used / theory, 0.5, 1e-5);
    settings.hair_hair.cohesion = 0.0f;
    settings.time_step = static_cast<float>(0.999 * found.longest_step);
    EXPECT_TRUE(limitedBySteps(groom, settings).empty());
    settings.hair_hair.repulsion = static_cast<float>(2.04 * speed * speed);
    EXPECT_STREQ(limit().field, "/simulation/hair_hair/repulsion");
}

TEST_F(HairOnHair, IsLikeTheReference) {
    for (const std::uint32_t vertices : {2u, 9u, 33u})
        for (const SimulationSettings& settings :
             {contact(0.3f, 0.0f), contact(0.0f, 0.3f, 0.5f), contact(1.0f, 1000.0f, 0.2f),
              wet(0.3f, 0.5f), wetAnd(contact(0.3f, 0.3f, 0.7f), 0.2f),
              wetAnd(contact(0.0f, 0.0f, 2.0f), 1000.0f)}) {
            const groom::Groom groom = wavyGroom(67, vertices, 0.15 / vertices);
            VolumeRig rig(device(), groom, settings);
            const auto positions = disturbed(groom, 0.003, 1);
            const auto previous = disturbed(groom, 0.003, 2);
            const RigidMotion frame{
                .rotation = glm::angleAxis(0.1, glm::dvec3(0.0, 1.0, 0.0)),
                .translation = {0.01, -0.02, 0.0}};
            const auto accelerations = rig.accelerations(positions, previous, frame);
            const double greatest = greatestLength(accelerations);
            ASSERT_GT(greatest, 0.1);
            // Positions in cells are floats up to 32, rounded to 2e-6. A velocity's difference of
            // some 1e-3 m is one of floats of 0.2 m, rounded to 1e-8. Both are 1e-5.
            EXPECT_LT(
                largestDifference(accelerations, rig.expected(positions, previous, frame)),
                2e-5 * greatest);
        }
}

// A strand at 10 m/s does not take precision from distant hair at about 1 mm/s.
TEST_F(HairOnHair, SlowHairIsLikeTheReferenceBesideFastHair) {
    const groom::Groom slow = wavyGroom(67, 9);
    groom::Groom far = straightGroom(1, 9);
    for (glm::vec3& point : far.points) point.x += 1.5f;
    const groom::Groom groom = both(slow, far);
    std::mt19937 random(9);
    std::vector<glm::vec3> previous;
    for (std::size_t i = 0; i < groom.points.size(); ++i) {
        const glm::dvec3 speed =
            i < slow.points.size() ? 1e-3 * randomVector(random) : glm::dvec3(0.0, 10.0, 0.0);
        previous.emplace_back(glm::dvec3(groom.points[i]) - speed / 60.0);
    }
    VolumeRig rig(device(), groom, contact(0.3f, 0.0f));
    auto accelerations = rig.accelerations(groom.points, previous);
    auto expected = rig.expected(groom.points, previous);
    accelerations.resize(slow.points.size());
    expected.resize(slow.points.size());
    const double greatest = greatestLength(accelerations);
    ASSERT_GT(greatest, 1e-3);
    // The tolerance of IsLikeTheReference without the part for velocities, because their
    // differences are exact here.
    EXPECT_LT(largestDifference(accelerations, expected), 2e-5 * greatest);
}

// Positions after a whole step.
TEST_F(HairOnHair, StepsLikeTheReference) {
    const groom::Groom groom = wavyGroom(67, 9);
    const SimulationSettings settings = contact(0.3f, 0.3f, 0.5f);
    Simulation simulation(device(), groom, settings, 5);
    reference::Reference solver(groom, settings, 5);
    const auto positions = disturbed(groom, 0.003, 11);
    const auto previous = disturbed(groom, 0.003, 12);
    simulation.setState(positions, previous);
    solver.setState(toDouble(positions), toDouble(previous));
    EXPECT_TRUE(simulation.hasVolume());
    advance(device(), simulation, 1);
    solver.step();
    // The tolerance for every constraint alone (gpu_constraints_test.cpp).
    EXPECT_LT(
        largestDifference(simulation.readPositions(), solver.positions()),
        1e-5 * longestStrand(groom));

    SimulationSettings without = settings;
    without.hair_hair = {};
    reference::Reference alone(groom, without, 5);
    alone.setState(toDouble(positions), toDouble(previous));
    alone.step();
    EXPECT_GT(
        largestDifference(alone.positions(), solver.positions()), 1e-3 * longestStrand(groom));
}

TEST_F(HairOnHair, SettlesLikeSteps) {
    const groom::Groom groom = wavyGroom(67, 9);
    SimulationSettings settings = contact(0.3f, 0.3f, 0.5f);
    Simulation expected(device(), groom, settings, 5);
    advance(device(), expected, 70);
    settings.settle_steps = 70;
    Simulation settled(device(), groom, settings, 5);
    const auto points = settled.readPositions();
    EXPECT_EQ(points, expected.readPositions());
}

TEST_F(HairOnHair, IsOffUnlessAsked) {
    const groom::Groom groom = wavyGroom(3, 9);
    EXPECT_FALSE(Simulation(device(), groom, SimulationSettings{}, 1).hasVolume());
    EXPECT_TRUE(Simulation(device(), groom, contact(0.1f, 0.0f), 1).hasVolume());
    EXPECT_TRUE(Simulation(device(), groom, contact(0.0f, 0.1f), 1).hasVolume());
    SimulationSettings sheltered = contact(0.0f, 0.0f);
    sheltered.hair_hair.shelter = 1.0f;
    EXPECT_TRUE(Simulation(device(), groom, sheltered, 1).hasVolume());
    EXPECT_TRUE(Simulation(device(), groom, sticky(0.1f), 1).hasVolume());
    EXPECT_FALSE(Simulation(device(), groom, sticky(0.0f, 0.5f, 0.0f), 1).hasVolume());
    EXPECT_TRUE(Simulation(device(), groom, wet(0.1f), 1).hasVolume());
    SimulationSettings frozen = contact(0.1f, 0.1f);
    frozen.solver = Solver::none;
    EXPECT_FALSE(Simulation(device(), groom, frozen, 1).hasVolume());
}

TEST_F(HairOnHair, GivesTheSameBitsEveryTime) {
    const groom::Groom groom = wavyGroom(200, 9);
    for (SimulationSettings settings : {contact(0.5f, 0.5f, 0.5f), sticky(0.1f, 0.5f, 0.5f)}) {
        settings.wind.strength = 10.0f;
        Simulation first(device(), groom, settings, 5);
        Simulation second(device(), groom, settings, 5);
        advance(device(), first, 30);
        for (int i = 0; i < 30; ++i) advance(device(), second, 1);
        const auto points = first.readPositions();
        EXPECT_EQ(points, second.readPositions());
        first.reset();
        advance(device(), first, 30);
        EXPECT_EQ(points, first.readPositions());
    }
}

TEST_F(HairOnHair, StaysFiniteAtExtremes) {
    groom::Groom groom = wavyGroom(20, 5);
    groom.points[7] = groom.points[6];
    groom::Groom point = groom;
    point.points.assign(groom.points.size(), glm::vec3(0.5f));
    for (const groom::Groom& some : {groom, point})
        for (const std::uint32_t resolution : {8u, 128u})
            for (const float step : {0.0005f, 0.1f})
                for (const float crowding : {0.1f, 100.0f})
                    for (const bool sticks : {false, true}) {
                        SimulationSettings settings =
                            wetAnd(contact(1.0f, 1000.0f, crowding), 1000.0f);
                        if (sticks) {
                            settings.hair_hair.friction = 0.0f;
                            settings.hair_hair.friction_coefficient = 10.0f;
                            settings.hair_hair.cohesion = 1000.0f;
                        }
                        settings.hair_hair.resolution = resolution;
                        settings.time_step = step;
                        settings.wind.strength = 1500.0f;
                        Simulation simulation(device(), some, settings, 1);
                        advance(device(), simulation, 20);
                        const std::vector<glm::vec3> collapsed(some.points.size(), glm::vec3(0.1f));
                        simulation.setState(collapsed, collapsed);
                        advance(device(), simulation, 20);
                        const std::vector<glm::vec3> far(some.points.size(), glm::vec3(1e6f));
                        simulation.setState(far, collapsed);
                        advance(device(), simulation, 20);
                        for (const glm::vec3& p : simulation.readPositions())
                            ASSERT_TRUE(
                                std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
                    }
}

}  // namespace
}  // namespace hair::simulation
