#include "hair/simulation/shape_plan.h"

#include <algorithm>

#include "engine/error.h"
#include "hair/gpu_structs.h"

namespace hair {

namespace {

constexpr std::uint32_t kGroup = 32;  // invocations to fill with whole strands

// Vertices of an invocation. The shader is unrolled over them: llvmpipe takes about 0.05 s each to
// compile it.
constexpr std::uint32_t kFewest = 2;
constexpr std::uint32_t kMost = 32;
constexpr std::uint32_t kOnGpu = 8;  // some 100 registers by count of values; not measured

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

// Chunks of about the same size, which is even where there are several: simulation/shape.comp.
std::uint32_t verticesPerChunk(std::uint32_t vertices, std::uint32_t wanted) {
    const std::uint32_t chunks = divideUp(vertices, wanted);
    return chunks == 1 ? vertices : divideUp(divideUp(vertices, chunks), 2) * 2;
}

}  // namespace

ShapePlan planShape(
    const engine::DeviceInfo& device, const SimulationSettings& settings,
    std::uint32_t strand_count, std::uint32_t vertices_per_strand) {
    const bool collides = !settings.colliders.empty() || !settings.distance_fields.empty();
    if (settings.parallelism == Parallelism::serial)
        return {
            .shader = "simulation/shape_serial.comp",
            .constants =
                {{gpu::kShapeGroupSizeConstant, kGroup},
                 {gpu::kShapeVerticesPerStrandConstant, vertices_per_strand}},
            .collides = collides,
            .strands_per_group = kGroup};

    const std::uint32_t most_chunks = device.limits.maxComputeWorkGroupInvocations;
    const std::uint32_t fewest = divideUp(vertices_per_strand, most_chunks);
    if (fewest > kMost)
        throw engine::Unsupported(
            "simulation", std::to_string(vertices_per_strand) +
                              " vertices per strand; this device runs at most " +
                              std::to_string(most_chunks * kMost));
    const std::uint32_t wanted =
        wantedPerChunk(device, settings.parallelism, strand_count, vertices_per_strand);
    const std::uint32_t per_chunk = verticesPerChunk(vertices_per_strand, std::max(wanted, fewest));
    const std::uint32_t chunks = divideUp(vertices_per_strand, per_chunk);
    const std::uint32_t strands = std::max(1u, kGroup / chunks);
    return {
        .shader = "simulation/shape.comp",
        .constants =
            {{gpu::kShapeGroupSizeConstant, strands * chunks},
             {gpu::kShapeVerticesPerStrandConstant, vertices_per_strand},
             {gpu::kShapeVerticesPerChunkConstant, per_chunk}},
        .collides = collides,
        .strands_per_group = strands};
}

}  // namespace hair
