#include "hair/simulation/solvers.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "engine/buffer_image.h"
#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/extension.h"
#include "hair/simulation/solver_rod.h"
#include "hair/simulation/solver_shape.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {

// ---- Follow the leader --------------------------------------------------------------------------

FtlSolver::FtlSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step)
    : strand_count_(groom.strand_count),
      parameters_(engine::makeBuffer(
          device,
          std::array{gpu::FtlParameters{
              .global_stiffness = static_cast<float>(globalStiffness(settings, step)),
              .velocity_correction = settings.ftl.velocity_correction}},
          rows(device.info(), sizeOf(groom), settings), "ftl parameters")),
      pipeline_(
          device, {.shader = "simulation/ftl.comp",
                   .constants =
                       {{gpu::kContinuousCollisionConstant, settings.collision.continuous},
                        {gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)}},
                   .push_size = sizeof(gpu::SubstepPush)}) {}

void FtlSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    commands.bind(pipeline_, push);
    commands.dispatchInvocations(strand_count_, gpu::kGuideGroupSize);
}

// ---- A solver from the scene --------------------------------------------------------------------

static_assert(sizeof(gpu::ExtendedParameters) == 40);
static_assert(offsetof(gpu::ExtendedParameters, density) == 16);

namespace {

engine::ComputeDescription extendedStage(const SimulationSettings& settings) {
    if (!settings.solver_parameters.file)
        throw engine::Error("/simulation/solver", "names a file that was not read");
    engine::Constants constants = extensionConstants(settings.solver_parameters);
    constants.push_back({gpu::kContinuousCollisionConstant, settings.collision.continuous});
    constants.push_back({gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)});
    return {
        .shader = "simulation/extended.comp",
        .constants = std::move(constants),
        .extensions = shaderExtensions(settings.solver_parameters),
        .push_size = sizeof(gpu::SubstepPush)};
}

}  // namespace

engine::MemoryRows ExtendedSolver::rows(
    const engine::DeviceInfo&, const groom::GroomSize& size, const SimulationSettings&) {
    const std::size_t vectors = engine::bytesOf<glm::vec4>(size.vertices());
    return {
        "simulation",
        {{"extended earlier positions", vectors},
         {"extended memory", gpu::kExtendedMemory * vectors},
         {"extended parameters", sizeof(gpu::ExtendedParameters)},
         {"settled state", gpu::kExtendedMemory * vectors}}};
}

ExtendedSolver::ExtendedSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step&)
    : strand_count_(groom.strand_count), pipeline_(device, extendedStage(settings)) {
    const engine::MemoryRows all = rows(device.info(), sizeOf(groom), settings);
    earlier_ = {device, all["extended earlier positions"]};
    memory_ = {device, all["extended memory"]};
    const MaterialSettings& material = settings.material;
    parameters_ = engine::makeBuffer(
        device,
        std::array{gpu::ExtendedParameters{
            .earlier = earlier_.address(),
            .memory = memory_.address(),
            .density = static_cast<float>(wetDensity(material)),
            .radius = material.radius,
            .ellipticity = material.ellipticity,
            .youngs_modulus = material.youngs_modulus,
            .shear_modulus = material.shear_modulus,
            .damping = material.damping}},
        all, "extended parameters");
}

void ExtendedSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    commands.bind(pipeline_, push);
    commands.uses(
        {{earlier_, engine::Access::compute_write}, {memory_, engine::Access::compute_write}});
    commands.dispatchInvocations(strand_count_, gpu::kGuideGroupSize);
}

// ---- The list of solvers ------------------------------------------------------------------------

namespace {

// Hair frozen on a moving or deforming head, or where a cache has it: solver `none` with keyframes,
// an animation or a cache.
class RestSolver : public GuideSolver {
public:
    RestSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings)
        : vertex_count_(groom.strand_count * groom.vertices_per_strand),
          pipeline_(
              device, {.shader = "simulation/rest.comp",
                       .constants = {{gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)}},
                       .push_size = sizeof(gpu::SubstepPush)}) {}

    void record(engine::Commands& commands, gpu::SubstepPush push) const override {
        commands.bind(pipeline_, push);
        commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
    }

private:
    std::uint32_t vertex_count_;
    engine::ComputePipeline pipeline_;
};

static_assert(sizeof(gpu::Step) == 12 && offsetof(gpu::Step, sub) == 4);
static_assert(offsetof(gpu::Step, count) == 8);

struct Row {
    Solver solver;
    double longest_substep;  // by the solver's own choice, s
    std::unique_ptr<GuideSolver> (*make)(
        const engine::Device&, const groom::Groom&, const SimulationSettings&, const gpu::Step&);
    engine::MemoryRows (*rows)(
        const engine::DeviceInfo&, const groom::GroomSize&, const SimulationSettings&);
};

template <RodMethod (*kMethod)(const SimulationSettings&)>
engine::MemoryRows rodRows(
    const engine::DeviceInfo& device, const groom::GroomSize& size,
    const SimulationSettings& settings) {
    return RodSolver::rows(device, size, kMethod(settings));
}

template <class Made>
std::unique_ptr<GuideSolver> make(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step) {
    return std::make_unique<Made>(device, groom, settings, step);
}

std::unique_ptr<GuideSolver> makeNone(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step&) {
    if (settings.motion.keyframes.empty() && !hasSkinnedRoots(settings) &&
        groom.cache.times.empty())
        return nullptr;
    return std::make_unique<RestSolver>(device, groom, settings);
}

template <RodMethod (*kMethod)(const SimulationSettings&)>
std::unique_ptr<GuideSolver> makeRods(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step) {
    return std::make_unique<RodSolver>(device, groom, settings, step, kMethod(settings));
}

constexpr double kWholeStep = std::numeric_limits<double>::infinity();  // of any length

constexpr Row kSolvers[] = {
    {Solver::none, kWholeStep, makeNone, GuideSolver::rows},
    {Solver::shape, kWholeStep, make<ShapeSolver>, ShapeSolver::rows},
    {Solver::ftl, kWholeStep, make<FtlSolver>, FtlSolver::rows},
    {Solver::rod, 1.0 / 480.0, makeRods<rodMethod>, rodRows<rodMethod>},
    {Solver::stable_cosserat, 1.0 / 960.0, makeRods<stableCosseratMethod>,
     rodRows<stableCosseratMethod>},
    {Solver::position_based_rod, 1.0 / 1920.0, makeRods<positionBasedMethod>,
     rodRows<positionBasedMethod>},
    {Solver::augmented_mass_spring, 1.0 / 480.0, makeRods<augmentedMassSpringMethod>,
     rodRows<augmentedMassSpringMethod>},
    {Solver::extension, kWholeStep, make<ExtendedSolver>, ExtendedSolver::rows},
};

const Row& rowOf(Solver solver) {
    const Row* row = std::ranges::find(kSolvers, solver, &Row::solver);
    assert(row != std::end(kSolvers));
    return *row;
}

std::uint32_t substepsOf(const SimulationSettings& settings) {
    if (settings.substeps > 0) return settings.substeps;
    double longest = rowOf(settings.solver).longest_substep;
    if (const float own = extensionNumber(settings.solver_parameters, kLongestSubstep); own > 0.0f)
        longest = own;
    const double substeps = double{settings.time_step} / longest;
    // Time steps are rounded to floats: 8.0000001 counts as 8.
    return static_cast<std::uint32_t>(std::max(1.0, std::ceil(substeps - 1e-4)));
}

}  // namespace

std::unique_ptr<GuideSolver> makeSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step) {
    return rowOf(settings.solver).make(device, groom, settings, step);
}

engine::MemoryRows solverRows(
    const engine::DeviceInfo& device, const groom::GroomSize& size,
    const SimulationSettings& settings) {
    return rowOf(settings.solver).rows(device, size, settings);
}

gpu::Step stepOf(const SimulationSettings& settings) {
    const std::uint32_t count = substepsOf(settings);
    return {
        .whole = settings.time_step,
        .sub = static_cast<float>(double{settings.time_step} / static_cast<double>(count)),
        .count = count};
}

}  // namespace hair::simulation
