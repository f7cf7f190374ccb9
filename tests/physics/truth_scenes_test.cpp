// The scenes of scenes/truth, compared with theory, as a user opens them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>

#include "benchmarks/physics/kirchhoff.h"
#include "benchmarks/physics/theory.h"
#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/scene.h"
#include "hair/simulation/solvers.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/simulation/gpu_simulation.h"

namespace benchmarks::physics {
namespace {

namespace fs = std::filesystem;

// The hair of a scene, played step by step.
class TruthScene {
public:
    TruthScene(const engine::Device& device, const std::string& name, float time_step = 0.0f)
        : device_(device), path_(fs::path(HAIRBENCH_SCENES_DIR) / "truth" / (name + ".json")),
          settings_(scene::loadScene(path_).settings) {
        if (time_step > 0.0f) settings_.simulation.time_step = time_step;
        groom_ = assets_.groom(settings_, path_.parent_path());
        simulation_.emplace(device, groom_, settings_.simulation, settings_.seed);
    }

    const hair::SimulationSettings& settings() const { return settings_.simulation; }
    const hair::groom::Groom& groom() const { return groom_; }
    double timeStep() const { return settings_.simulation.time_step; }

    void play(double seconds) {
        hair::simulation::advance(
            device_, *simulation_, static_cast<int>(std::lround(seconds / timeStep())));
    }

    // The points of a strand relative to its root, m.
    std::vector<glm::dvec3> strand(std::uint32_t index) const {
        const auto all = simulation_->readPositions();
        const auto first = all.begin() + index * groom_.vertices_per_strand;
        std::vector<glm::dvec3> points;
        for (auto point = first; point != first + groom_.vertices_per_strand; ++point)
            points.push_back(glm::dvec3(*point) - glm::dvec3(*first));
        return points;
    }

    double length(std::uint32_t index) const {
        double sum = 0.0;
        const auto points = groom_.strand(index);
        for (std::size_t i = 1; i < points.size(); ++i)
            sum += glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i - 1]));
        return sum;
    }

private:
    const engine::Device& device_;
    fs::path path_;
    hair::Settings settings_;
    scene::AssetStore assets_;
    hair::groom::Groom groom_;
    std::optional<hair::simulation::Simulation> simulation_;
};

using TruthScenes = GpuTest;

// Requirement: 2 %. The clamp is half a segment longer than that of 64 segments.
TEST_F(TruthScenes, LevelHairSagsAsTheElastica) {
    const TruthScene scene(device(), "cantilever");
    ASSERT_EQ(scene.groom().strand_count, 4u);
    const double gammas[] = {1.0, 10.0, 100.0, 1000.0};
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(scene.length(i), lengthOf(scene.settings().material, gammas[i]), 1e-6);
        const glm::dvec3 tip = scene.strand(i).back();
        EXPECT_NEAR(-tip.y / tip.x / cantileverRatio(gammas[i]), 1.0, 0.02) << gammas[i];
    }
}

// Requirement: 2 % of the length at any time step if theory has a steady state, and 1 % between
// time steps.
TEST_F(TruthScenes, WindHoldsHairWhereTheElasticaIs) {
    std::vector<std::vector<glm::dvec3>> tips;
    for (const float rate : {30.0f, 60.0f, 480.0f}) {
        TruthScene scene(device(), "drag_deflection", 1.0f / rate);
        ASSERT_EQ(scene.groom().strand_count, 3u);
        scene.play(10.0);
        auto& of_rate = tips.emplace_back();
        for (std::uint32_t i = 0; i < 3; ++i) {
            const double length = scene.length(i);
            of_rate.push_back(scene.strand(i).back() / length);
            const glm::dvec2 theory =
                draggedTip(scene.settings(), double{scene.settings().wind.speed}, length);
            EXPECT_LT(glm::distance(of_rate.back(), glm::dvec3(theory, 0.0) / length), 0.02)
                << rate << ' ' << length;
        }
        EXPECT_LT(largestDifference(of_rate, tips.front()), 0.01) << rate;
    }
}

// Requirement: 2 % of the length. Two of the lengths are below the theoretical buckling length, two
// above.
TEST_F(TruthScenes, FlatHairBucklesSideways) {
    TruthScene scene(device(), "lateral_buckling");
    ASSERT_EQ(scene.groom().strand_count, 4u);
    scene.play(10.0);
    ClampedRod rod{
        .section = sectionStiffness(scene.settings().material),
        .weight = lineDensity(scene.settings().material) * kGravity,
        .length = 0.0,
        .clamp = kPi / 2.0};
    for (std::uint32_t i = 0; i < 4; ++i) {
        rod.length = scene.length(i);
        const glm::dvec3 tip = scene.strand(i).back() / rod.length;
        const std::optional<glm::dvec3> buckled = buckledTip(rod);
        ASSERT_EQ(buckled.has_value(), i >= 2) << rod.length;
        if (buckled)
            EXPECT_LT(glm::distance({tip.x, tip.y, std::abs(tip.z)}, *buckled / rod.length), 0.02)
                << rod.length;
        else
            EXPECT_LT(std::abs(tip.z), 0.01) << rod.length;
    }
}

// Requirement: 1 % of the length after 5 s, and no flutter. tests/simulation/bending_test.cpp
// compares the position.
TEST_F(TruthScenes, WindHoldsShapesHairInOnePlaceAtAnyTimeStep) {
    std::vector<glm::dvec3> rest;
    for (const float rate : {60.0f, 120.0f, 240.0f, 480.0f}) {
        TruthScene scene(device(), "shape_in_wind", 1.0f / rate);
        ASSERT_EQ(scene.groom().strand_count, 2u);
        const auto points = [&] {
            std::vector<glm::dvec3> both = scene.strand(0);
            for (const glm::dvec3& point : scene.strand(1)) both.push_back(point);
            return both;
        };
        scene.play(4.9);
        const auto before = points();
        EXPECT_GT(before[7].x, 0.5 * scene.length(0)) << "wind blows at it";
        scene.play(0.1);
        const auto after = points();
        if (rest.empty()) rest = after;
        EXPECT_LT(largestDifference(after, before), 0.001 * scene.length(0)) << rate;
        EXPECT_LT(largestDifference(after, rest), 0.01 * scene.length(0)) << rate;
    }
}

// The frequency of the tip, from its crossings of its mean position over the measured time.
double frequencyOfTip(TruthScene& scene, double seconds, int axis) {
    std::vector<double> samples;
    const int count = static_cast<int>(std::lround(seconds / scene.timeStep()));
    for (int i = 0; i < count; ++i) {
        scene.play(scene.timeStep());
        samples.push_back(scene.strand(0).back()[axis]);
    }
    const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / count;
    for (double& sample : samples) sample -= mean;
    return frequencyOf(samples, scene.timeStep())
        .value_or(std::numeric_limits<double>::quiet_NaN());
}

// Requirement: 2 %. Besides the first mode there are 2 % of the second; its crossings cancel over
// whole periods.
TEST_F(TruthScenes, LevelHairSwingsAsABeam) {
    TruthScene scene(device(), "bending_frequency");
    const hair::MaterialSettings& material = scene.settings().material;
    const double theory =
        cantileverFrequency(bendingStiffness(material), lineDensity(material), scene.length(0));
    EXPECT_NEAR(frequencyOfTip(scene, 5.0 / theory, 1) / theory, 1.0, 0.02);
}

// Requirement: 1 % at 1/60 s, of which 0.4 % is due to 64 masses.
TEST_F(TruthScenes, AChainSwingsAsBernoullis) {
    TruthScene scene(device(), "hanging_chain");
    const double theory = 1.0 / hangingChainPeriod(scene.length(0), kGravity);
    EXPECT_NEAR(frequencyOfTip(scene, 5.0 / theory, 0) / theory, 1.0, 0.01);
    for (const glm::dvec3& point : scene.strand(0)) EXPECT_LT(std::abs(point.x), 0.01);
}

// Requirement: 1 % of the length, of which 12 segments differ from the elastica by up to 0.7 %.
// Rows keep their order, so each has the same hair before it. Undisturbed air would bend the last
// row ten times as far.
TEST_F(TruthScenes, RowsOfHairShelterEachOther) {
    TruthScene scene(device(), "sheltered_bed");
    constexpr std::uint32_t kRows = 12;
    constexpr std::uint32_t kFiles = 7;
    constexpr double kSpacing = 0.0025;  // m
    ASSERT_EQ(scene.groom().strand_count, kRows * kFiles);
    scene.play(1.5);
    const hair::SimulationSettings& settings = scene.settings();
    const double row_area =
        2.0 * double{settings.material.radius} * double{settings.hair_hair.shelter} / kSpacing;
    const double wind = settings.wind.speed;
    ASSERT_LT(shelteredSpeed(settings, wind, (kRows - 0.5) * row_area), 0.2 * wind);
    for (std::uint32_t row = 0; row < kRows; ++row) {
        const std::uint32_t middle = row * kFiles + kFiles / 2;
        const double length = scene.length(middle);
        const double speed = shelteredSpeed(settings, wind, (row + 0.5) * row_area);
        const glm::dvec2 theory = draggedTip(settings, speed, length);
        EXPECT_LT(
            glm::distance(scene.strand(middle).back(), glm::dvec3(theory, 0.0)), 0.01 * length)
            << row;
    }
}

// Requirement: 0.1 % of the length at rest, and 2 % of the distance in motion. Implicit Euler's
// method is ahead: after n substeps of h it has fallen n (n + 1) / 2 g h^2. The root is 7 segments
// away, and the steepest hair slides by half of one.
TEST_F(TruthScenes, HairRestsAndSlidesByCoulombsLaw) {
    TruthScene scene(device(), "slope");
    const double degrees[] = {8.0, 14.0, 16.0, 18.0, 25.0, 40.0};
    ASSERT_EQ(scene.groom().strand_count, std::size(degrees));
    const double friction = scene.settings().collision.friction;
    ASSERT_EQ(
        std::ranges::count_if(
            degrees, [&](double slope) { return std::tan(slope * kPi / 180.0) < friction; }),
        3);
    const double radius = scene.settings().colliders.at(0).radius;
    constexpr double kTime = 0.05;  // s
    scene.play(kTime);
    const auto movedBy = [&](std::uint32_t index) {
        const glm::dvec3 tip = scene.strand(index).back();
        return 2.0 * radius * std::asin(std::hypot(tip.x, tip.y) / (2.0 * radius));
    };
    for (std::uint32_t i = 0; i < std::size(degrees); ++i) {
        const double slope = degrees[i] * kPi / 180.0;
        if (friction > std::tan(slope)) continue;
        const double substep = scene.timeStep() / hair::simulation::stepOf(scene.settings()).count;
        const double theory =
            slideDistance(kGravity, slope, radius, friction, std::sqrt(kTime * (kTime + substep)));
        EXPECT_NEAR(movedBy(i) / theory, 1.0, 0.02) << degrees[i];
    }
    scene.play(1.0);
    for (std::uint32_t i = 0; i < std::size(degrees); ++i)
        if (friction > std::tan(degrees[i] * kPi / 180.0))
            EXPECT_LT(movedBy(i), 1e-3 * scene.length(i)) << degrees[i];
        else
            EXPECT_GT(movedBy(i), 0.02) << degrees[i];
}

// Requirement: 12 % of the yield stress, the error of a slip surface on a grid that hair_hair.h
// derives, and 1 % of the free speed where it holds. A layer of the height h bears the stress h
// times the part of the drive that does not accelerate it.
TEST_F(TruthScenes, HairSticksToHairUpToItsYieldStress) {
    TruthScene scene(device(), "sticking_layers");
    constexpr std::uint32_t kFiles = 6;
    constexpr std::uint32_t kHeld = 4 * kFiles;
    constexpr std::uint32_t kThin = 2 * kFiles;
    constexpr std::uint32_t kThick = 4 * kFiles;
    constexpr double kSpacing = 0.005;  // m
    ASSERT_EQ(scene.groom().strand_count, 2 * kHeld + kThin + kThick);
    const double drive = scene.settings().gravity.x;
    const double cohesion = scene.settings().hair_hair.cohesion;
    ASSERT_LT(drive * 2.0 * kSpacing, cohesion) << "the thin layers rest";
    ASSERT_GT(drive * 4.0 * kSpacing, 1.5 * cohesion) << "the thick layers slide";
    // The mean place of these strands along the drive, without their threads' roots.
    const auto place = [&](std::uint32_t first, std::uint32_t count) {
        double sum = 0.0;
        for (std::uint32_t i = first; i < first + count; ++i) {
            const std::vector<glm::dvec3> points = scene.strand(i);
            for (std::size_t vertex = 1; vertex < points.size(); ++vertex)
                sum += points[vertex].x / static_cast<double>((points.size() - 1) * count);
        }
        return sum;
    };
    const auto speeds = [&] {
        const double thin = place(kHeld, kThin);
        const double thick = place(2 * kHeld + kThin, kThick);
        scene.play(scene.timeStep());
        return glm::dvec2(place(kHeld, kThin) - thin, place(2 * kHeld + kThin, kThick) - thick) /
               scene.timeStep();
    };
    scene.play(0.25);
    const double before = speeds().y;
    scene.play(0.25);
    const glm::dvec2 after = speeds();
    EXPECT_LT(std::abs(after.x), 0.01 * drive * 0.5);
    const double acceleration = (after.y - before) / (0.25 + scene.timeStep());
    EXPECT_NEAR((drive - acceleration) * 4.0 * kSpacing / cohesion, 1.0, 0.12);
}

// Requirement: 2 % of the sag that a load which had not turned would have. The linear solid adds
// the sags of all loads; turning the hair over takes away twice the weight.
TEST_F(TruthScenes, HairThatYieldsRemembersItsLoads) {
    TruthScene scene(device(), "bending_set");
    const hair::MaterialSettings& material = scene.settings().material;
    const double share = material.set_share;
    ASSERT_EQ(share, 0.5);
    const double length = scene.length(0);
    const double first = lineDensity(material) * kGravity * std::pow(length, 4.0) /
                         (8.0 * bendingStiffness(material));  // sag of the beam, m
    constexpr double kTurned = 1.025;  // s, the middle of the turn
    const auto crept = [&](double time) {
        const double rate = (1.0 - share) / double{material.set_time};
        return first * (1.0 - share * std::exp(-rate * time)) / (1.0 - share);
    };
    double now = 0.0;
    for (const double time : {0.25, 0.5, 1.0, 1.25, 1.5, 2.0}) {
        scene.play(time - now);
        now = time;
        const double expected =
            time < kTurned ? crept(time) : 2.0 * crept(time - kTurned) - crept(time);
        EXPECT_NEAR(-scene.strand(0).back().y, expected, 0.02 * crept(time)) << time;
    }
}

// Requirement: 2 %, as for dry hair.
TEST_F(TruthScenes, WaterWeighsHairDown) {
    const TruthScene scene(device(), "wet_cantilever");
    const double water = scene.settings().material.water;
    ASSERT_EQ(water, 1.0);
    const double gammas[] = {1.0, 10.0, 100.0, 1000.0};  // of dry hair
    for (std::uint32_t i = 0; i < std::size(gammas); ++i) {
        const glm::dvec3 tip = scene.strand(i).back();
        const double theory = cantileverRatio(gammas[i] * (1.0 + water));
        EXPECT_NEAR(-tip.y / tip.x / theory, 1.0, 0.02) << gammas[i];
    }
}

// Requirement: 6 % of Bico's length, to which the grid's range adds 4 % (check `wet_hair`). Surface
// energy and bending decide the length, wherever the hairs first meet.
TEST_F(TruthScenes, WaterJoinsTwoHairsAsFarAsTheyBend) {
    TruthScene scene(device(), "wet_pair");
    scene.play(1.5);
    const std::vector<glm::dvec3> left = scene.strand(0);
    const std::vector<glm::dvec3> right = scene.strand(1);
    const double distance = 0.008;  // m
    std::vector<double> apart;
    for (std::size_t i = 0; i < left.size(); ++i)
        apart.push_back(glm::distance(left[i] + glm::dvec3(distance, 0.0, 0.0), right[i]));
    EXPECT_LT(apart.back(), 0.05 * distance);
    const hair::MaterialSettings& material = scene.settings().material;
    constexpr double kSurfaceTension = 0.072;  // of water, N/m
    const double energy =
        (2.0 * kPi - 4.0) * kSurfaceTension * double{material.radius};  // per joined length, N
    const double attraction = scene.settings().hair_hair.attraction;
    EXPECT_NEAR(attraction * lineDensity(material) / energy, 1.0, 0.005);
    const double segment = scene.length(0) / static_cast<double>(left.size() - 1);
    const double theory =
        std::pow(9.0 * bendingStiffness(material) * distance * distance / energy, 0.25);
    EXPECT_NEAR(joiningLength(apart, distance, segment) / theory, 1.0, 0.06);
}

}  // namespace
}  // namespace benchmarks::physics
