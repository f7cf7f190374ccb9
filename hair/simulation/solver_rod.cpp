#include "hair/simulation/solver_rod.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/buffer_image.h"
#include "engine/transfer.h"
#include "hair/simulation/rod_balance.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {

// Rods at rest, in the solver's form. A segment shorter than 1e-9 m takes the direction of the
// segment before it, or +y if it is the first. It bends with its neighbours and has mass.
struct RodRest {
    std::vector<glm::vec4> segments;  // [vertex][gpu::kRodSegmentRows][strand]
    std::vector<float> units;  // [strand], m
    std::optional<RestBalance> balance;
};

namespace {

using engine::Access;

constexpr double kShortest = 1e-9;  // m
constexpr double kShortestUnit = 1e-6;  // m, for strands without length
constexpr double kLeastMass = 0.01;  // of a vertex, relative to the mean
constexpr double kMostStiffness = 1e15;  // rigid against any inertia; its square still fits a float
// An ellipse with the area of a circle has the second moments I e and I / e and the torsion
// constant 4 I / (e + 1 / e), where I is the circle's second moment and e the ratio of the
// ellipse's axes: Timoshenko and Goodier 1951, Theory of elasticity. Returns 4 / (e + 1 / e).
double torsionOf(double ellipticity) { return 4.0 / (ellipticity + 1.0 / ellipticity); }

// Bound on the ratio of bending to twisting stiffness and on its inverse, far beyond any material.
// At a ratio of 10^7, 32-bit floats lose the smaller stiffness.
constexpr double kMostAnisotropy = 1e3;

glm::dquat halfOf(glm::dquat rotation) {
    if (rotation.w < 0.0) rotation = -rotation;
    return glm::normalize(rotation + glm::dquat(1.0, 0.0, 0.0, 0.0));
}

glm::vec4 toGpu(const glm::dquat& q) { return glm::dvec4(q.x, q.y, q.z, q.w); }

struct Strand {
    HangingRod rod;  // without weights, in the strand's units
    std::vector<double> masses;  // [vertex], relative to a segment of unit length
    std::vector<glm::dquat> half_rotations;  // at joints; entry 0: the follicle's orientation
    double unit;  // m
};

// `bending` is h^2 E I / lambda, m^4. Divided by the fourth power of a length, it is the stiffness
// of a joint of that length in its own units. `twisting` is G J / (E I).
Strand restOfStrand(
    std::span<const glm::vec3> points, double bending, double twisting, double ellipticity) {
    const std::size_t size = points.size();
    std::vector<double> lengths{0.0};
    for (std::size_t i = 1; i < size; ++i)
        lengths.push_back(glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i - 1])));
    double unit = 0.0;
    for (const double length : lengths) unit += length / static_cast<double>(size - 1);
    unit = std::max(unit, kShortestUnit);

    Strand strand{
        .rod = {.ellipticity = ellipticity}, .masses = {}, .half_rotations = {}, .unit = unit};
    glm::dvec3 tangent{0.0, 1.0, 0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t segment = std::max<std::size_t>(i, 1);  // the first is the follicle's too
        glm::dvec3 next = tangent;
        if (lengths[segment] >= kShortest)
            next = glm::normalize(glm::dvec3(points[segment]) - glm::dvec3(points[segment - 1]));
        const glm::dquat above = orientation;
        orientation = i == 0 ? rotationBetween({0.0, 0.0, 1.0}, next)
                             : glm::normalize(rotationBetween(tangent, next) * orientation);
        tangent = next;

        // The first joint is half of one between the segment and its mirror image in the follicle.
        const double joint = i < 2 ? lengths[segment] / 2.0 : (lengths[i] + lengths[i - 1]) / 2.0;
        const double stiffness = bending / (std::max(joint, kShortest) * unit * unit * unit);
        const double below = i + 1 < size ? lengths[i + 1] : 0.0;
        strand.rod.orientations.push_back(orientation);
        strand.rod.edges.push_back(lengths[i] / unit * tangent);
        strand.rod.bend_stiffness.push_back(stiffness);
        strand.rod.twist_stiffness.push_back(stiffness * twisting);
        strand.masses.push_back(std::max((lengths[i] + below) / (2.0 * unit), kLeastMass));
        strand.half_rotations.push_back(
            i == 0 ? orientation : halfOf(glm::conjugate(above) * orientation));
    }
    return strand;
}

// `pull`: h^2 g, m.
void balance(
    Strand& strand, std::uint32_t index, const glm::dvec3& pull, double most_stiffening,
    RestBalance& result) {
    for (const double mass : strand.masses) strand.rod.weights.push_back(mass / strand.unit * pull);
    const std::optional<BalancedRod> balanced = balanceRod(strand.rod, most_stiffening);
    if (!balanced) {
        result.unbalanced.push_back(index);
        return;
    }
    result.add(balanced->stiffening);
    std::ranges::copy(
        std::span(balanced->half_rotations).subspan(1), strand.half_rotations.begin() + 1);
    for (double& stiffness : strand.rod.bend_stiffness) stiffness *= balanced->stiffening;
    for (double& stiffness : strand.rod.twist_stiffness) stiffness *= balanced->stiffening;
}

RodRest
restOfRods(const groom::Groom& groom, const SimulationSettings& settings, const gpu::Step& step) {
    // A round section has I / A = R^2 / 4.
    const MaterialSettings& material = settings.material;
    const double radius = material.radius;
    const double substep = step.sub;
    const double bending = substep * substep * double{material.youngs_modulus} * radius * radius /
                           (4.0 * double{material.density});
    const double twisting = std::clamp(
        torsionOf(double{material.ellipticity}) * double{material.shear_modulus} /
            double{material.youngs_modulus},
        1.0 / kMostAnisotropy, kMostAnisotropy);
    const glm::dvec3 pull = substep * substep * gravityOnGroom(settings);

    RodRest rest;
    // Balancing only knows the energy of `rod`.
    if (settings.rest == RestShape::balanced && settings.solver == Solver::rod)
        rest.balance.emplace();
    rest.segments.resize(groom.points.size() * gpu::kRodSegmentRows);
    for (std::uint32_t s = 0; s < groom.strand_count; ++s) {
        Strand strand =
            restOfStrand(groom.strand(s), bending, twisting, double{material.ellipticity});
        if (rest.balance) balance(strand, s, pull, double{settings.most_stiffening}, *rest.balance);
        rest.units.push_back(static_cast<float>(strand.unit));
        for (std::size_t i = 0; i < strand.masses.size(); ++i) {
            const auto row = [&](std::size_t which) -> glm::vec4& {
                return rest.segments[(i * gpu::kRodSegmentRows + which) * groom.strand_count + s];
            };
            row(gpu::kRodHalfRotation) = toGpu(strand.half_rotations[i]);
            row(gpu::kRodStiffness) = glm::dvec4(
                glm::length(strand.rod.edges[i]), strand.masses[i],
                std::min(strand.rod.bend_stiffness[i], kMostStiffness),
                std::min(strand.rod.twist_stiffness[i], kMostStiffness));
        }
    }
    return rest;
}

static_assert(offsetof(gpu::RodParameters, accelerations) == 32);
static_assert(offsetof(gpu::RodParameters, most_strands) == 40);
static_assert(offsetof(gpu::RodParameters, stretching) == 48);
static_assert(offsetof(gpu::RodParameters, ellipticity) == 52);
static_assert(offsetof(gpu::RodParameters, damping) == 64);

// Scratch memory takes at most 1 / kScratchShare of the device-local heap. It depends on the heap's
// size, not on the free memory, so that the same case always has the same dispatches.
constexpr std::uint64_t kScratchShare = 16;

std::uint64_t scratchOfStrand(const groom::GroomSize& size, std::uint32_t rows) {
    return sizeof(glm::vec4) * rows * size.vertices_per_guide;
}

// Returns the strands per dispatch: all, or whole groups with scratch memory that fits, at least
// one.
std::uint32_t strandsInDispatch(
    const engine::DeviceInfo& device, const groom::GroomSize& size, std::uint32_t rows) {
    const std::uint64_t scratch = std::min<std::uint64_t>(
        device.limits.maxStorageBufferRange, device.local_bytes / kScratchShare);
    const std::uint64_t groups = scratch / (gpu::kRodGroupSize * scratchOfStrand(size, rows));
    const std::uint64_t most = gpu::kRodGroupSize * std::max<std::uint64_t>(groups, 1);
    return static_cast<std::uint32_t>(std::min(most, size.guides));
}

// Returns the way in which `rod` keeps segments out of bodies.
std::uint32_t segmentsOf(const SimulationSettings& settings) {
    if (settings.collision.parts == CollisionParts::vertices) return gpu::kRodNoSegments;
    return settings.rest == RestShape::balanced ? gpu::kRodSegmentsAtRest : gpu::kRodSegments;
}

}  // namespace

engine::MemoryRows RodSolver::rows(
    const engine::DeviceInfo& device, const groom::GroomSize& size, const RodMethod& method) {
    const auto vectors = [&](std::uint64_t rows) {
        return engine::bytesOf<glm::vec4>(rows * size.vertices());
    };
    engine::MemoryRows rows(
        "simulation", {{"rod segments", vectors(gpu::kRodSegmentRows)},
                       {"rod units", engine::bytesOf<float>(size.guides)},
                       {"rod motion", vectors(gpu::kRodMotionRows)},
                       {"settled state", vectors(gpu::kRodMotionRows)},
                       {"rod scratch", scratchOfStrand(size, method.scratch_rows) *
                                           strandsInDispatch(device, size, method.scratch_rows)},
                       {"rod parameters", sizeof(gpu::RodParameters)}});
    if (method.integrator != RodIntegrator::implicit_euler)
        rows.add(
            "simulation", {{"rod accelerations", vectors(gpu::kRodAccelerationRows)},
                           {"settled state", vectors(gpu::kRodAccelerationRows)}});
    return rows;
}

RodMethod rodMethod(const SimulationSettings& settings) {
    return {
        .shader = "simulation/rod.comp",
        .scratch_rows = gpu::kRodScratchRows +
                        (settings.collision.warm_start ? gpu::kRodContactScratchRows : 0) +
                        (segmentsOf(settings) == gpu::kRodNoSegments ? 0 : 1),
        .iterations = settings.rod.iterations,
        .integrator = settings.rod.integrator,
        .damping = settings.material.damping};
}

RodMethod stableCosseratMethod(const SimulationSettings& settings) {
    return {
        .shader = "simulation/stable_cosserat.comp",
        .scratch_rows = gpu::kStableCosseratScratchRows,
        .iterations = settings.stable_cosserat.iterations,
        .stretching =
            double{settings.stable_cosserat.stretch_modulus} / double{settings.material.density}};
}

RodMethod positionBasedMethod(const SimulationSettings& settings) {
    return {
        .shader = "simulation/position_based_rod.comp",
        .scratch_rows = gpu::kPositionBasedScratchRows,
        .iterations = settings.position_based_rod.iterations,
        .stretching = double{settings.material.youngs_modulus} / double{settings.material.density}};
}

RodMethod augmentedMassSpringMethod(const SimulationSettings& settings) {
    const AugmentedMassSpringSettings& springs = settings.augmented_mass_spring;
    return {
        .shader = "simulation/augmented_mass_spring.comp",
        .scratch_rows = gpu::kMassSpringScratchRows,
        .iterations = springs.iterations,
        .stretching = double{springs.spring_modulus} / double{settings.material.density},
        .integrity = springs.integrity,
        .angular = springs.angular_stiffness};
}

RodSolver::RodSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step, const RodMethod& method)
    : RodSolver(device, groom, settings, step, method, restOfRods(groom, settings, step)) {}

RodSolver::RodSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step, const RodMethod& method, const RodRest& rest)
    : balance_(rest.balance), stretches_(method.stretching > 0.0),
      strand_count_(groom.strand_count),
      most_strands_(strandsInDispatch(device.info(), sizeOf(groom), method.scratch_rows)),
      step_(
          device,
          {.shader = std::string(method.shader) +
                     (device.has(engine::Feature::long_integers) ? "+packed" : ""),
           .constants =
               {{gpu::kContinuousCollisionConstant, settings.collision.continuous},
                {gpu::kEllipticSectionConstant, settings.material.ellipticity != 1.0f},
                {gpu::kWarmStartConstant, settings.collision.warm_start},
                {gpu::kRodSegmentsConstant, segmentsOf(settings)},
                {gpu::kRodAlphaConstant, method.integrator != RodIntegrator::implicit_euler},
                {gpu::kRodDampedConstant, method.damping > 0.0},
                {gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)}},
           .push_size = sizeof(gpu::SubstepPush)}),
      adopt_(
          device, {.shader = "simulation/rod_adopt.comp",
                   .constants = {{gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)}},
                   .push_size = sizeof(gpu::SubstepPush)}) {
    const engine::MemoryRows rows = RodSolver::rows(device.info(), sizeOf(groom), method);
    segments_ = engine::makeBuffer(device, rest.segments, rows, "rod segments");
    units_ = engine::makeBuffer(device, rest.units, rows, "rod units");
    motion_ = {device, rows["rod motion"]};
    if (method.integrator != RodIntegrator::implicit_euler)
        accelerations_.emplace(device, rows["rod accelerations"]);
    scratch_ = {device, rows["rod scratch"]};
    parameters_ = engine::makeBuffer(
        device,
        std::array{gpu::RodParameters{
            .segments = segments_.address(),
            .units = units_.address(),
            .motion = motion_.address(),
            .scratch = scratch_.address(),
            .accelerations = accelerations_ ? accelerations_->address() : 0,
            .most_strands = most_strands_,
            .iterations = method.iterations,
            .stretching = static_cast<float>(method.stretching * step.sub * step.sub),
            .ellipticity = settings.material.ellipticity,
            .integrity = static_cast<float>(method.integrity * step.sub * step.sub),
            .angular = static_cast<float>(method.angular * step.sub * step.sub),
            .damping = static_cast<float>(method.damping / step.sub)}},
        rows, "rod parameters");
}

void RodSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    for (std::uint32_t first = 0; first < strand_count_; first += most_strands_) {
        push.first_strand = first;
        commands.bind(step_, push);
        if (first > 0) commands.usesAgain();
        commands.uses({{motion_, Access::compute_write}, {scratch_, Access::compute_write}});
        if (accelerations_) commands.uses({{*accelerations_, Access::compute_write}});
        commands.dispatchInvocations(
            std::min(most_strands_, strand_count_ - first), gpu::kRodGroupSize);
    }
}

std::vector<const engine::Buffer*> RodSolver::state() const {
    std::vector<const engine::Buffer*> state{&motion_};
    if (accelerations_) state.push_back(&*accelerations_);
    return state;
}

// Rods that stretch have another energy.
ElasticRods RodSolver::elasticRods() const {
    if (stretches_) return {};
    return {.parameters = parameters_.address(), .motion = motion_.address()};
}

void RodSolver::recordAdopt(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    commands.bind(adopt_, push);
    commands.uses({{motion_, Access::compute_write}});
    if (accelerations_) commands.uses({{*accelerations_, Access::compute_write}});
    commands.dispatchInvocations(strand_count_, gpu::kRodGroupSize);
}

}  // namespace hair::simulation
