#include "hair/simulation/bodies.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/commands.h"
#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/process.h"
#include "engine/transfer.h"
#include "hair/simulation/open_body.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {
namespace {

// ---- Baking a distance field --------------------------------------------------------------------

static_assert(sizeof(gpu::DistanceField) == 40 && offsetof(gpu::DistanceField, points) == 24);
static_assert(sizeof(gpu::BvhNode) == 32 && offsetof(gpu::BvhNode, upper) == 16);
static_assert(sizeof(gpu::BvhTriangle) == 48 && offsetof(gpu::BvhTriangle, normal) == 36);
static_assert(sizeof(gpu::TriangleNormals) == 84 && offsetof(gpu::TriangleNormals, corners) == 48);
static_assert(sizeof(gpu::BlockMiddle) == 8);
static_assert(sizeof(gpu::BakeDistancePush) == 108 && offsetof(gpu::BakeDistancePush, nodes) == 40);
static_assert(offsetof(gpu::BakeDistancePush, first_block) == 92);

// On lavapipe, 12 bakes 1.4 times as fast as 4: processing a leaf costs less than finding it.
// Halving 2^32 triangles down to leaves of this size takes fewer than gpu::kBvhDepth levels.
constexpr std::size_t kMostInLeaf = 12;

// One submission of this size takes less than a second on lavapipe. Drivers abort submissions that
// take a few seconds.
constexpr std::uint32_t kBlocksPerBatch = 1024;

[[noreturn]] void throwTooLarge(const char* what, double bytes, double limit) {
    std::ostringstream reason;
    reason << what << " need " << bytes / 1048576.0 << " MiB; this device's buffers hold at most "
           << limit / 1048576.0 << " MiB";
    throw engine::Unsupported("distance field", reason.str());
}

double largestBuffer(const engine::Device& device) {
    return static_cast<double>(device.info().limits.maxStorageBufferRange);
}

gpu::DistanceField gridRound(
    const engine::Device& device, std::span<const glm::vec3> positions, std::uint32_t resolution,
    float padding) {
    glm::dvec3 lower(positions.front());
    glm::dvec3 upper = lower;
    for (const glm::vec3& position : positions) {
        lower = glm::min(lower, glm::dvec3(position));
        upper = glm::max(upper, glm::dvec3(position));
    }
    const glm::dvec3 size = upper - lower;
    const double cell = std::max({size.x, size.y, size.z}) / resolution;
    // A side that is a whole number of cells within rounding gets that number.
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

OpenBody openBody(
    const engine::Device& device, const groom::OpenMesh& mesh, const gpu::DistanceField& grid) {
    // There are no more nodes than triangles: leaves hold at least two triangles.
    const double bytes = static_cast<double>(mesh.triangles.size() * sizeof(gpu::WindingNode));
    if (bytes > largestBuffer(device))
        throwTooLarge("the mesh's triangles", bytes, largestBuffer(device));
    return makeOpenBody(device, mesh, grid);
}

template <class Value>
engine::Buffer
makeBuffer(const engine::Device& device, const std::vector<Value>& values, const char* name) {
    const double bytes = static_cast<double>(values.size() * sizeof(Value));
    if (bytes > largestBuffer(device))
        throwTooLarge("the mesh's triangles", bytes, largestBuffer(device));
    return engine::makeBuffer(device, std::span<const Value>(values), name);
}

// If a corner of a cell is not exact, the whole cell is farther from the mesh than `padding`: a
// cell's diagonal is 1.73 cells. The remainder covers rounding on grids far from the origin.
constexpr float kBandCells = 2.5f;

glm::dvec3 normalOf(const gpu::BvhTriangle& triangle) {
    const glm::dvec3 a(triangle.corners[0]);
    return glm::normalize(
        glm::cross(glm::dvec3(triangle.corners[1]) - a, glm::dvec3(triangle.corners[2]) - a));
}

// A body's surface on the device during baking.
struct BakeSurface {
    engine::Buffer nodes, triangles;
    std::optional<engine::Buffer> normals, sides;  // one of them

    BakeSurface(const engine::Device& device, const groom::ClosedMesh& mesh)
        : BakeSurface(device, mesh.positions, mesh.triangles, mesh.normals) {}

    BakeSurface(const engine::Device& device, const OpenBody& body)
        : BakeSurface(device, body.positions, body.triangles, {}) {
        sides = makeBuffer(device, body.sides, "sides of a distance field's points");
    }

private:
    BakeSurface(
        const engine::Device& device, std::span<const glm::vec3> positions,
        std::span<const std::array<std::uint32_t, 3>> faces,
        std::span<const groom::Pseudonormals> from) {
        groom::TriangleBvh tree = groom::buildTriangleBvh(positions, faces, kMostInLeaf);
        std::vector<gpu::BvhNode> boxes;
        for (const groom::TriangleBvh::Node& node : tree.nodes) {
            boxes.push_back(
                {.lower = node.low, .first = node.first, .upper = node.high, .count = node.count});
            // Sorted by index, so that every device picks the same one of equally near triangles.
            if (node.count > 0)
                std::ranges::sort(std::span(tree.order).subspan(node.first, node.count));
        }
        std::vector<gpu::BvhTriangle> corners;
        std::vector<gpu::TriangleNormals> pseudonormals;
        for (const std::uint32_t index : tree.order) {
            const auto& [a, b, c] = faces[index];
            gpu::BvhTriangle& triangle = corners.emplace_back();
            triangle.corners[0] = positions[a];
            triangle.corners[1] = positions[b];
            triangle.corners[2] = positions[c];
            triangle.normal = glm::vec3(normalOf(triangle));
            if (from.empty()) continue;
            gpu::TriangleNormals& to = pseudonormals.emplace_back();
            to.face = glm::vec3(from[index].face);
            std::ranges::copy(from[index].edges, to.edges);
            std::ranges::copy(from[index].corners, to.corners);
        }
        nodes = makeBuffer(device, boxes, "distance field tree");
        triangles = makeBuffer(device, corners, "distance field triangles");
        if (!from.empty())
            normals = makeBuffer(device, pseudonormals, "distance field pseudonormals");
    }
};

// ---- Capsules and fields ------------------------------------------------------------------------

static_assert(sizeof(gpu::Capsule) == 32 && offsetof(gpu::Capsule, b) == 16);
static_assert(sizeof(gpu::BodyField) == 48);

std::uint32_t toGpu(Follows follows) {
    return follows == Follows::head ? gpu::kFollowsHead : gpu::kFollowsWorld;
}

std::vector<gpu::Capsule> capsulesOf(const SimulationSettings& settings) {
    std::vector<gpu::Capsule> capsules;
    for (const Collider& collider : settings.colliders)
        capsules.push_back(
            {.a = collider.a,
             .radius = collider.radius,
             .b = collider.b,
             .follows = toGpu(collider.follows)});
    return capsules;
}

std::string pointerTo(std::size_t field) {
    return "/simulation/distance_fields/" + std::to_string(field);
}

std::vector<DistanceField> bake(
    const engine::Device& device, const SimulationSettings& settings,
    std::span<const groom::Mesh> meshes, std::span<const BakedField* const> baked) {
    assert(meshes.size() == settings.distance_fields.size());
    assert(baked.empty() || baked.size() == meshes.size());
    std::vector<DistanceField> fields;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (!baked.empty() && baked[i]) {
            fields.emplace_back(device, *baked[i]);
            continue;
        }
        try {
            // Nothing beyond the grid is in contact, not even by rounding.
            fields.emplace_back(
                device, meshes[i], settings.distance_fields[i].resolution,
                1.01f * settings.collision.margin);
        } catch (const engine::Unsupported&) {
            throw;
        } catch (const engine::DeviceLost&) {
            throw;
        } catch (const engine::Error& error) {
            throw engine::Error(pointerTo(i), error.what());
        }
    }
    return fields;
}

std::vector<gpu::BodyField>
fieldsOf(const SimulationSettings& settings, const std::vector<DistanceField>& fields) {
    std::vector<gpu::BodyField> result;
    for (std::size_t i = 0; i < fields.size(); ++i)
        result.push_back(
            {.field = fields[i].parameters(),
             .follows = toGpu(settings.distance_fields[i].follows)});
    return result;
}

}  // namespace

std::uint64_t fieldBytes(std::uint32_t resolution) {
    // Points, plus one cell of padding on either side.
    const std::uint64_t side = std::uint64_t{resolution} + 3;
    return side * side * side * sizeof(float);
}

DistanceField::DistanceField(
    const engine::Device& device, const groom::BodyMesh& mesh, std::uint32_t resolution,
    float padding)
    : warning_(groom::bodyWarning(mesh)) {
    assert(resolution > 0 && padding >= 0.0f);
    const auto& positions =
        std::visit([](const auto& each) -> const auto& { return each.positions; }, mesh);
    parameters_ = gridRound(device, positions, resolution, padding);
    const glm::uvec3 points = parameters_.points;
    const std::size_t bytes = std::size_t{points.x} * points.y * points.z * sizeof(float);
    distances_ = {device, {.size = bytes, .name = "distance field"}};
    parameters_.distances = distances_.address();

    const auto* const open = std::get_if<groom::OpenMesh>(&mesh);
    const BakeSurface surface = open ? BakeSurface(device, openBody(device, *open, parameters_))
                                     : BakeSurface(device, std::get<groom::ClosedMesh>(mesh));
    const engine::ComputePipeline pipeline(
        device,
        {.shader = "simulation/bake_distance.comp", .push_size = sizeof(gpu::BakeDistancePush)});
    const glm::uvec3 blocks = (points + gpu::kBakeBlock - 1u) / gpu::kBakeBlock;
    const std::uint32_t count = blocks.x * blocks.y * blocks.z;
    const engine::Buffer middles(
        device,
        {.size = count * sizeof(gpu::BlockMiddle), .name = "middles of a distance field's blocks"});
    gpu::BakeDistancePush push{
        .field = parameters_,
        .nodes = surface.nodes.address(),
        .triangles = surface.triangles.address(),
        .normals = surface.normals ? surface.normals->address() : 0,
        .middles = middles.address(),
        .sides = surface.sides ? surface.sides->address() : 0,
        .blocks = blocks,
        .first_block = 0,
        .block_count = count,
        .finds_middles = 1,
        .band = padding + kBandCells * parameters_.cell};
    constexpr std::uint32_t kGroup = gpu::kBakeBlock * gpu::kBakeBlock * gpu::kBakeBlock;
    const auto run = [&](std::uint32_t groups) {
        runOnce(device, [&](engine::Commands& commands) {
            commands.bind(pipeline, push);
            commands.dispatchGroups(groups);
            commands.barrier(engine::Access::compute_write, engine::Access::anything);
        });
    };
    run((count + kGroup - 1) / kGroup);
    push.finds_middles = 0;
    engine::Step step("bakes a distance field, block", count);
    for (; push.first_block < count; push.first_block += push.block_count) {
        push.block_count = std::min(kBlocksPerBatch, count - push.first_block);
        run(push.block_count);
        step.advance(push.block_count);
    }
}

DistanceField::DistanceField(const engine::Device& device, const BakedField& baked)
    : parameters_(baked.grid),
      distances_(
          engine::makeBuffer(device, std::span<const float>(baked.distances), "distance field")),
      warning_(baked.warning) {
    parameters_.distances = distances_.address();
}

BakedField DistanceField::read(const engine::Device& device) const {
    BakedField baked{.grid = parameters_, .distances = {}, .warning = warning_};
    baked.grid.distances = 0;
    baked.distances = engine::downloadAs<float>(device, distances_);
    return baked;
}

Bodies::Bodies(
    const engine::Device& device, const SimulationSettings& settings,
    std::span<const groom::Mesh> meshes, std::span<const BakedField* const> baked)
    : distances_(bake(device, settings, meshes, baked)), capsules_(makeCapsules(device, settings)),
      fields_(engine::makeBuffer(
          device, std::span<const gpu::BodyField>(fieldsOf(settings, distances_)),
          "distance fields")),
      margin_(settings.collision.margin), friction_(settings.collision.friction) {}

std::vector<std::string> Bodies::warnings() const {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < distances_.size(); ++i)
        if (const std::string& warning = distances_[i].warning(); !warning.empty())
            warnings.push_back(pointerTo(i) + ": " + warning);
    return warnings;
}

gpu::Bodies Bodies::parametersWith(const Capsules& capsules) const {
    return {
        .capsules = capsules.buffer.address(),
        .fields = fields_.address(),
        .capsule_count = capsules.count,
        .field_count = static_cast<std::uint32_t>(distances_.size()),
        .margin = margin_,
        .friction = friction_};
}

Bodies::Capsules
Bodies::makeCapsules(const engine::Device& device, const SimulationSettings& settings) {
    return {
        .buffer = engine::makeBuffer(
            device, std::span<const gpu::Capsule>(capsulesOf(settings)), "capsules"),
        .count = static_cast<std::uint32_t>(settings.colliders.size())};
}

}  // namespace hair::simulation
