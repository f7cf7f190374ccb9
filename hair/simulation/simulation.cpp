#include "hair/simulation/simulation.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <string>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/simulation/rest_shape.h"
#include "hair/simulation/stiffness.h"
#include "hair/simulation/wind.h"

namespace hair {

namespace {

using engine::Access;
using engine::Buffer;
using engine::Commands;
using engine::Device;

static_assert(sizeof(gpu::Capsule) == 28 && offsetof(gpu::Capsule, b) == 16);
static_assert(sizeof(gpu::WindParameters) == 80);
static_assert(offsetof(gpu::WindParameters, directions) == 16);
static_assert(offsetof(gpu::WindParameters, magnitude) == 64);
static_assert(sizeof(gpu::SimulateParameters) == 104);
static_assert(offsetof(gpu::SimulateParameters, gravity) == 56);
static_assert(offsetof(gpu::SimulateParameters, local_iterations) == 80);

constexpr std::uint32_t kWindGroup = 64;           // invocations, as in wind.comp
constexpr std::uint32_t kSolverGroup = 64;         // invocations to fill with whole strands
constexpr std::uint32_t kMostGroupsInRow = 65535;  // what every device has
constexpr std::uint32_t kSettleBatch = 64;         // steps per submission

// Where more groups are needed than fit in a row, the shaders count them row by row.
void dispatch(Commands& commands, std::uint32_t groups) {
    const std::uint32_t columns = std::min(groups, kMostGroupsInRow);
    commands.dispatch(columns, (groups + columns - 1) / columns);
}

// w: inverse mass.
std::vector<glm::vec4>
withMasses(std::span<const glm::vec3> positions, std::uint32_t vertices_per_strand) {
    std::vector<glm::vec4> result;
    result.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        result.emplace_back(positions[i], i % vertices_per_strand == 0 ? 0.0f : 1.0f);
    return result;
}

template <class Value>
Buffer makeBuffer(const Device& device, const std::vector<Value>& values, const char* name) {
    return engine::makeBuffer(device, std::span<const Value>(values), name);
}

std::vector<float> localStiffnesses(const Groom& groom, const SimulationSettings& settings) {
    std::vector<float> factors;
    for (const double length : meanSegmentLengths(groom))
        factors.push_back(static_cast<float>(localStiffness(settings, length)));
    return factors;
}

std::vector<gpu::Capsule> capsulesOf(const SimulationSettings& settings) {
    std::vector<gpu::Capsule> capsules;
    for (const Collider& collider : settings.colliders)
        capsules.push_back({.a = collider.a, .radius = collider.radius, .b = collider.b});
    return capsules;
}

std::uint32_t strandsPerGroup(const Device& device, const Groom& groom) {
    assert(groom.strand_count > 0 && groom.vertices_per_strand > 1);
    const std::uint32_t most = device.info().limits.maxComputeWorkGroupInvocations;
    if (groom.vertices_per_strand > most)
        throw engine::Unsupported(
            "simulation", std::to_string(groom.vertices_per_strand) +
                              " vertices per strand; this device runs at most " +
                              std::to_string(most));
    return std::max(1u, kSolverGroup / groom.vertices_per_strand);
}

}  // namespace

Simulation::Simulation(
    const Device& device, const Groom& groom, const SimulationSettings& settings,
    std::uint32_t seed)
    : device_(&device), settings_(settings), seed_(seed), strand_count_(groom.strand_count),
      vertices_per_strand_(groom.vertices_per_strand),
      strands_per_group_(strandsPerGroup(device, groom)), wind_cone_(windCone(settings.wind)),
      rest_positions_(makeBuffer(
          device, withMasses(groom.points, groom.vertices_per_strand), "guide rest positions")),
      rest_edges_(makeBuffer(device, transportedRestEdges(groom), "guide rest edges")),
      local_stiffness_(
          makeBuffer(device, localStiffnesses(groom, settings), "guide local stiffness")),
      capsules_(makeBuffer(device, capsulesOf(settings), "capsules")),
      positions_(device, {.size = rest_positions_.size(), .name = "guide positions"}),
      previous_(device, {.size = rest_positions_.size(), .name = "guide previous positions"}),
      settled_positions_(
          device, {.size = rest_positions_.size(), .name = "guide settled positions"}),
      settled_previous_(
          device, {.size = rest_positions_.size(), .name = "guide settled previous positions"}),
      accelerations_(device, {.size = rest_positions_.size(), .name = "guide accelerations"}),
      wind_(device, {.shader = "simulation/wind.comp", .push_size = sizeof(gpu::WindParameters)}),
      simulate_(
          device, {.shader = "simulation/simulate.comp",
                   .constants = {strands_per_group_ * vertices_per_strand_, vertices_per_strand_},
                   .push_size = sizeof(gpu::SimulateParameters)}) {
    assert(groom.points.size() == std::size_t{strand_count_} * vertices_per_strand_);
    restore(rest_positions_, rest_positions_);
    settle(settings.settle_steps);
    keepSettled();
}

void Simulation::recordWind(Commands& commands) const {
    if (settings_.solver == Solver::none) return;
    gpu::WindParameters params{
        .positions = positions_.address(),
        .accelerations = accelerations_.address(),
        .directions = {},
        .magnitude = static_cast<float>(windMagnitude(settings_.wind, time())),
        .seed = seed_,
        .strand_count = strand_count_,
        .vertices_per_strand = vertices_per_strand_};
    for (std::size_t i = 0; i < wind_cone_.size(); ++i)
        params.directions[i] = glm::vec3(double{settings_.wind.strength} * wind_cone_[i]);

    commands.barrier(Access::compute_write, Access::compute_write);
    commands.bind(wind_, params);
    dispatch(commands, (strand_count_ * vertices_per_strand_ + kWindGroup - 1) / kWindGroup);
}

void Simulation::recordStep(Commands& commands) {
    if (settings_.solver == Solver::none) return;
    recordSolver(commands, accelerations_.address());
    ++steps_;
}

void Simulation::settle(std::uint32_t steps) {
    if (settings_.solver == Solver::none) return;
    while (steps > 0) {
        const std::uint32_t batch = std::min(steps, kSettleBatch);
        device_->runOnce([&](Commands& commands) {
            for (std::uint32_t i = 0; i < batch; ++i) recordSolver(commands, 0);
        });
        steps -= batch;
    }
}

void Simulation::reset() {
    steps_ = 0;
    restore(settled_positions_, settled_previous_);
}

void Simulation::setState(
    std::span<const glm::vec3> positions, std::span<const glm::vec3> previous) {
    assert(positions.size() == previous.size());
    assert(positions.size() == std::size_t{strand_count_} * vertices_per_strand_);
    const auto now = withMasses(positions, vertices_per_strand_);
    const auto before = withMasses(previous, vertices_per_strand_);
    engine::upload(*device_, std::as_bytes(std::span(now)), positions_);
    engine::upload(*device_, std::as_bytes(std::span(before)), previous_);
}

std::vector<glm::vec3> Simulation::readPositions() const {
    const auto points = engine::downloadAs<glm::vec4>(*device_, positions_);
    return {points.begin(), points.end()};
}

GuideView Simulation::guides() const {
    return {
        .positions = positions_.address(),
        .strand_count = strand_count_,
        .vertices_per_strand = vertices_per_strand_};
}

void Simulation::recordSolver(Commands& commands, std::uint64_t accelerations) const {
    const gpu::SimulateParameters params{
        .positions = positions_.address(),
        .previous = previous_.address(),
        .rest_positions = rest_positions_.address(),
        .rest_edges = rest_edges_.address(),
        .local_stiffness = local_stiffness_.address(),
        .accelerations = accelerations,
        .capsules = capsules_.address(),
        .gravity = settings_.gravity,
        .time_step_squared =
            static_cast<float>(double{settings_.time_step} * double{settings_.time_step}),
        .velocity_kept = static_cast<float>(velocityKept(settings_)),
        .global_stiffness = static_cast<float>(globalStiffness(settings_)),
        .local_iterations = settings_.local.iterations,
        .length_iterations = settings_.length.iterations,
        .capsule_count = static_cast<std::uint32_t>(settings_.colliders.size()),
        .strand_count = strand_count_,
        .collision_margin = settings_.collision.margin,
        .friction = settings_.collision.friction};

    // After the wind, an earlier step, and whoever still draws the positions that are overwritten.
    commands.barrier(Access::anything, Access::compute_write);
    commands.bind(simulate_, params);
    dispatch(commands, (strand_count_ + strands_per_group_ - 1) / strands_per_group_);
    commands.barrier(Access::compute_write, Access::graphics_read);
}

void Simulation::restore(const engine::Buffer& positions, const engine::Buffer& previous) {
    device_->runOnce([&](Commands& commands) {
        commands.barrier(Access::anything, Access::transfer_write);
        commands.copy(positions, positions_, positions_.size());
        commands.copy(previous, previous_, previous_.size());
        commands.fill(accelerations_, 0);
        commands.barrier(Access::transfer_write, Access::anything);
    });
}

void Simulation::keepSettled() {
    device_->runOnce([&](Commands& commands) {
        commands.barrier(Access::anything, Access::transfer_write);
        commands.copy(positions_, settled_positions_, positions_.size());
        commands.copy(previous_, settled_previous_, previous_.size());
        commands.barrier(Access::transfer_write, Access::anything);
    });
}

}  // namespace hair
