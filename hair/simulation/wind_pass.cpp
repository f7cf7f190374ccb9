#include "hair/simulation/wind_pass.h"

#include <cstddef>

#include <glm/common.hpp>

#include "hair/gpu_structs.h"
#include "hair/simulation/dispatch_groups.h"
#include "hair/simulation/wind.h"

namespace hair {

namespace {

static_assert(sizeof(gpu::WindPush) == 72 && offsetof(gpu::WindPush, directions) == 16);
static_assert(sizeof(gpu::DragPush) == 72 && offsetof(gpu::DragPush, cell) == 32);

engine::ComputeDescription pipelineOf(WindMode mode) {
    if (mode == WindMode::drag)
        return {.shader = "simulation/wind_drag.comp", .push_size = sizeof(gpu::DragPush)};
    return {.shader = "simulation/wind.comp", .push_size = sizeof(gpu::WindPush)};
}

// What multiplies the wind's direction.
float strengthOf(const WindSettings& settings) {
    return settings.mode == WindMode::drag ? settings.speed : settings.strength;
}

// Modulo 2^32, as a lattice counts its cells.
gpu::uvec3 cellOf(const glm::dvec3& whole) {
    const auto wrapped = [](double count) {
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(count));
    };
    return {wrapped(whole.x), wrapped(whole.y), wrapped(whole.z)};
}

}  // namespace

void checkWind(const WindSettings& settings) {
    if (strengthOf(settings) > 0.0f) windDirection(settings);
}

WindPass::WindPass(
    const engine::Device& device, std::uint32_t vertex_count, const SimulationSettings& settings)
    : settings_(settings.wind), material_(settings.material), vertex_count_(vertex_count),
      pipeline_(device, pipelineOf(settings.wind.mode)) {
    checkWind(settings_);
}

void WindPass::record(
    engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations,
    double time) const {
    if (settings_.mode == WindMode::drag)
        recordDrag(commands, guides, accelerations, settings_.speed, time);
    else
        recordThesis(commands, guides, accelerations, windMagnitude(settings_, time));
}

void WindPass::recordCalm(
    engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations) const {
    if (settings_.mode == WindMode::drag)
        recordDrag(commands, guides, accelerations, 0.0, 0.0);
    else
        recordThesis(commands, guides, accelerations, 0.0);
}

void WindPass::recordThesis(
    engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations,
    double magnitude) const {
    gpu::WindPush push{
        .guides = guides,
        .accelerations = accelerations,
        .directions = {},
        .magnitude = static_cast<float>(magnitude)};
    if (settings_.strength > 0.0f) {
        const auto cone = windCone(settings_);
        for (std::size_t i = 0; i < cone.size(); ++i)
            push.directions[i] = glm::vec3(double{settings_.strength} * cone[i]);
    }
    commands.bind(pipeline_, push);
    dispatchInvocations(commands, vertex_count_, gpu::kGuideGroupSize);
}

// The mean wind has carried the lattice from its start at the world's origin by speed times time:
// far, so the distance is divided into cells in double.
void WindPass::recordDrag(
    engine::Commands& commands, std::uint64_t guides, std::uint64_t accelerations, double speed,
    double time) const {
    const glm::dvec3 wind = speed > 0.0 ? speed * windDirection(settings_) : glm::dvec3(0.0);
    const double cell = settings_.turbulence_scale;
    const glm::dvec3 origin = -time / cell * wind;
    const glm::dvec3 whole = glm::floor(origin);
    const DragFactors factors = dragFactors(settings_, material_);
    commands.bind(
        pipeline_, gpu::DragPush{
                       .guides = guides,
                       .accelerations = accelerations,
                       .mean_wind = wind,
                       .fluctuation = static_cast<float>(double{settings_.turbulence} * speed),
                       .cell = cellOf(whole),
                       .fraction = origin - whole,
                       .cells_per_metre = static_cast<float>(1.0 / cell),
                       .octaves = settings_.turbulence_octaves,
                       .inertial_drag = static_cast<float>(factors.inertial),
                       .viscous_drag = static_cast<float>(factors.viscous)});
    dispatchInvocations(commands, vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair
