#include "hair/simulation/solver_shape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <glm/ext/quaternion_common.hpp>
#include <glm/ext/quaternion_geometric.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "engine/buffer_image.h"
#include "engine/error.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {
namespace {

// ---- The shape at rest --------------------------------------------------------------------------

// The rest shape as the local constraint (Han and Harada 2012) wants it: xyz is the rest edge that
// ends in the vertex, seen from the frame that parallel transport carries from segment 1 along the
// rest strand to the segment before that edge, m; w is the edge's length, m. With Q_i the smallest
// rotation from the tangent of segment i - 1 to that of segment i, edge i is turned by (Q_(i-1) ...
// Q_2)^-1. The frame of the moving strand, P_(i-1) ... P_1, then turns it into the goal. Zero at
// the root. [strand][vertex]
std::vector<glm::vec4> transportedRestEdges(const groom::Groom& groom) {
    std::vector<glm::vec4> edges;
    edges.reserve(groom.points.size());
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const auto points = groom.strand(strand);
        edges.emplace_back(0.0f);
        glm::dquat transport{1.0, 0.0, 0.0, 0.0};  // Q_(i-1) ... Q_2
        glm::dvec3 tangent{0.0, 1.0, 0.0};  // of the last segment that had one
        for (std::uint32_t i = 1; i < groom.vertices_per_strand; ++i) {
            const glm::dvec3 edge = glm::dvec3(points[i]) - glm::dvec3(points[i - 1]);
            const double length = glm::length(edge);
            const glm::dvec3 next =
                length < double{gpu::kShortestSegment} ? tangent : edge / length;
            edges.emplace_back(glm::vec3(glm::conjugate(transport) * edge), length);
            if (i > 1) transport = glm::normalize(rotationBetween(tangent, next) * transport);
            tangent = next;
        }
    }
    return edges;
}

// Mean rest length of the segments of each strand, m. [strand]
std::vector<double> meanSegmentLengths(const groom::Groom& groom) {
    std::vector<double> means;
    means.reserve(groom.strand_count);
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const auto points = groom.strand(strand);
        double sum = 0.0;
        for (std::uint32_t i = 1; i < groom.vertices_per_strand; ++i)
            sum += glm::length(glm::dvec3(points[i]) - glm::dvec3(points[i - 1]));
        means.push_back(sum / groom.segmentsPerStrand());
    }
    return means;
}

// ---- Strands by invocations ---------------------------------------------------------------------

constexpr std::uint32_t kGroup = 32;  // invocations to fill with whole strands

// Vertices of an invocation. The shader is unrolled over them: llvmpipe takes about 0.05 s each to
// compile it.
constexpr std::uint32_t kFewest = 2;
constexpr std::uint32_t kMost = 32;
constexpr std::uint32_t kOnGpu = 8;  // some 100 registers by count of values; not measured

// Of shared memory, for each invocation of simulation/shape.glsl: seven vec4 and a float.
constexpr std::uint32_t kSharedBytes = 7 * 16 + 4;

// Invocations that keep a GPU busy: a guess.
constexpr std::uint32_t kInvocationsToFillGpu = 32768;

std::uint32_t divideUp(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

std::uint32_t wantedPerChunk(
    const engine::DeviceInfo& device, Parallelism parallelism, std::uint32_t strand_count,
    std::uint32_t vertices) {
    if (parallelism == Parallelism::strand) return kMost;
    if (parallelism == Parallelism::vertex) return kFewest;
    if (device.type == "cpu") return kMost;
    const auto invocations = std::uint64_t{strand_count} * divideUp(vertices, kOnGpu);
    return invocations >= kInvocationsToFillGpu ? kOnGpu : kFewest;
}

// Chunks of about the same size, which is even where there are several: simulation/shape.glsl.
std::uint32_t verticesPerChunk(std::uint32_t vertices, std::uint32_t wanted) {
    const std::uint32_t chunks = divideUp(vertices, wanted);
    return chunks == 1 ? vertices : divideUp(divideUp(vertices, chunks), 2) * 2;
}

// Throws Unsupported for strands with more vertices than the device has invocations in a workgroup,
// and shared memory for them, at 32 vertices each.
ShapePlan planShape(
    const engine::DeviceInfo& device, const SimulationSettings& settings,
    std::uint32_t strand_count, std::uint32_t vertices_per_strand) {
    const bool collides = !settings.colliders.empty() || !settings.distance_fields.empty();
    const bool tridiagonal = settings.length.method == LengthMethod::tridiagonal;
    if (settings.parallelism == Parallelism::serial)
        return {
            .shader = "simulation/shape_serial.comp",
            .constants =
                {{gpu::kShapeGroupSizeConstant, kGroup},
                 {gpu::kShapeTridiagonalConstant, tridiagonal},
                 {gpu::kShapeVerticesPerStrandConstant, vertices_per_strand}},
            .collides = collides,
            .strands_per_group = kGroup};

    const std::uint32_t most_chunks = std::min(
        device.limits.maxComputeWorkGroupInvocations,
        device.limits.maxComputeSharedMemorySize / kSharedBytes);
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
        .shader = device.features.contains(engine::Feature::long_integers)
                      ? "simulation/shape_packed.comp"
                      : "simulation/shape.comp",
        .constants =
            {{gpu::kShapeGroupSizeConstant, strands * chunks},
             {gpu::kShapeTridiagonalConstant, tridiagonal},
             {gpu::kShapeVerticesPerStrandConstant, vertices_per_strand},
             {gpu::kShapeVerticesPerChunkConstant, per_chunk}},
        .collides = collides,
        .strands_per_group = strands};
}

// ---- Pipelines and factors ----------------------------------------------------------------------

static_assert(offsetof(gpu::ShapeParameters, length_iterations) == 24);

std::vector<float> localStiffnesses(
    const groom::Groom& groom, const SimulationSettings& settings, const gpu::Step& step) {
    std::vector<float> factors;
    for (const double length : meanSegmentLengths(groom))
        factors.push_back(static_cast<float>(localStiffness(settings, step, length)));
    return factors;
}

engine::ComputePipeline pipelineOf(const engine::Device& device, const ShapePlan& plan) {
    engine::Constants constants = plan.constants;
    constants.emplace_back(gpu::kShapeCollidesConstant, plan.collides);
    return {
        device,
        {.shader = plan.shader, .constants = constants, .push_size = sizeof(gpu::SubstepPush)}};
}

}  // namespace

ShapeSolver::ShapeSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step)
    : strand_count_(groom.strand_count),
      plan_(planShape(device.info(), settings, groom.strand_count, groom.vertices_per_strand)),
      rest_edges_(engine::makeBuffer(
          device, std::span<const glm::vec4>(transportedRestEdges(groom)), "guide rest edges")),
      local_stiffness_(engine::makeBuffer(
          device, std::span<const float>(localStiffnesses(groom, settings, step)),
          "guide local stiffness")),
      parameters_(engine::makeBuffer(
          device,
          std::span<const gpu::ShapeParameters>(std::array{gpu::ShapeParameters{
              .rest_edges = rest_edges_.address(),
              .local_stiffness = local_stiffness_.address(),
              .global_stiffness = static_cast<float>(globalStiffness(settings, step)),
              .local_iterations = settings.local.iterations,
              .length_iterations = settings.length.iterations}}),
          "shape parameters")),
      pipeline_(pipelineOf(device, plan_)) {}

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
