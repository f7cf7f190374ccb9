#include "hair/simulation/forces.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/extension.h"
#include "hair/simulation/solvers.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {

// ---- Wind ---------------------------------------------------------------------------------------

namespace {

using engine::Access;

static_assert(sizeof(gpu::WindPush) == 68 && offsetof(gpu::WindPush, directions) == 16);
static_assert(sizeof(gpu::AirPush) == 76 && offsetof(gpu::AirPush, cell) == 40);

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
    const double line = std::numbers::pi * double{material.radius} * wetDensity(material);
    const double layer = double{settings.air_viscosity} / (2.0 * double{material.radius});
    return {
        .inertial = double{settings.air_density} / line,
        .viscous = 10.0 * std::cbrt(double{settings.air_density} * layer * layer) / line,
        .along = double{settings.drag_along} * double{settings.air_viscosity} /
                 (double{material.radius} * line)};
}

// ---- The pass -----------------------------------------------------------------------------------

void checkWind(const WindSettings& settings) {
    if (strengthOf(settings) > 0.0f) windDirection(settings);
}

engine::MemoryRows WindPass::rows(std::uint64_t vertices, WindMode mode) {
    if (mode != WindMode::drag) return {};
    return {"simulation", {{"guide air", engine::bytesOf<glm::vec4>(vertices)}}};
}

WindPass::WindPass(
    const engine::Device& device, std::uint32_t vertex_count, const SimulationSettings& settings)
    : settings_(settings.wind), material_(settings.material), step_(double{stepOf(settings).whole}),
      vertex_count_(vertex_count), pipeline_(device, pipelineOf(settings.wind.mode)) {
    checkWind(settings_);
    if (settings_.mode == WindMode::drag)
        air_.emplace(engine::makeBuffer(
            device, std::vector<glm::vec4>(vertex_count), rows(vertex_count, settings_.mode),
            "guide air"));
}

AirAtGuides WindPass::air() const {
    if (!air_) return {};
    const DragFactors factors = dragFactors(settings_, material_);
    return {
        .velocities = &*air_,
        .drag =
            {.inertial = static_cast<float>(factors.inertial),
             .viscous = static_cast<float>(factors.viscous)},
        .along = static_cast<float>(std::min(factors.along, 1.0 / step_))};
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
        .accelerations = commands.writes(guides.accelerations),
        .directions = {},
        .magnitude = static_cast<float>(magnitude)};
    if (settings_.strength > 0.0f) {
        const auto cone = windCone(settings_);
        for (std::size_t i = 0; i < cone.size(); ++i)
            push.directions[i] = glm::vec3(double{settings_.strength} * cone[i]);
    }
    commands.bind(pipeline_, push);
    commands.uses({{guides.positions, Access::compute_read}});
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
                       .accelerations = commands.writes(guides.accelerations),
                       .air = commands.writes(*air_),
                       .mean_wind = wind,
                       .fluctuation = static_cast<float>(double{settings_.turbulence} * speed),
                       .cell = cellOf(whole),
                       .fraction = origin - whole,
                       .cells_per_metre = static_cast<float>(1.0 / cell),
                       .octaves = settings_.turbulence_octaves,
                       .drag_along = air().along});
    commands.uses({{guides.positions, Access::compute_read}});
    if (settings_.drag_along > 0.0f) commands.uses({{guides.previous, Access::compute_read}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

// ---- The scene's own force ----------------------------------------------------------------------

namespace {

static_assert(sizeof(gpu::ForcePush) == 20 && offsetof(gpu::ForcePush, time) == 16);

engine::ComputeDescription forceStage(const SimulationSettings& settings) {
    if (!settings.force_parameters.file)
        throw engine::Error("/simulation/force", "names a file that was not read");
    return {
        .shader = "simulation/force.comp",
        .constants = extensionConstants(settings.force_parameters),
        .extensions = shaderExtensions(settings.force_parameters),
        .push_size = sizeof(gpu::ForcePush)};
}

}  // namespace

ForcePass::ForcePass(
    const engine::Device& device, std::uint32_t vertex_count, const SimulationSettings& settings)
    : vertex_count_(vertex_count), pipeline_(device, forceStage(settings)) {}

void ForcePass::record(
    engine::Commands& commands, const GuideAddresses& guides, double time) const {
    using engine::Access;
    commands.bind(
        pipeline_, gpu::ForcePush{
                       .guides = guides.parameters,
                       .accelerations = commands.writes(guides.accelerations),
                       .time = static_cast<float>(time)});
    commands.uses(
        {{guides.positions, Access::compute_read}, {guides.previous, Access::compute_read}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

// ---- Hands --------------------------------------------------------------------------------------

namespace {

using engine::Access;

glm::dvec3 positionAt(const std::vector<PullKey>& path, double time) {
    const auto after = std::ranges::upper_bound(
        path, time, {}, [](const PullKey& key) { return double{key.time}; });
    if (after == path.begin()) return path.front().position;
    if (after == path.end()) return path.back().position;
    const PullKey& a = *(after - 1);
    const double part = (time - double{a.time}) / (double{after->time} - double{a.time});
    return glm::mix(glm::dvec3(a.position), glm::dvec3(after->position), part);
}

void checkVertex(
    const std::string& pull, const char* member, std::uint32_t number, std::uint32_t count,
    const char* things) {
    if (number >= count)
        throw engine::Error(
            pull + "/" + member, std::to_string(number) + " is too large: the groom has " +
                                     std::to_string(count) + " " + things);
}

static_assert(sizeof(gpu::PullPush) == 68 && offsetof(gpu::PullPush, held_vertex) == 48);

engine::ComputePipeline pullPipeline(const engine::Device& device, const char* shader) {
    return {device, {.shader = shader, .push_size = sizeof(gpu::PullPush)}};
}

}  // namespace

// ---- Hands --------------------------------------------------------------------------------------

std::optional<Hand> handIn(const PullSettings& pull, double from, double to) {
    const double middle = 0.5 * (from + to);
    if (pull.path.empty() || middle < pull.path.front().time || middle > pull.path.back().time)
        return {};
    const glm::dvec3 end = positionAt(pull.path, to);
    return Hand{.position = end, .velocity = (end - positionAt(pull.path, from)) / (to - from)};
}

void checkPulls(
    std::span<const PullSettings> pulls, std::uint32_t guides, std::uint32_t vertices_per_guide) {
    for (std::size_t i = 0; i < pulls.size(); ++i) {
        const std::string name = "/simulation/pulls/" + std::to_string(i);
        checkVertex(name, "guide", pulls[i].guide, guides, "guides");
        checkVertex(name, "vertex", pulls[i].vertex, vertices_per_guide, "vertices per guide");
        const auto& path = pulls[i].path;
        const auto late =
            std::ranges::adjacent_find(path, std::ranges::greater_equal{}, &PullKey::time);
        if (late != path.end())
            throw engine::Error(
                name + "/path/" + std::to_string(late - path.begin() + 1) + "/time",
                "is not after the previous key");
    }
}

// ---- The pass -----------------------------------------------------------------------------------

PullPass::PullPass(
    const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
    const gpu::Step& step, std::vector<PullSettings> pulls)
    : vertex_count_(strand_count * vertices_per_strand), vertices_per_strand_(vertices_per_strand),
      step_(step), pulls_(std::move(pulls)), held_(device, rows()["guide pull"]),
      hold_(pullPipeline(device, "simulation/pull_hold.comp")),
      spread_(pullPipeline(device, "simulation/pull.comp")) {}

void PullPass::record(engine::Commands& commands, const GuideAddresses& guides, double time) const {
    const double dt = step_.whole;
    for (const PullSettings& pull : pulls_) {
        const std::optional<Hand> hand = handIn(pull, time, time + dt);
        if (!hand) continue;
        const double stiffness = pull.stiffness;
        const double damping = 2.0 * std::sqrt(stiffness);
        const gpu::PullPush push{
            .guides = guides.parameters,
            .accelerations = guides.accelerations,
            .held = held_.address(),
            .hand = hand->position,
            .hand_velocity = hand->velocity,
            .held_vertex = pull.guide * vertices_per_strand_ + pull.vertex,
            .radius = pull.radius,
            .stiffness = static_cast<float>(stiffness),
            .damping = static_cast<float>(damping),
            .implicit = static_cast<float>(1.0 / (1.0 + damping * dt + stiffness * dt * dt))};
        commands.bind(hold_, push);
        commands.uses(
            {{guides.positions, Access::compute_read},
             {guides.previous, Access::compute_read},
             {guides.accelerations, Access::compute_read},
             {held_, Access::compute_write}});
        commands.dispatch(1);
        commands.bind(spread_, push);
        commands.uses(
            {{held_, Access::compute_read}, {guides.accelerations, Access::compute_write}});
        commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
    }
}

// ---- Guides in a file ---------------------------------------------------------------------------

namespace {

using engine::Access;

static_assert(sizeof(gpu::CachePlace) == 20);
static_assert(sizeof(gpu::CacheRestPush) == 48 && offsetof(gpu::CacheRestPush, vertex_count) == 44);
static_assert(
    sizeof(gpu::CacheFollowPush) == 96 && offsetof(gpu::CacheFollowPush, stiffness) == 92);

std::vector<glm::vec4> samplesOf(const groom::Groom& groom) {
    std::vector<glm::vec4> samples;
    samples.reserve(groom.cache.points.size());
    for (const glm::vec3& point : groom.cache.points) samples.emplace_back(point, 0.0f);
    return samples;
}

// Without goals there is one offset, because a buffer has a size.
std::vector<glm::vec4>
goalOffsets(const engine::Device& device, const groom::Groom& groom, const engine::Buffer* goals) {
    if (!goals) return {glm::vec4(0.0f)};
    auto offsets = engine::downloadAs<glm::vec4>(device, *goals);
    for (std::size_t i = 0; i < offsets.size(); ++i)
        offsets[i] = glm::vec4(glm::vec3(offsets[i]) - groom.points[i], offsets[i].w);
    return offsets;
}

}  // namespace

CacheInterval intervalAt(const std::vector<double>& times, double time) {
    const auto next = std::ranges::upper_bound(times, time);
    const auto after = static_cast<std::size_t>(next - times.begin());
    if (after == 0) return {};
    if (after == times.size()) return {after - 1, after - 1, 0.0};
    return {after - 1, after, (time - times[after - 1]) / (times[after] - times[after - 1])};
}

engine::MemoryRows CachePass::rows(const groom::GroomSize& size, bool has_goals) {
    return {
        "simulation",
        {{"guide cache", engine::bytesOf<glm::vec4>(size.cached_points)},
         {"guide goal offsets", engine::bytesOf<glm::vec4>(has_goals ? size.vertices() : 0)}}};
}

CachePass::CachePass(
    const engine::Device& device, const groom::Groom& groom, const engine::Buffer& rest_positions,
    const engine::Buffer* goals)
    : times_(groom.cache.times), vertex_count_(groom.strand_count * groom.vertices_per_strand),
      stiffness_(groom.cache.strength.value_or(0.0f)), rest_positions_(&rest_positions),
      goals_(goals), samples_(engine::makeBuffer(
                         device, samplesOf(groom), rows(sizeOf(groom), goals), "guide cache")),
      goal_offsets_(engine::makeBuffer(
          device, goalOffsets(device, groom, goals), rows(sizeOf(groom), goals),
          "guide goal offsets")),
      rest_(
          device,
          {.shader = "simulation/cache_rest.comp", .push_size = sizeof(gpu::CacheRestPush)}),
      follow_(
          device,
          {.shader = "simulation/cache_follow.comp", .push_size = sizeof(gpu::CacheFollowPush)}) {
    assert(groom.cache.points.size() == times_.size() * vertex_count_);
}

gpu::CachePlace CachePass::placeAt(double time) const {
    const CacheInterval interval = intervalAt(times_, time);
    const auto addressOf = [&](std::size_t sample) {
        return samples_.address() + sample * vertex_count_ * sizeof(glm::vec4);
    };
    return {
        .before = addressOf(interval.before),
        .after = addressOf(interval.after),
        .fraction = static_cast<float>(interval.fraction)};
}

void CachePass::recordRest(engine::Commands& commands, double time) const {
    commands.bind(
        rest_, gpu::CacheRestPush{
                   .rest_positions = commands.writes(*rest_positions_),
                   .goals = goals_ ? commands.writes(*goals_) : 0,
                   .goal_offsets = commands.reads(goal_offsets_),
                   .place = placeAt(time),
                   .vertex_count = vertex_count_});
    commands.uses({{samples_, Access::compute_read}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

void CachePass::recordFollow(
    engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& head_before,
    const RigidMotion& head_after, double to) const {
    commands.bind(
        follow_, gpu::CacheFollowPush{
                     .guides = guides.parameters,
                     .accelerations = commands.writes(guides.accelerations),
                     .place = placeAt(to),
                     .frame_before = toGpu(head_before),
                     .frame = toGpu(head_after),
                     .stiffness = static_cast<float>(stiffness_)});
    commands.uses(
        {{samples_, Access::compute_read},
         {*rest_positions_, Access::compute_read},
         {guides.positions, Access::compute_read},
         {guides.previous, Access::compute_read}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
