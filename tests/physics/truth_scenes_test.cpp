// The scenes of scenes/truth, compared with theory, as a user opens them.
#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>

#include "benchmarks/physics/kirchhoff.h"
#include "benchmarks/physics/theory.h"
#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/scene.h"
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

}  // namespace
}  // namespace benchmarks::physics
