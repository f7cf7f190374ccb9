#include "hair/simulation/hair_hair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/simulation/solvers.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {
namespace {

using engine::Access;

static_assert(sizeof(gpu::VolumeSample) == 32);
static_assert(sizeof(gpu::VolumeParameters) == 88 && offsetof(gpu::VolumeParameters, origin) == 32);
static_assert(sizeof(gpu::VolumeBlock) == 8);
static_assert(sizeof(gpu::VolumePush) == 52);
static_assert(sizeof(gpu::ShelterPush) == 72);
static_assert(sizeof(gpu::YieldPush) == 96 && offsetof(gpu::YieldPush, frame_before) == 60);
static_assert(sizeof(gpu::VolumeAttraction) == 8);

// Reach of the grids beyond the roots, over the longest strand's length. The thesis's length
// constraint lets strands stretch.
constexpr double kReach = 1.1;
// Largest movement by repulsion in a step, cells.
constexpr double kGreatestPush = 1.0;
// Largest predicted part of friction. The exact part tends to 1 for large friction, and the
// prediction would then never decay.
constexpr double kMostPredicted = 0.75;
// Largest repulsion in use, over (cell / step)^2.
constexpr double kGreatestRepulsion = 0.5;
constexpr double kGreatestRepulsionInYield = 0.25;
// Part of a cell's face in which two strands on top of each other, along an axis of the grid, are
// as if they were spread evenly over it: the square of the spline's own overlap, 11 / 20.
constexpr double kPairOverlap = 0.3025;
// Jump of the potential at which hair yields, over yield stress / density * step / cell: the mean
// of the values for a sharp jump and for an even slope.
constexpr double kYieldJump = 0.5 * (840.0 / 239.0 + 64.0 / 13.0);

double strandLength(std::span<const glm::vec3> strand) {
    double length = 0.0;
    for (std::size_t i = 1; i < strand.size(); ++i)
        length += glm::distance(glm::dvec3(strand[i]), glm::dvec3(strand[i - 1]));
    return length;
}

// Returns the B-spline weights of a point in three cells in a row; the point is in the middle cell.
std::array<double, 3> weightsAlong(double point) {
    const double offset = point - std::floor(point) - 0.5;
    return {
        0.5 * (0.5 - offset) * (0.5 - offset), 0.75 - offset * offset,
        0.5 * (0.5 + offset) * (0.5 + offset)};
}

template <class Visit>  // (cell index over all grids, weight)
void visitCells(const VolumeGrid& first_grid, const glm::dvec3& position, Visit visit) {
    const std::size_t side = first_grid.resolution;
    for (std::size_t grid = 0; grid < gpu::kVolumeGrids; ++grid) {
        const glm::dvec3 point = (position - first_grid.origin) / first_grid.cell +
                                 glm::dvec3(0.5 * static_cast<double>(grid));
        const auto x = weightsAlong(point.x);
        const auto y = weightsAlong(point.y);
        const auto z = weightsAlong(point.z);
        const auto lowest = [](double along) { return static_cast<std::size_t>(along) - 1; };
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t i = 0; i < 3; ++i)
                    visit(
                        ((grid * side + lowest(point.z) + k) * side + lowest(point.y) + j) * side +
                            lowest(point.x) + i,
                        x[i] * y[j] * z[k]);
    }
}

std::vector<float> toFloat(std::span<const double> values) {
    return {values.begin(), values.end()};
}

struct Friction {
    double settled = 0.0;
    double predicted = 0.0;
};

// Returns the parts that friction removes in a step: of the differences at its start, and of those
// added during it.
Friction frictionIn(const HairHairSettings& contact, double step) {
    const double setting = contact.friction;
    if (setting == 0.0) return {};
    const double rate = -std::log1p(-setting) / kReferenceStep;
    const double settled = -std::expm1(-rate * step);
    const bool springs = contact.repulsion > 0.0f || contact.attraction > 0.0f;
    const double most = springs ? 1.0 - settled : kMostPredicted;
    return {.settled = settled, .predicted = std::min(1.0 - settled / (rate * step), most)};
}

// Returns the greatest stiffness that is stable, m^2/s^2.
double greatestRepulsion(const HairHairSettings& contact, double cell, double step) {
    const double greatest = yields(contact) ? kGreatestRepulsionInYield : kGreatestRepulsion;
    return greatest * (cell / step) * (cell / step);
}

// Returns the repulsion in use, m^2/s^2.
double repulsionIn(const HairHairSettings& contact, double cell, double step) {
    return std::min(double{contact.repulsion}, greatestRepulsion(contact, cell, step));
}

// Returns the parameters without addresses.
gpu::VolumeParameters
parametersOf(const groom::Groom& groom, const SimulationSettings& settings, const gpu::Step& step) {
    const HairHairSettings& contact = settings.hair_hair;
    const VolumeGrid grid = volumeGrid(groom, contact.resolution);
    const double whole = step.whole;
    const Friction friction = frictionIn(contact, whole);
    const double fastest = grid.cell / whole;  // m/s, stays within a cell
    return {
        .origin = grid.origin,
        .cell = static_cast<float>(grid.cell),
        .resolution = grid.resolution,
        .crowded = static_cast<float>(double{contact.crowding} * meanRestDensity(groom, grid)),
        .settled = static_cast<float>(friction.settled),
        .predicted = static_cast<float>(friction.predicted),
        .per_step = static_cast<float>(1.0 / whole),
        .repulsion = static_cast<float>(repulsionIn(contact, grid.cell, whole) / grid.cell),
        .greatest_repulsion = static_cast<float>(kGreatestPush * fastest / whole)};
}

// Returns the part that is constant in a simulation's life.
gpu::YieldPush
yieldOf(const groom::Groom& groom, const HairHairSettings& contact, const gpu::Step& step) {
    const double cell = volumeGrid(groom, contact.resolution).cell;
    const double whole = step.whole;
    const double jump = kYieldJump * whole / cell;
    gpu::YieldPush push{};
    push.pressed = static_cast<float>(
        jump * double{contact.friction_coefficient} * repulsionIn(contact, cell, whole));
    push.cohesive = static_cast<float>(jump * double{contact.cohesion});
    return push;
}

bool attracts(const HairHairSettings& settings) { return settings.attraction > 0.0f; }

bool touches(const HairHairSettings& settings) {
    return settings.friction > 0.0f || settings.repulsion > 0.0f || yields(settings) ||
           attracts(settings);
}

double lengthOf(const groom::Groom& groom) {
    double length = 0.0;
    for (std::uint32_t s = 0; s < groom.strand_count; ++s) length += strandLength(groom.strand(s));
    return length;
}

// Returns the number of strands through a cell's face in crowded hair.
double
crowdedStrands(const groom::Groom& groom, const HairHairSettings& contact, const VolumeGrid& grid) {
    const double crowded = double{contact.crowding} * meanRestDensity(groom, grid);
    return crowded * lengthOf(groom) / grid.cell;
}

// Returns the attraction's potential in crowded hair in use, m^2/s^2.
double attractionIn(
    const groom::Groom& groom, const HairHairSettings& contact, const VolumeGrid& grid,
    double step) {
    if (!attracts(contact)) return 0.0;
    return std::min(
        double{contact.attraction} * crowdedStrands(groom, contact, grid) / kPairOverlap,
        greatestRepulsion(contact, grid.cell, step));
}

// Returns the part that is constant in a simulation's life.
gpu::VolumeAttraction
attractionOf(const groom::Groom& groom, const HairHairSettings& contact, const gpu::Step& step) {
    const VolumeGrid grid = volumeGrid(groom, contact.resolution);
    const double whole = step.whole;
    return {
        .attraction = static_cast<float>(attractionIn(groom, contact, grid, whole) / grid.cell),
        .repulsion = static_cast<float>(repulsionIn(contact, grid.cell, whole) / grid.cell)};
}

// Returns the frontal area of the groom's hairs over that of a cell's face.
double areaPerShare(const groom::Groom& groom, const SimulationSettings& settings) {
    const double cell = volumeGrid(groom, settings.hair_hair.resolution).cell;
    return 2.0 * double{settings.material.radius} * double{settings.hair_hair.shelter} *
           lengthOf(groom) / (cell * cell);
}

std::size_t cellCount(std::size_t side) { return gpu::kVolumeGrids * side * side * side; }

std::size_t cellCount(const SimulationSettings& settings) {
    return cellCount(settings.hair_hair.resolution);
}

std::size_t blockCount(const SimulationSettings& settings) {
    return cellCount(((settings.hair_hair.resolution - 1) >> gpu::kVolumeBlockBits) + 1);
}

// Whether two components of a sum share one 64-bit integer, as in volume_splat.comp+packed. This
// halves the atomic operations.
bool isPacked(const engine::Device& device) {
    return device.has(engine::Feature::long_integers) && device.has(engine::Feature::long_atomics);
}

// Returns the variant of shaders that visit all cells round a vertex (simulation/volume.glsl).
std::string slices(const engine::Device& device) {
    return device.info().type == engine::DeviceType::cpu ? "" : "+slices";
}

// Returns the variant of shaders that add a vertex to all cells round it.
std::string perCell(const engine::Device& device) {
    return slices(device) + (isPacked(device) ? "+packed" : "");
}

// The push constants of simulation/volume_force.comp+attraction.
template <class Push>
struct WithAttraction {
    Push push;
    gpu::VolumeAttraction attraction;
};

static_assert(offsetof(WithAttraction<gpu::VolumePush>, attraction) == 52);
static_assert(offsetof(WithAttraction<gpu::YieldPush>, attraction) == 96);

template <class Push = gpu::VolumePush>
engine::ComputePipeline pipeline(const engine::Device& device, const std::string& shader) {
    return {device, {.shader = shader, .push_size = sizeof(Push)}};
}

template <class Push>
engine::ComputePipeline forcePipeline(
    const engine::Device& device, const std::string& shader, const HairHairSettings& settings) {
    if (!attracts(settings)) return pipeline<Push>(device, shader);
    return pipeline<WithAttraction<Push>>(device, shader + "+attraction");
}

}  // namespace

bool hairActsOnHair(const SimulationSettings& settings) {
    return settings.solver != Solver::none &&
           (touches(settings.hair_hair) || settings.hair_hair.shelter > 0.0f);
}

std::vector<StepLimit>
limitedBySteps(const groom::Groom& groom, const SimulationSettings& settings) {
    const HairHairSettings& contact = settings.hair_hair;
    std::vector<StepLimit> limits;
    if (settings.solver == Solver::none) return limits;
    const double step = stepOf(settings).whole;
    const VolumeGrid grid = volumeGrid(groom, contact.resolution);
    const double greatest = greatestRepulsion(contact, grid.cell, step);
    const auto compare = [&](const char* field, double set, double potential) {
        if (set * potential > greatest)
            limits.push_back(
                {.field = field,
                 .set = set,
                 .used = greatest / potential,
                 .longest_step = step * std::sqrt(greatest / (set * potential))});
    };
    compare("/simulation/hair_hair/repulsion", double{contact.repulsion}, 1.0);
    if (attracts(contact))
        compare(
            "/simulation/hair_hair/attraction", double{contact.attraction},
            crowdedStrands(groom, contact, grid) / kPairOverlap);
    return limits;
}

VolumeGrid volumeGrid(const groom::Groom& groom, std::uint32_t resolution) {
    glm::dvec3 low(groom.points[0]);
    glm::dvec3 high = low;
    double longest = 0.0;
    for (std::uint32_t s = 0; s < groom.strand_count; ++s) {
        const auto strand = groom.strand(s);
        low = glm::min(low, glm::dvec3(strand[0]));
        high = glm::max(high, glm::dvec3(strand[0]));
        longest = std::max(longest, strandLength(strand));
    }
    const glm::dvec3 size = high - low;
    // Gives a grid to hair without any size, too.
    const double side = std::max({size.x, size.y, size.z}) + 2.0 * std::max(kReach * longest, 1e-3);
    const double cell = side / (resolution - 2 * gpu::kVolumeMargin);
    return {
        .origin = 0.5 * (low + high) - glm::dvec3(0.5 * cell * resolution),
        .cell = cell,
        .resolution = resolution};
}

std::vector<double> lengthShares(const groom::Groom& groom) {
    std::vector<double> shares(groom.points.size());
    for (std::size_t i = 1; i < shares.size(); ++i) {
        if (i % groom.vertices_per_strand == 0) continue;
        const double half =
            0.5 * glm::distance(glm::dvec3(groom.points[i]), glm::dvec3(groom.points[i - 1]));
        shares[i - 1] += half;
        shares[i] += half;
    }
    const double whole = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares)
        share = whole > 0.0 ? share / whole : 1.0 / static_cast<double>(shares.size());
    return shares;
}

double meanRestDensity(const groom::Groom& groom, const VolumeGrid& grid) {
    const std::size_t side = grid.resolution;
    const std::vector<double> shares = lengthShares(groom);
    std::vector<double> density(gpu::kVolumeGrids * side * side * side);
    for (std::size_t i = 0; i < shares.size(); ++i)
        visitCells(grid, groom.points[i], [&](std::size_t cell, double weight) {
            density[cell] += weight * shares[i];
        });
    double sum = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i)
        visitCells(grid, groom.points[i], [&](std::size_t cell, double weight) {
            sum += shares[i] * weight * density[cell];
        });
    return sum / gpu::kVolumeGrids;
}

engine::MemoryRows
HairHair::rows(const groom::GroomSize& size, const SimulationSettings& settings) {
    const std::uint64_t vertices = size.vertices();
    engine::MemoryRows rows{
        "simulation",
        {{"volume shares", engine::bytesOf<float>(vertices)},
         {"volume samples", engine::bytesOf<gpu::VolumeSample>(vertices)},
         {"volume sums", engine::bytesOf<glm::ivec4>(cellCount(settings))},
         {"volume blocks", engine::bytesOf<gpu::VolumeBlock>(blockCount(settings))},
         {"volume parameters", sizeof(gpu::VolumeParameters)},
         {"volume kept", engine::bytesOf<glm::vec4>(vertices)},
         {"settled state", engine::bytesOf<glm::vec4>(vertices)}}};
    if (yields(settings.hair_hair))
        rows.add(
            {"simulation", {{"volume spreads", engine::bytesOf<glm::uvec2>(cellCount(settings))}}});
    return rows;
}

HairHair::HairHair(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step)
    : vertex_count_(static_cast<std::uint32_t>(groom.points.size())),
      yield_(yieldOf(groom, settings.hair_hair, step)),
      attraction_(attractionOf(groom, settings.hair_hair, step)),
      area_per_share_(areaPerShare(groom, settings)),
      sample_(
          yields(settings.hair_hair)
              ? pipeline<gpu::YieldPush>(device, "simulation/volume_sample.comp+yield")
              : pipeline(device, "simulation/volume_sample.comp")),
      splat_(pipeline(device, "simulation/volume_splat.comp" + perCell(device))) {
    if (yields(settings.hair_hair) && settings.hair_hair.friction > 0.0f)
        throw engine::Error(
            "/simulation/hair_hair/friction",
            "is above 0, but friction_coefficient or cohesion takes its place");
    const std::string force = "simulation/volume_force.comp" + slices(device);
    if (yields(settings.hair_hair)) {
        spread_.emplace(
            pipeline<gpu::YieldPush>(device, "simulation/volume_spread.comp" + perCell(device)));
        force_ = forcePipeline<gpu::YieldPush>(device, force + "+yield", settings.hair_hair);
    } else if (touches(settings.hair_hair)) {
        force_ = forcePipeline<gpu::VolumePush>(device, force, settings.hair_hair);
    }
    if (settings.hair_hair.shelter > 0.0f)
        shelter_.emplace(
            device,
            engine::ComputeDescription{
                .shader = "simulation/volume_shelter.comp", .push_size = sizeof(gpu::ShelterPush)});
    const engine::MemoryRows rows = HairHair::rows(sizeOf(groom), settings);
    shares_ = engine::makeBuffer(device, toFloat(lengthShares(groom)), rows, "volume shares");
    samples_ = {device, rows["volume samples"]};
    sums_ = {device, rows["volume sums"]};
    blocks_ = {device, rows["volume blocks"]};
    kept_ = {device, rows["volume kept"]};
    if (spread_) spreads_.emplace(device, rows["volume spreads"]);
    gpu::VolumeParameters parameters = parametersOf(groom, settings, step);
    parameters.shares = shares_.address();
    parameters.samples = samples_.address();
    parameters.sums = sums_.address();
    parameters.blocks = blocks_.address();
    parameters.borrows = isPacked(device) ? 1 : 0;
    parameters.kept = kept_.address();
    parameters_ = engine::makeBuffer(device, std::array{parameters}, rows, "volume parameters");
    forget(device);
}

void HairHair::forget(const engine::Device& device) {
    runOnce(device, [&](engine::Commands& commands) { commands.fill(kept_, 0); });
}

void HairHair::recordShelter(
    engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& later,
    const AirAtGuides& air) const {
    commands.bind(
        *shelter_, gpu::ShelterPush{
                       .guides = guides.parameters,
                       .volume = parameters_.address(),
                       .accelerations = commands.writes(guides.accelerations),
                       .air = commands.writes(*air.velocities),
                       .frame = toGpu(later),
                       .area_per_share = static_cast<float>(area_per_share_),
                       .viscous = air.drag.viscous / air.drag.inertial,
                       .drag_along = air.along});
    commands.uses(
        {{guides.positions, Access::compute_read},
         {guides.previous, Access::compute_read},
         {samples_, Access::compute_read},
         {blocks_, Access::compute_read},
         {sums_, Access::compute_read}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

template <class Push>
void HairHair::bindForce(engine::Commands& commands, const Push& push) const {
    if (attraction_.attraction > 0.0f)
        commands.bind(*force_, WithAttraction<Push>{push, attraction_});
    else
        commands.bind(*force_, push);
}

void HairHair::record(
    engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& now,
    const RigidMotion& later, const AirAtGuides& air) const {
    // Air without density takes no momentum.
    const bool shelters = shelter_ && air.velocities && air.drag.inertial > 0.0f;
    if (!shelters && !force_) return;
    gpu::VolumePush push{
        .guides = guides.parameters, .volume = parameters_.address(), .frame = toGpu(later)};
    commands.fill(sums_, 0);
    commands.fill(blocks_, 0);
    if (spread_) commands.fill(*spreads_, 0);

    gpu::YieldPush yield = yield_;
    if (spread_) {
        yield.guides = push.guides;
        yield.volume = push.volume;
        yield.frame = push.frame;
        yield.frame_before = toGpu(now);
        commands.bind(sample_, yield);
        commands.uses({{kept_, Access::compute_write}});
    } else {
        commands.bind(sample_, push);
    }
    commands.uses(
        {{guides.positions, Access::compute_read},
         {guides.previous, Access::compute_read},
         {samples_, Access::compute_write},
         {blocks_, Access::compute_write}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);

    commands.bind(splat_, push);
    commands.uses(
        {{samples_, Access::compute_read},
         {blocks_, Access::compute_read},
         {sums_, Access::compute_write}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);

    if (shelters) recordShelter(commands, guides, later, air);
    if (!force_) return;
    if (spread_) {
        yield.spreads = commands.writes(*spreads_);
        commands.bind(*spread_, yield);
        commands.uses(
            {{samples_, Access::compute_read},
             {blocks_, Access::compute_read},
             {sums_, Access::compute_read}});
        commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);

        yield.spreads = commands.reads(*spreads_);
        yield.accelerations = commands.writes(guides.accelerations);
        bindForce(commands, yield);
    } else {
        push.accelerations = commands.writes(guides.accelerations);
        bindForce(commands, push);
    }
    commands.uses(
        {{samples_, Access::compute_read},
         {blocks_, Access::compute_read},
         {sums_, Access::compute_read},
         {kept_, Access::compute_write}});
    commands.dispatchInvocations(vertex_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
