#include "hair/simulation/distance_field.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <sstream>

#include <glm/common.hpp>

#include "engine/commands.h"
#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "hair/groom/mesh/closed_mesh.h"
#include "hair/simulation/dispatch_groups.h"
#include "hair/simulation/triangle_tree.h"

namespace hair {

namespace {

static_assert(sizeof(gpu::DistanceField) == 40 && offsetof(gpu::DistanceField, points) == 24);
static_assert(sizeof(gpu::TreeNode) == 32 && offsetof(gpu::TreeNode, upper) == 16);
static_assert(sizeof(gpu::TreeTriangle) == 48 && offsetof(gpu::TreeTriangle, normal) == 36);
static_assert(sizeof(gpu::TriangleNormals) == 84 && offsetof(gpu::TriangleNormals, corners) == 48);
static_assert(sizeof(gpu::BakeDistancePush) == 88 && offsetof(gpu::BakeDistancePush, nodes) == 40);
static_assert(offsetof(gpu::BakeDistancePush, first_block) == 76);

// Per submission: less than a second on lavapipe. Drivers end what takes a few.
constexpr std::uint32_t kBlocksPerBatch = 1024;

[[noreturn]] void throwTooLarge(const char* what, double bytes, double limit) {
    std::ostringstream reason;
    reason << what << " take " << bytes / 1048576.0 << " MiB; this device's buffers hold "
           << limit / 1048576.0;
    throw engine::Unsupported("distance field", reason.str());
}

double largestBuffer(const engine::Device& device) {
    return static_cast<double>(device.info().limits.maxStorageBufferRange);
}

gpu::DistanceField gridRound(
    const engine::Device& device, const ClosedMesh& mesh, std::uint32_t resolution, float padding) {
    glm::dvec3 lower(mesh.positions.front());
    glm::dvec3 upper = lower;
    for (const glm::vec3& position : mesh.positions) {
        lower = glm::min(lower, glm::dvec3(position));
        upper = glm::max(upper, glm::dvec3(position));
    }
    const glm::dvec3 size = upper - lower;
    const double cell = std::max({size.x, size.y, size.z}) / resolution;
    // A side that is whole cells but for rounding has that many.
    const glm::dvec3 cells = glm::ceil((size + 2.0 * double{padding}) / cell - 1e-6);
    const glm::dvec3 points = cells + 1.0;
    const double bytes = points.x * points.y * points.z * sizeof(float);
    if (bytes > largestBuffer(device)) throwTooLarge("its points", bytes, largestBuffer(device));
    return {
        .distances = 0,
        .origin = glm::vec3((lower + upper - cells * cell) / 2.0),
        .cell = static_cast<float>(cell),
        .points = glm::uvec3(points),
        .cells_per_metre = static_cast<float>(1.0 / cell)};
}

template <class Value>
engine::Buffer
makeBuffer(const engine::Device& device, const std::vector<Value>& values, const char* name) {
    const double bytes = static_cast<double>(values.size() * sizeof(Value));
    if (bytes > largestBuffer(device))
        throwTooLarge("the mesh's triangles", bytes, largestBuffer(device));
    return engine::makeBuffer(device, std::span<const Value>(values), name);
}

// A mesh on the device while it is baked.
struct BakeMesh {
    engine::Buffer nodes, triangles, normals;

    BakeMesh(const engine::Device& device, const ClosedMesh& mesh) {
        const TriangleTree tree = buildTriangleTree(mesh);
        std::vector<gpu::TreeTriangle> corners;
        std::vector<gpu::TriangleNormals> pseudonormals;
        for (const std::uint32_t index : tree.order) {
            const auto& [a, b, c] = mesh.triangles[index];
            const Pseudonormals& from = mesh.normals[index];
            corners.push_back(
                {.corners = {mesh.positions[a], mesh.positions[b], mesh.positions[c]},
                 .normal = glm::vec3(from.face)});
            gpu::TriangleNormals& to = pseudonormals.emplace_back();
            to.face = glm::vec3(from.face);
            std::ranges::copy(from.edges, to.edges);
            std::ranges::copy(from.corners, to.corners);
        }
        nodes = makeBuffer(device, tree.nodes, "distance field tree");
        triangles = makeBuffer(device, corners, "distance field triangles");
        normals = makeBuffer(device, pseudonormals, "distance field pseudonormals");
    }
};

}  // namespace

DistanceField::DistanceField(
    const engine::Device& device, const Mesh& mesh, std::uint32_t resolution, float padding) {
    assert(resolution > 0 && padding >= 0.0f);
    const ClosedMesh closed = closeMesh(mesh);
    parameters_ = gridRound(device, closed, resolution, padding);
    const glm::uvec3 points = parameters_.points;
    const std::size_t bytes = std::size_t{points.x} * points.y * points.z * sizeof(float);
    distances_ = {device, {.size = bytes, .name = "distance field"}};
    parameters_.distances = distances_.address();

    const BakeMesh triangles(device, closed);
    const engine::ComputePipeline pipeline(
        device,
        {.shader = "simulation/bake_distance.comp", .push_size = sizeof(gpu::BakeDistancePush)});
    const glm::uvec3 blocks = (points + gpu::kBakeBlock - 1u) / gpu::kBakeBlock;
    const std::uint32_t count = blocks.x * blocks.y * blocks.z;
    for (std::uint32_t first = 0; first < count; first += kBlocksPerBatch) {
        const gpu::BakeDistancePush push{
            .field = parameters_,
            .nodes = triangles.nodes.address(),
            .triangles = triangles.triangles.address(),
            .normals = triangles.normals.address(),
            .blocks = blocks,
            .first_block = first,
            .block_count = std::min(kBlocksPerBatch, count - first)};
        device.runOnce([&](engine::Commands& commands) {
            commands.bind(pipeline, push);
            dispatchGroups(commands, push.block_count);
            commands.barrier(engine::Access::compute_write, engine::Access::anything);
        });
    }
}

std::vector<float> DistanceField::distances(const engine::Device& device) const {
    return engine::downloadAs<float>(device, distances_);
}

}  // namespace hair
