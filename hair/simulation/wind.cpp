#include "hair/simulation/wind.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {
namespace {

using engine::Access;

static_assert(sizeof(gpu::WindPush) == 68 && offsetof(gpu::WindPush, directions) == 16);
static_assert(sizeof(gpu::AirPush) == 72 && offsetof(gpu::AirPush, cell) == 40);

engine::ComputeDescription pipelineOf(WindMode mode) {
    if (mode == WindMode::drag)
        return {.shader = "simulation/air.comp", .push_size = sizeof(gpu::AirPush)};
    return {.shader = "simulation/wind.comp", .push_size = sizeof(gpu::WindPush)};
}

// Returns the factor on the wind's direction.
float strengthOf(const WindSettings& settings) {
    return settings.mode == WindMode::drag ? settings.speed : settings.strength;
}

// Returns the cell modulo 2^32, as the lattice counts its cells.
gpu::uvec3 cellOf(const glm::dvec3& whole) {
    const auto wrapped = [](double count) {
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(count));
    };
    return {wrapped(whole.x), wrapped(whole.y), wrapped(whole.z)};
}

}  // namespace

// ---- Wind from the settings ---------------------------------------------------------------------

glm::dvec3 windDirection(const WindSettings& settings) {
    const glm::dvec3 direction = settings.direction;
    if (glm::length(direction) < 1e-6) throw engine::Error("/simulation/wind/direction", "is zero");
    return glm::normalize(direction);
}

std::array<glm::dvec3, 4> windCone(const WindSettings& settings) {
    const glm::dvec3 direction = windDirection(settings);
    const glm::dvec3 u = perpendicular(direction);
    const glm::dvec3 v = glm::cross(direction, u);

    const double angle = glm::radians(double{settings.cone_angle});
    const glm::dvec3 along = std::cos(angle) * direction;
    const double aside = std::sin(angle);
    return {along + aside * u, along + aside * v, along - aside * u, along - aside * v};
}

double windMagnitude(const WindSettings& settings, double time) {
    const double wave = std::sin(double{settings.gust_rate} * time);
    return wave * wave + 0.5;
}

// The density multiplies the power and divides nothing: it may be 0.
DragFactors dragFactors(const WindSettings& settings, const MaterialSettings& material) {
    const double line = std::numbers::pi * double{material.radius} * double{material.density};
    const double layer = double{settings.air_viscosity} / (2.0 * double{material.radius});
    return {
        .inertial = double{settings.air_density} / line,
        .viscous = 10.0 * std::cbrt(double{settings.air_density} * layer * layer) / line};
}

// ---- The pass -----------------------------------------------------------------------------------

void checkWind(const WindSettings& settings) {
    if (strengthOf(settings) > 0.0f) windDirection(settings);
}

WindPass::WindPass(
    const engine::Device& device, std::uint32_t vertex_count, const SimulationSettings& settings)
    : settings_(settings.wind), material_(settings.material), vertex_count_(vertex_count),
      pipeline_(device, pipelineOf(settings.wind.mode)) {
    checkWind(settings_);
    if (settings_.mode == WindMode::drag)
        air_.emplace(engine::makeBuffer(
            device, std::span<const glm::vec4>(std::vector<glm::vec4>(vertex_count)), "guide air"));
}

AirAtGuides WindPass::air() const {
    if (!air_) return {};
    const DragFactors factors = dragFactors(settings_, material_);
    return {
        .velocities = &*air_,
        .drag = {
            .inertial = static_cast<float>(factors.inertial),
            .viscous = static_cast<float>(factors.viscous)}};
}

void WindPass::record(engine::Commands& commands, const GuideAddresses& guides, double time) const {
    if (settings_.mode == WindMode::drag)
        recordAir(commands, guides, settings_.speed, time);
    else
        recordThesis(commands, guides, windMagnitude(settings_, time));
}

void WindPass::recordCalm(engine::Commands& commands, const GuideAddresses& guides) const {
    if (settings_.mode == WindMode::drag)
        recordAir(commands, guides, 0.0, 0.0);
    else
        recordThesis(commands, guides, 0.0);
}

void WindPass::recordThesis(
    engine::Commands& commands, const GuideAddresses& guides, double magnitude) const {
    gpu::WindPush push{
        .guides = guides.parameters,
        .accelerations = guides.accelerations,
        .directions = {},
        .magnitude = static_cast<float>(magnitude)};
    if (settings_.strength > 0.0f) {
        const auto cone = windCone(settings_);
        for (std::size_t i = 0; i < cone.size(); ++i)
            push.directions[i] = glm::vec3(double{settings_.strength} * cone[i]);
    }
    commands.bind(pipeline_, push);
    commands.uses(
        {{guides.positions, Access::compute_read}, {guides.accelerations, Access::compute_write}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

// The mean wind has carried the lattice from the world's origin by speed times time. This can be
// far, so the distance is divided into cells in double precision.
void WindPass::recordAir(
    engine::Commands& commands, const GuideAddresses& guides, double speed, double time) const {
    const glm::dvec3 wind = speed > 0.0 ? speed * windDirection(settings_) : glm::dvec3(0.0);
    const double cell = settings_.turbulence_scale;
    const glm::dvec3 origin = -time / cell * wind;
    const glm::dvec3 whole = glm::floor(origin);
    commands.bind(
        pipeline_, gpu::AirPush{
                       .guides = guides.parameters,
                       .accelerations = guides.accelerations,
                       .air = air_->address(),
                       .mean_wind = wind,
                       .fluctuation = static_cast<float>(double{settings_.turbulence} * speed),
                       .cell = cellOf(whole),
                       .fraction = origin - whole,
                       .cells_per_metre = static_cast<float>(1.0 / cell),
                       .octaves = settings_.turbulence_octaves});
    commands.uses(
        {{guides.positions, Access::compute_read},
         {*air_, Access::compute_write},
         {guides.accelerations, Access::compute_write}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
