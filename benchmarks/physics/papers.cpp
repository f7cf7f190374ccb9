#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/experiment.h"
#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/scene.h"
#include "engine/files.h"

// Published results, played as the scenes of scenes/papers. docs/physics.md has the papers' figures
// beside ours.
namespace benchmarks::physics {
namespace {

// A scene of scenes/papers, with its first strand.
struct PaperScene {
    explicit PaperScene(const std::string& name) {
        const std::filesystem::path path =
            engine::programFile("scenes") / "papers" / (name + ".json");
        const hair::Settings all = scene::loadScene(path).settings;
        settings = all.simulation;
        scene::AssetStore assets;
        groom = assets.groom(all, path.parent_path());
    }

    hair::SimulationSettings settings;
    hair::groom::Groom groom;
};

double arcLength(std::span<const glm::dvec3> points) {
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += glm::distance(points[i], points[i - 1]);
    return sum;
}

std::vector<glm::dvec3> pointsOf(const hair::groom::Groom& groom) {
    return {groom.points.begin(), groom.points.end()};
}

// ---- Stable Cosserat rods -----------------------------------------------------------------------

// A tip of the authors' cantilever, to the four digits that are known.
struct KnownTip {
    double time;  // s
    double x, y;  // m
};
constexpr KnownTip kMoving[] = {{0.1, 0.9999, -0.0528}, {0.4, 0.9521, -0.3322}};
constexpr KnownTip kResting = {20.0, 0.9657, -0.2846};
constexpr double kRestingLength = 1.0103;  // m
// Half of the last digit in both coordinates, and rounding of 32 bits over 48 steps.
constexpr double kTipTolerance = 1.5e-4;  // m
constexpr double kLengthTolerance = 1e-4;  // relative: half of the last digit, and rounding
// At rest an iteration changes nothing, so that the number of iterations does not matter. The
// tolerance allows for motion that is left after 20 s, and for rounding.
constexpr double kSameRest = 1e-4;  // m
// Height of the tip at 0.4 s by a separate program of the paper's equations, in double precision.
struct Descent {
    std::uint32_t iterations;
    double height;  // m
};
constexpr Descent kDescents[] = {{1, -0.21376}, {2, -0.27305},  {4, -0.33228},
                                 {8, -0.37806}, {16, -0.39803}, {64, -0.40115}};

double distanceTo(const KnownTip& known, const glm::dvec3& tip) {
    return glm::distance(tip, glm::dvec3(known.x, known.y, 0.0));
}

}  // namespace

void playStableCosserat(const engine::Device& device, PaperSize size, Findings& findings) {
    PaperScene paper("stable_cosserat");
    Experiment experiment(device, paper.groom, paper.settings);
    double now = 0.0;
    const auto playTo = [&](Experiment& played, double time) {
        played.advance(played.stepsIn(time - now));
        now = time;
        return played.positions();
    };
    for (const KnownTip& known : kMoving)
        findings.deviation(
            {"tip's distance from the authors'", "m", {{"time", known.time, "s"}}},
            distanceTo(known, playTo(experiment, known.time).back()), kTipTolerance);
    const std::vector<glm::dvec3> resting = playTo(experiment, kResting.time);
    findings.deviation(
        {"tip's distance from the authors' at rest", "m"}, distanceTo(kResting, resting.back()),
        kTipTolerance);
    findings.compare({"length at rest", "m"}, arcLength(resting), kRestingLength, kLengthTolerance);
    if (size == PaperSize::small) return;

    // With fewer iterations hair falls more slowly.
    std::vector<std::vector<double>> rows;
    for (const auto& [iterations, height] : kDescents) {
        paper.settings.stable_cosserat.iterations = iterations;
        Experiment other(device, paper.groom, paper.settings);
        now = 0.0;
        const glm::dvec3 moving = playTo(other, kMoving[1].time).back();
        const glm::dvec3 rest = playTo(other, kResting.time).back();
        findings.deviation(
            {"tip's height at 0.4 s, off theory's",
             "m",
             {{"iterations", double(iterations), "count"}, {"theory", height, "m"}}},
            std::abs(moving.y - height), kTipTolerance);
        findings.deviation(
            {"tip's distance at rest from that of 4 iterations",
             "m",
             {{"iterations", double(iterations), "count"}}},
            glm::distance(rest, resting.back()), kSameRest);
        rows.push_back({double(iterations), moving.x, moving.y, rest.x, rest.y});
    }
    findings.curve(
        "tip by iterations",
        {{"iterations", "count"}, {"x at 0.4 s", "m"}, {"y at 0.4 s", "m"}, {"x", "m"}, {"y", "m"}},
        std::move(rows));

    // Our method bends the whole metre.
    paper.settings.stable_cosserat.method = hair::CosseratMethod::direct;
    Experiment ours(device, paper.groom, paper.settings);
    now = 0.0;
    const std::vector<glm::dvec3> direct = playTo(ours, kResting.time);
    findings.value({"drop of the tip at rest by our method", "m"}, -direct.back().y);
    findings.value({"length at rest by our method", "m"}, arcLength(direct));
}

// ---- Augmented mass-spring model ----------------------------------------------------------------

namespace {

// Strands and frames per second of the paper's three grooms.
struct KnownRate {
    std::uint32_t strands;
    double frames;  // 1/s
};
constexpr KnownRate kKnownRates[] = {{14718, 67.0}, {10298, 114.0}, {7528, 156.0}};
constexpr std::array kIntegrities = {10.0f, 100.0f, 1000.0f, 10000.0f};  // 1/s^2
// From here on, springs of the strand deflect the tip by less than a hundredth.
constexpr float kStiffIntegrity = 1000.0f;
constexpr double kSagTolerance = 0.02;

// A straight strand per guide with this many segments, beside each other.
hair::groom::Groom manyStrands(const hair::groom::Groom& one, std::uint32_t count) {
    hair::groom::Groom groom = one;
    groom.strand_count = count;
    groom.points.clear();
    groom.points.reserve(std::size_t{count} * one.points.size());
    for (std::uint32_t strand = 0; strand < count; ++strand)
        for (const glm::vec3& point : one.points)
            groom.points.push_back(point + glm::vec3(0.0f, 0.0f, 1e-5f * float(strand)));
    return groom;
}

// The median time of a time step, s.
double timeOfStep(
    const engine::Device& device, const hair::groom::Groom& groom,
    const hair::SimulationSettings& settings) {
    Experiment experiment(device, groom, settings);
    experiment.advance(1);
    std::vector<double> times;
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        experiment.advance(1);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        times.push_back(took.count());
    }
    std::ranges::nth_element(times, times.begin() + 2);
    return times[2];
}

}  // namespace

void playAugmentedMassSpring(const engine::Device& device, PaperSize size, Findings& findings) {
    PaperScene paper("augmented_mass_spring");
    const double gravity = -double{paper.settings.gravity.y};
    const glm::dvec3 ghost = pointsOf(paper.groom).back();
    for (const float integrity : kIntegrities) {
        hair::SimulationSettings settings = paper.settings;
        settings.augmented_mass_spring.integrity = integrity;
        Experiment experiment(device, paper.groom, settings);
        experiment.settle(1e-6, 10.0);
        const double sag = ghost.y - experiment.positions().back().y;
        Quantity quantity{"sag of the tip", "m", {{"integrity", integrity, "1/s^2"}}};
        // Far from the root nothing but the spring to the ghost bears a vertex.
        if (integrity >= kStiffIntegrity)
            findings.compare(std::move(quantity), sag, gravity / integrity, kSagTolerance);
        else
            findings.value(std::move(quantity), sag);
    }
    if (size == PaperSize::small) return;

    // A plain mass-spring system: no ghost.
    PaperScene plain("augmented_mass_spring");
    for (const double modulus : {1e5, 1e6, 1e7}) {
        plain.settings.augmented_mass_spring.integrity = 0.0f;
        plain.settings.augmented_mass_spring.spring_modulus = static_cast<float>(modulus);
        Experiment experiment(device, plain.groom, plain.settings);
        experiment.settle(1e-6, 10.0);
        findings.value(
            {"sag of the tip without a ghost", "m", {{"spring modulus", modulus, "Pa"}}},
            ghost.y - experiment.positions().back().y);
    }
    for (const KnownRate& known : kKnownRates) {
        const double time =
            timeOfStep(device, manyStrands(paper.groom, known.strands), paper.settings);
        findings.value(
            {"steps a second; the paper's frames",
             "1/s",
             {{"strands", double(known.strands), "count"}, {"the paper's", known.frames, "1/s"}}},
            1.0 / time);
    }
}

// ---- Follow the leader --------------------------------------------------------------------------

namespace {

// Both are differences of positions in 32 bits: a unit in the last place of 0.3 m on 15 mm.
constexpr double kInextensible = 1e-5;
constexpr double kFallTime = 3.0;  // s

struct Swing {
    double stretch = 0.0;  // greatest |l / l0 - 1| after any step
    double far_side = 0.0;  // greatest distance of the tip beyond the root, over the length
    double back = 0.0;  // after that, greatest return to the side of the start
};

Swing swingOf(
    const engine::Device& device, const PaperScene& paper,
    const hair::SimulationSettings& settings) {
    const std::vector<glm::dvec3> rest = pointsOf(paper.groom);
    const double length = arcLength(rest);
    Experiment experiment(device, paper.groom, settings);
    Swing swing;
    bool returns = false;
    for (std::uint32_t i = 0; i < experiment.stepsIn(kFallTime); ++i) {
        experiment.advance(1);
        const std::vector<glm::dvec3> points = experiment.positions();
        for (std::size_t k = 1; k < points.size(); ++k)
            swing.stretch = worst(
                swing.stretch,
                std::abs(
                    glm::distance(points[k], points[k - 1]) / glm::distance(rest[k], rest[k - 1]) -
                    1.0));
        const double side = points.back().x / length;
        swing.far_side = std::max(swing.far_side, -side);
        if (swing.far_side > 0.0 && side > 0.0) returns = true;
        if (returns) swing.back = std::max(swing.back, side);
    }
    return swing;
}

}  // namespace

void playFollowTheLeader(const engine::Device& device, PaperSize size, Findings& findings) {
    const PaperScene paper("follow_the_leader");
    for (const float correction : {0.0f, 0.9f, 1.0f}) {
        hair::SimulationSettings settings = paper.settings;
        settings.ftl.velocity_correction = correction;
        const Swing swing = swingOf(device, paper, settings);
        const std::vector<Parameter> with{{"velocity correction", correction, "1"}};
        findings.deviation({"greatest stretch", "1", with}, swing.stretch, kInextensible);
        findings.value({"swing to the far side / length", "1", with}, swing.far_side);
        findings.value({"swing back / length", "1", with}, swing.back);
    }
    const hair::SimulationSettings limp =
        chain(hair::Solver::rod, arcLength(pointsOf(paper.groom)));
    const Swing swing = swingOf(device, paper, limp);
    findings.value({"swing to the far side / length by rod", "1"}, swing.far_side);
    findings.value({"swing back / length by rod", "1"}, swing.back);
    if (size == PaperSize::small) return;
    for (const std::uint32_t strands : {1000u, 10000u})
        findings.value(
            {"time of a step", "ms", {{"strands", double(strands), "count"}}},
            1e3 * timeOfStep(device, manyStrands(paper.groom, strands), paper.settings));
}

// ---- Shape constraints --------------------------------------------------------------------------

namespace {

// From the abstract: around 20,000 strands of 0.22 million vertices in less than 1 ms.
constexpr std::uint32_t kStyledStrands = 20000;
constexpr double kStyledTime = 1.0;  // ms

}  // namespace

void playShapeConstraints(const engine::Device& device, PaperSize size, Findings& findings) {
    const PaperScene paper("shape_constraints");
    const std::vector<glm::dvec3> rest = pointsOf(paper.groom);
    for (const auto scaling : {hair::StiffnessScaling::thesis, hair::StiffnessScaling::invariant}) {
        const bool as_published = scaling == hair::StiffnessScaling::thesis;
        std::optional<double> before;
        for (const std::uint32_t iterations : {1u, 5u, 20u}) {
            hair::SimulationSettings settings = paper.settings;
            settings.stiffness_scaling = scaling;
            settings.local.iterations = iterations;
            Experiment experiment(device, paper.groom, settings);
            experiment.advance(experiment.stepsIn(5.0));
            const double drop = -experiment.positions().back().y / arcLength(rest);
            const std::vector<Parameter> with{{"iterations", double(iterations), "count"}};
            if (!as_published) {
                findings.value({"drop / length, invariant", "1", with}, drop);
                continue;
            }
            // The paper's: more iterations make hair stiffer.
            if (before)
                findings.deviation(
                    {"drop / that of fewer iterations", "1", with}, drop / *before, 1.0);
            findings.value({"drop / length", "1", with}, drop);
            before = drop;
        }
    }
    if (size == PaperSize::small) return;
    findings.value(
        {"time of a step; the paper's is below",
         "ms",
         {{"strands", double{kStyledStrands}, "count"}, {"the paper's", kStyledTime, "ms"}}},
        1e3 * timeOfStep(device, manyStrands(paper.groom, kStyledStrands), paper.settings));
}

// ---- Position-based rods ------------------------------------------------------------------------

namespace {

// A fraction of the length. The helix has no weight, so it is at rest as it was groomed.
constexpr double kHelixTolerance = 0.01;
constexpr double kHelixPatience = 4.0;  // s

// Lets a rod go straight and counts the seconds until it is a helix again, or NaN.
double timeToHelix(
    const engine::Device& device, const PaperScene& paper, const hair::SimulationSettings& settings,
    double& off) {
    const std::vector<glm::dvec3> helix = pointsOf(paper.groom);
    const double length = arcLength(helix);
    std::vector<glm::dvec3> straight;
    for (std::size_t i = 0; i < helix.size(); ++i)
        straight.push_back(
            helix[0] +
            glm::normalize(helix[1] - helix[0]) * length * double(i) / double(helix.size() - 1));
    Experiment experiment(device, paper.groom, settings);
    experiment.place(straight);
    double reached = std::numeric_limits<double>::quiet_NaN();
    for (std::uint32_t i = 1; i <= experiment.stepsIn(kHelixPatience); ++i) {
        experiment.advance(1);
        off = greatestDistance(experiment.positions(), helix) / length;
        if (!(off < kHelixTolerance))
            reached = std::numeric_limits<double>::quiet_NaN();
        else if (std::isnan(reached))
            reached = i * experiment.timeStep();
    }
    return reached;
}

}  // namespace

void playPositionBasedRod(const engine::Device& device, PaperSize size, Findings& findings) {
    const PaperScene paper("position_based_rod");
    std::vector<std::uint32_t> iterations{paper.settings.position_based_rod.iterations};
    if (size == PaperSize::whole) iterations = {1, 2, 4, 8, 16, 32};
    for (const std::uint32_t each : iterations) {
        hair::SimulationSettings settings = paper.settings;
        settings.position_based_rod.iterations = each;
        double off = 0.0;
        const double time = timeToHelix(device, paper, settings, off);
        const std::vector<Parameter> with{{"iterations", double(each), "count"}};
        const bool promised = each == paper.settings.position_based_rod.iterations;
        findings.deviation(
            {"distance from the helix after 4 s / length", "1", with}, off,
            promised ? std::optional(kHelixTolerance) : std::nullopt);
        Outcome& outcome = findings.value({"time to the helix", "s", with}, time);
        if (std::isnan(time)) outcome.reason = "not within 4 s";
    }
}

// ---- All papers ---------------------------------------------------------------------------------

namespace {

template <void (*kPlay)(const engine::Device&, PaperSize, Findings&)>
void playWhole(const engine::Device& device, const CheckedSolver&, Findings& findings) {
    kPlay(device, PaperSize::whole, findings);
}

struct Paper {
    Check check;
    hair::Solver solver;
};

constexpr Paper kPapers[] = {
    {{"stable_cosserat", playWhole<playStableCosserat>}, hair::Solver::stable_cosserat},
    {{"augmented_mass_spring", playWhole<playAugmentedMassSpring>},
     hair::Solver::augmented_mass_spring},
    {{"follow_the_leader", playWhole<playFollowTheLeader>}, hair::Solver::ftl},
    {{"shape_constraints", playWhole<playShapeConstraints>}, hair::Solver::shape},
    {{"position_based_rod", playWhole<playPositionBasedRod>}, hair::Solver::position_based_rod},
};

}  // namespace

void playPapers(const engine::Device& device, PhysicsReport& report) {
    for (const Paper& paper : kPapers) {
        if (report.interrupted) return;
        const CheckedSolver solver(paper.solver);
        runChecks(device, std::span(&paper.check, 1), std::span(&solver, 1), report);
    }
}

}  // namespace benchmarks::physics
