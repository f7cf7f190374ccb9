#include "hair/simulation/solver_shape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/ext/quaternion_common.hpp>
#include <glm/ext/quaternion_geometric.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "engine/buffer_image.h"
#include "engine/error.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {
namespace {

// Whether the local constraint has an energy. Without stiffness it has none, and lengths keep their
// own method.
bool bends(const SimulationSettings& settings) {
    return settings.local.method == LocalMethod::energy && settings.local.stiffness > 0.0f &&
           settings.local.iterations > 0;
}

// ---- The shape at rest --------------------------------------------------------------------------

// Appends edges for the local constraint (Han and Harada 2012), [vertex]. xyz is the edge that ends
// in the vertex, in the frame that parallel transport carries along the strand from segment 1 to
// the segment before that edge, m; w is the rest length, m. Let Q_i be the smallest rotation from
// the tangent of segment i - 1 to that of segment i. Edge i is turned by (Q_(i-1) ... Q_2)^-1. The
// frame of the moving strand, P_(i-1) ... P_1, then turns it into the goal. Zero at the root.
void addTransportedEdges(
    std::span<const glm::dvec3> points, std::span<const double> rest_lengths,
    std::vector<glm::vec4>& edges) {
    edges.emplace_back(0.0f);
    glm::dquat transport{1.0, 0.0, 0.0, 0.0};  // Q_(i-1) ... Q_2
    glm::dvec3 tangent{0.0, 1.0, 0.0};  // of the last segment with a length
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 edge = points[i] - points[i - 1];
        const double length = glm::length(edge);
        const glm::dvec3 next = length < double{gpu::kShortestSegment} ? tangent : edge / length;
        edges.emplace_back(glm::vec3(glm::conjugate(transport) * edge), rest_lengths[i]);
        if (i > 1) transport = glm::normalize(rotationBetween(tangent, next) * transport);
        tangent = next;
    }
}

std::vector<double> lengthsOf(std::span<const glm::dvec3> points) {
    std::vector<double> lengths{0.0};
    for (std::size_t i = 1; i < points.size(); ++i)
        lengths.push_back(glm::distance(points[i], points[i - 1]));
    return lengths;
}

// Largest movement of vertices by weight in a substep before the lengths take it back, over the
// shortest segment. If vertices move past each other, there is more than one way back.
constexpr double kMostSag = 0.125;

// Returns the movement of a hanging strand's vertices by weight in a substep, before the lengths
// take it back, [vertex], m. From the tip up, a segment takes the component along itself of the
// pull at its end as a tension, which also pulls at its start. The rest is left to the pull toward
// the rest position. Tensions are never negative, so the balance is stable whatever else is stiff.
// They bear the weight up to `most`.
std::vector<glm::dvec3> sagOf(
    std::span<const glm::dvec3> points, std::span<const double> lengths, const glm::dvec3& weight,
    double most) {
    const glm::dvec3 borne = weight * std::min(1.0, most / glm::length(weight));
    std::vector<glm::dvec3> sag(points.size(), glm::dvec3(0.0));
    if (*std::ranges::min_element(lengths.subspan(1)) == 0.0) return sag;
    glm::dvec3 below{0.0};  // pull of the segment below
    for (std::size_t i = points.size() - 1; i > 0; --i) {
        const glm::dvec3 along = (points[i] - points[i - 1]) / lengths[i];
        const glm::dvec3 tension = std::max(glm::dot(borne + below, along), 0.0) * along;
        sag[i] = tension - below;
        below = tension;
    }
    return sag;
}

}  // namespace

// The goals of strands of `shape`, on the head at rest. [strand][vertex], except `stiffness`.
struct ShapeRest {
    std::vector<glm::vec4> positions;  // goals of the global constraint, m
    std::vector<glm::vec4> edges;  // goals of the local constraint: addTransportedEdges
    std::vector<float> stiffness;  // [strand], of the local constraint, per iteration
    // With a balanced rest shape. `points`: the groom. `left`: vertex positions that the
    // constraints leave for the lengths to take back. `weight`: movement by gravity in a substep,
    // left after the global pull. All in m.
    std::uint32_t vertices_per_strand = 0;
    std::vector<glm::dvec3> points;
    std::vector<glm::dvec3> left;
    glm::dvec3 weight{0.0};
    double pull = 0.0;  // of the global constraint, per substep
    // The local constraint has an energy. One system balances all forces, and this constraint
    // exerts none at rest.
    bool exact = false;
    std::optional<RestBalance> balance;

    // Computes positions and edges of all strands.
    void make();
};

void ShapeRest::make() {
    positions.clear();
    edges.clear();
    for (std::size_t first = 0; first < points.size(); first += vertices_per_strand) {
        const auto strand = std::span(points).subspan(first, vertices_per_strand);
        const auto goals = std::span(left).subspan(first, vertices_per_strand);
        for (std::size_t i = 0; i < strand.size(); ++i) {
            glm::dvec3 position = strand[i];
            if (i > 0 && pull > 0.0) position += (goals[i] - strand[i] - weight) / pull;
            positions.emplace_back(position, 0.0);
        }
        addTransportedEdges(exact ? strand : goals, lengthsOf(strand), edges);
    }
}

namespace {

std::unique_ptr<ShapeRest>
restOfShapes(const groom::Groom& groom, const SimulationSettings& settings, const gpu::Step& step) {
    auto rest = std::make_unique<ShapeRest>();
    rest->vertices_per_strand = groom.vertices_per_strand;
    rest->pull = globalStiffness(settings, step);
    if (settings.rest == RestShape::balanced) {
        rest->balance.emplace();
        const double substep = step.sub;
        if (rest->pull > 0.0)
            rest->weight = (1.0 - rest->pull) * substep * substep * gravityOnGroom(settings);
        else
            for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand)
                rest->balance->unbalanced.push_back(strand);
    }
    // A system with an energy bears any tension. Length iterations would leave hair stretched by
    // the movement that they take back, so with them the pull bears all of the weight.
    rest->exact = bends(settings);
    const bool keeps_lengths =
        rest->exact ||
        (settings.length.method == LengthMethod::tridiagonal && settings.length.iterations > 0);
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        std::vector<glm::dvec3> points;
        for (const glm::vec3& point : groom.strand(strand)) points.emplace_back(point);
        const std::vector<double> lengths = lengthsOf(points);
        const double sum = std::accumulate(lengths.begin(), lengths.end(), 0.0);
        const double mean = sum / groom.segmentsPerStrand();
        rest->stiffness.push_back(static_cast<float>(
            bends(settings) ? bendStiffness(settings, step, mean)
                            : localStiffness(settings, step, mean)));
        std::ranges::copy(points, std::back_inserter(rest->points));
        if (keeps_lengths && rest->weight != glm::dvec3(0.0)) {
            const double most =
                rest->exact ? std::numeric_limits<double>::infinity()
                            : kMostSag * *std::ranges::min_element(std::span(lengths).subspan(1));
            const auto sag = sagOf(points, lengths, rest->weight, most);
            for (std::size_t i = 0; i < points.size(); ++i) points[i] += sag[i];
        }
        std::ranges::copy(points, std::back_inserter(rest->left));
    }
    rest->make();
    return rest;
}

// ---- Strands by invocations ---------------------------------------------------------------------

constexpr std::uint32_t kGroup = 32;  // invocations to fill with whole strands

// Vertices per invocation. The shader is unrolled over them. llvmpipe compiles about 0.05 s for
// each, and half as much again if bending has an energy.
constexpr std::uint32_t kFewest = 2;
constexpr std::uint32_t kMost = 32;
constexpr std::uint32_t kOnGpu = 8;  // about 100 registers by a count of values; not measured

// Shared memory per invocation of simulation/shape.comp, B: seven vec4 and a float; with an energy
// one float more.
constexpr std::uint32_t kSharedBytes = 7 * 16 + 4;
constexpr std::uint32_t kSharedBytesOfEnergy = kSharedBytes + 4;

// Invocations that keep a GPU busy: a guess.
constexpr std::uint32_t kInvocationsToFillGpu = 32768;

std::uint32_t divideUp(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

std::uint32_t wantedPerChunk(
    const engine::DeviceInfo& device, Parallelism parallelism, std::uint32_t strand_count,
    std::uint32_t vertices) {
    if (parallelism == Parallelism::strand) return kMost;
    if (parallelism == Parallelism::vertex) return kFewest;
    if (device.type == engine::DeviceType::cpu) return kMost;
    const auto invocations = std::uint64_t{strand_count} * divideUp(vertices, kOnGpu);
    return invocations >= kInvocationsToFillGpu ? kOnGpu : kFewest;
}

// Returns the size of chunks of about equal size. It is even if there are several chunks:
// simulation/shape.comp.
std::uint32_t verticesPerChunk(std::uint32_t vertices, std::uint32_t wanted) {
    const std::uint32_t chunks = divideUp(vertices, wanted);
    return chunks == 1 ? vertices : divideUp(divideUp(vertices, chunks), 2) * 2;
}

std::string shaderOf(const engine::DeviceInfo& device, const SimulationSettings& settings) {
    const std::string variant = bends(settings) ? "+energy" : "";
    if (settings.parallelism == Parallelism::serial)
        return "simulation/shape_serial.comp" + variant;
    const bool packed = device.features.contains(engine::Feature::long_integers);
    return "simulation/shape.comp" + variant + (packed ? "+packed" : "");
}

// Throws Unsupported if strands have more vertices than 32 for each invocation of the device's
// largest work group, within its shared memory.
ShapePlan planShape(
    const engine::DeviceInfo& device, const SimulationSettings& settings,
    std::uint32_t strand_count, std::uint32_t vertices_per_strand) {
    const bool collides = !settings.colliders.empty() || !settings.distance_fields.empty();
    const bool tridiagonal = settings.length.method == LengthMethod::tridiagonal;
    if (settings.parallelism == Parallelism::serial)
        return {
            .shader = shaderOf(device, settings),
            .constants =
                {{gpu::kContinuousCollisionConstant, settings.collision.continuous},
                 {gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)},
                 {gpu::kShapeGroupSizeConstant, kGroup},
                 {gpu::kShapeTridiagonalConstant, tridiagonal},
                 {gpu::kShapeVerticesPerStrandConstant, vertices_per_strand}},
            .collides = collides,
            .strands_per_group = kGroup};

    const std::uint32_t most_chunks = std::min(
        device.limits.maxComputeWorkGroupInvocations,
        device.limits.maxComputeSharedMemorySize /
            (bends(settings) ? kSharedBytesOfEnergy : kSharedBytes));
    if (vertices_per_strand > most_chunks * kMost)
        throw engine::Unsupported(
            "simulation", std::to_string(vertices_per_strand) +
                              " vertices per strand; this device runs at most " +
                              std::to_string(most_chunks * kMost));
    const std::uint32_t fewest = divideUp(vertices_per_strand, most_chunks);
    const std::uint32_t wanted =
        wantedPerChunk(device, settings.parallelism, strand_count, vertices_per_strand);
    const std::uint32_t per_chunk = verticesPerChunk(vertices_per_strand, std::max(wanted, fewest));
    const std::uint32_t chunks = divideUp(vertices_per_strand, per_chunk);
    const std::uint32_t strands = std::max(1u, std::min(kGroup, most_chunks) / chunks);
    return {
        .shader = shaderOf(device, settings),
        .constants =
            {{gpu::kContinuousCollisionConstant, settings.collision.continuous},
             {gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)},
             {gpu::kShapeGroupSizeConstant, strands * chunks},
             {gpu::kShapeTridiagonalConstant, tridiagonal},
             {gpu::kShapeVerticesPerStrandConstant, vertices_per_strand},
             {gpu::kShapeVerticesPerChunkConstant, per_chunk}},
        .collides = collides,
        .strands_per_group = strands};
}

// ---- Pipelines and factors ----------------------------------------------------------------------

static_assert(offsetof(gpu::ShapeParameters, length_iterations) == 32);

engine::ComputePipeline pipelineOf(const engine::Device& device, const ShapePlan& plan) {
    engine::Constants constants = plan.constants;
    constants.emplace_back(gpu::kShapeCollidesConstant, plan.collides);
    return {
        device,
        {.shader = plan.shader, .constants = constants, .push_size = sizeof(gpu::SubstepPush)}};
}

}  // namespace

engine::MemoryRows ShapeSolver::rows(
    const engine::DeviceInfo&, const groom::GroomSize& size, const SimulationSettings&) {
    return {
        "simulation",
        {{"guide goals", engine::bytesOf<glm::vec4>(size.vertices())},
         {"guide rest edges", engine::bytesOf<glm::vec4>(size.vertices())},
         {"guide local stiffness", engine::bytesOf<float>(size.guides)},
         {"shape parameters", sizeof(gpu::ShapeParameters)}}};
}

ShapeSolver::ShapeSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step)
    : ShapeSolver(device, groom, settings, step, restOfShapes(groom, settings, step)) {}

ShapeSolver::ShapeSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step, std::unique_ptr<ShapeRest> rest)
    : balancing_(std::move(rest)), balance_(balancing_->balance), strand_count_(groom.strand_count),
      plan_(planShape(device.info(), settings, groom.strand_count, groom.vertices_per_strand)),
      pipeline_(pipelineOf(device, plan_)) {
    const engine::MemoryRows rows = ShapeSolver::rows(device.info(), sizeOf(groom), settings);
    const auto make = [&](const auto& values, const char* name) {
        return engine::makeBuffer(device, values, rows, name);
    };
    rest_positions_ = make(balancing_->positions, "guide goals");
    rest_edges_ = make(balancing_->edges, "guide rest edges");
    local_stiffness_ = make(balancing_->stiffness, "guide local stiffness");
    parameters_ = make(
        std::array{gpu::ShapeParameters{
            .rest_positions = rest_positions_.address(),
            .rest_edges = rest_edges_.address(),
            .local_stiffness = local_stiffness_.address(),
            .global_stiffness = static_cast<float>(globalStiffness(settings, step)),
            .local_iterations = settings.local.iterations,
            .length_iterations = settings.length.iterations,
            .local_damping = static_cast<float>(bendDamping(step))}},
        "shape parameters");
}

ShapeSolver::~ShapeSolver() = default;

// Shifts a vertex's left position back by its movement. After the lengths the vertex shifts too,
// except along the strand.
bool ShapeSolver::correctBalance(const engine::Device& device, std::span<const glm::vec3> moved) {
    constexpr double kStill = 1e-7;  // m: a few roundings of positions
    double most = 0.0;
    for (const glm::vec3& each : moved) most = std::max(most, glm::length(glm::dvec3(each)));
    if (!(most > kStill) || balancing_->exact || balancing_->weight == glm::dvec3(0.0)) {
        balancing_.reset();
        return false;
    }
    for (std::size_t i = 0; i < moved.size(); ++i) balancing_->left[i] -= glm::dvec3(moved[i]);
    balancing_->make();
    engine::upload(
        device, std::as_bytes(std::span<const glm::vec4>(balancing_->positions)), rest_positions_);
    engine::upload(
        device, std::as_bytes(std::span<const glm::vec4>(balancing_->edges)), rest_edges_);
    return true;
}

void ShapeSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    commands.bind(pipeline_, push);
    commands.dispatchInvocations(strand_count_, plan_.strands_per_group);
}

void ShapeSolver::expectBodies(const engine::Device& device) {
    if (plan_.collides) return;
    ShapePlan plan = plan_;
    plan.collides = true;
    pipeline_ = pipelineOf(device, plan);
    plan_ = std::move(plan);
}

}  // namespace hair::simulation
