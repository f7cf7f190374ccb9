#include "hair/simulation/open_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/error.h"
#include "engine/pipeline.h"
#include "engine/process.h"
#include "engine/transfer.h"
#include "hair/groom/mesh/winding_number.h"

namespace hair::simulation {
namespace {

using groom::WindingNumber;

// ---- Winding numbers ----------------------------------------------------------------------------

static_assert(sizeof(gpu::WindingNode) == 96 && offsetof(gpu::WindingNode, octupole) == 56);
static_assert(sizeof(gpu::WindingTriangle) == 36);
static_assert(sizeof(gpu::BakeWindingPush) == 72 && offsetof(gpu::BakeWindingPush, nodes) == 48);

// One submission of this size takes less than a second on lavapipe. Drivers abort submissions that
// take a few seconds.
constexpr std::uint32_t kWindingBlocks = 1024;

std::vector<gpu::WindingNode> nodesOf(const WindingNumber& winding) {
    const auto overSphere = [](double moment) {
        return static_cast<float>(moment / (4.0 * std::numbers::pi));
    };
    std::vector<gpu::WindingNode> nodes;
    nodes.reserve(winding.multipoles().size());
    for (std::size_t i = 0; i < winding.multipoles().size(); ++i) {
        const groom::Multipole& moments = winding.multipoles()[i];
        const groom::TriangleBvh::Node& from = winding.tree().nodes[i];
        gpu::WindingNode& node = nodes.emplace_back();
        node.centre = glm::vec3(moments.centre);
        node.reach = static_cast<float>(WindingNumber::kReach * moments.radius);
        node.first = from.first;
        node.count = from.count;
        node.dipole = glm::vec3(moments.dipole / (4.0 * std::numbers::pi));
        std::ranges::transform(moments.quadrupole, node.quadrupole, overSphere);
        std::ranges::transform(moments.octupole, node.octupole, overSphere);
    }
    return nodes;
}

// Returns the winding numbers at the grid points, [z][y][x].
std::vector<float> windingsAt(
    const engine::Device& device, const WindingNumber& winding, const gpu::DistanceField& grid) {
    std::vector<gpu::WindingTriangle> corners;
    corners.reserve(winding.corners().size());
    for (const auto& triangle : winding.corners())
        std::ranges::copy(triangle, corners.emplace_back().corners);
    const auto nodes = nodesOf(winding);
    const engine::Buffer node_buffer = engine::makeBuffer(
        device, std::span<const gpu::WindingNode>(nodes), "distance field dipoles");
    const engine::Buffer triangles = engine::makeBuffer(
        device, std::span<const gpu::WindingTriangle>(corners), "distance field triangles");
    const glm::uvec3 points = grid.points;
    const std::size_t bytes = std::size_t{points.x} * points.y * points.z * sizeof(float);
    const engine::Buffer windings(
        device, {.size = bytes, .name = "distance field winding numbers"});
    const engine::ComputePipeline pipeline(
        device,
        {.shader = "simulation/bake_winding.comp", .push_size = sizeof(gpu::BakeWindingPush)});
    const glm::uvec3 blocks = (points + gpu::kBakeBlock - 1u) / gpu::kBakeBlock;
    const std::uint32_t count = blocks.x * blocks.y * blocks.z;
    gpu::BakeWindingPush push{
        .origin = grid.origin,
        .cell = grid.cell,
        .points = points,
        .first_block = 0,
        .blocks = blocks,
        .block_count = 0,
        .nodes = node_buffer.address(),
        .triangles = triangles.address(),
        .windings = windings.address()};
    engine::Step step("finds the inside of an open mesh, block", count);
    for (; push.first_block < count; push.first_block += push.block_count) {
        push.block_count = std::min(kWindingBlocks, count - push.first_block);
        runOnce(device, [&](engine::Commands& commands) {
            commands.bind(pipeline, push);
            commands.dispatchGroups(push.block_count);
            commands.barrier(engine::Access::compute_write, engine::Access::anything);
        });
        step.advance(push.block_count);
    }
    return engine::downloadAs<float>(device, windings);
}

// ---- Sides --------------------------------------------------------------------------------------

glm::dvec3 positionOf(const gpu::DistanceField& grid, std::size_t index) {
    const std::size_t row = grid.points.x, rows = grid.points.y;
    return glm::dvec3(grid.origin) +
           double{grid.cell} * glm::dvec3(index % row, index / row % rows, index / row / rows);
}

struct MeshBox {
    glm::dvec3 low, high;

    explicit MeshBox(const WindingNumber& winding)
        : low(winding.tree().nodes.front().low), high(winding.tree().nodes.front().high) {}

    bool isInside(const glm::dvec3& p, double winding) const {
        return winding >= 0.5 && glm::all(glm::greaterThanEqual(p, low)) &&
               glm::all(glm::lessThanEqual(p, high));
    }
};

std::vector<float> sidesOf(
    const WindingNumber& winding, const gpu::DistanceField& grid, std::span<const float> windings) {
    const MeshBox box(winding);
    std::vector<float> sides;
    sides.reserve(windings.size());
    for (std::size_t i = 0; i < windings.size(); ++i)
        sides.push_back(box.isInside(positionOf(grid, i), double{windings[i]}) ? -1.0f : 1.0f);
    return sides;
}

// ---- Caps ---------------------------------------------------------------------------------------

// The surface where winding numbers go through 1/2 without a triangle. Marching tetrahedra (Doi and
// Koide 1991, An efficient method of triangulating equi-valued surfaces by using tetrahedral cells)
// in cells that are cut into six round a diagonal (Kuhn 1960), so that neighbours agree.
class Caps {
public:
    // `windings`: at the grid points. Adds triangles to `body`, which must have its sides. Borrows
    // all arguments.
    Caps(
        const WindingNumber& winding, const gpu::DistanceField& grid,
        std::span<const float> windings, OpenBody& body)
        : winding_(winding), box_(winding), grid_(grid), windings_(windings), body_(body) {}

    void add() {
        const glm::uvec3 points = grid_.points;
        for (std::uint32_t z = 0; z + 1 < points.z; ++z)
            for (std::uint32_t y = 0; y + 1 < points.y; ++y)
                for (std::uint32_t x = 0; x + 1 < points.x; ++x)
                    addCell(x + std::size_t{points.x} * (y + std::size_t{points.y} * z));
    }

private:
    // The two ends of an edge: a grid point, and another point of its cell by one bit per axis.
    struct Edge {
        std::size_t from, to;
        std::uint32_t axes;
    };

    std::size_t neighbour(std::size_t index, std::uint32_t axes) const {
        const std::size_t row = grid_.points.x;
        return index + (axes & 1u) + row * (axes >> 1 & 1u) +
               row * grid_.points.y * (axes >> 2 & 1u);
    }

    bool isInside(std::size_t index) const { return body_.sides[index] < 0.0f; }

    void addCell(std::size_t corner) {
        const bool inside = isInside(corner);
        bool mixed = false;
        for (std::uint32_t axes = 1; axes < 8; ++axes)
            mixed |= isInside(neighbour(corner, axes)) != inside;
        if (!mixed) return;
        constexpr std::array<std::array<std::uint32_t, 2>, 6> kWays{
            {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}}};
        for (const auto& [second, third] : kWays) addTetrahedron(corner, {0, second, third, 7});
    }

    // Each corner's axes contain those of the corner before.
    void addTetrahedron(std::size_t corner, const std::array<std::uint32_t, 4>& axes) {
        std::array<std::uint32_t, 4> in{}, out{};
        std::size_t in_count = 0, out_count = 0;
        for (const std::uint32_t each : axes) {
            if (isInside(neighbour(corner, each)))
                in[in_count++] = each;
            else
                out[out_count++] = each;
        }
        if (in_count == 0 || out_count == 0) return;
        const auto edge = [&](std::uint32_t a, std::uint32_t b) {
            const std::uint32_t low = std::min(a, b);  // contained in the other
            return Edge{
                neighbour(corner, low), neighbour(corner, std::max(a, b)), std::max(a, b) - low};
        };
        std::array<Edge, 4> crossed{};
        if (in_count == 2) {  // in order round the quadrilateral
            crossed = {
                edge(in[0], out[0]), edge(in[0], out[1]), edge(in[1], out[1]), edge(in[1], out[0])};
        } else {
            for (std::size_t i = 0; i < 3; ++i)
                crossed[i] = in_count == 1 ? edge(in[0], out[i]) : edge(in[i], out[0]);
        }
        const auto all = std::span(crossed).first(in_count == 2 ? 4 : 3);
        if (std::ranges::none_of(all, [&](const Edge& each) { return isSmooth(each); })) return;
        addTriangle({vertex(crossed[0]), vertex(crossed[1]), vertex(crossed[2])});
        if (in_count == 2)
            addTriangle({vertex(crossed[0]), vertex(crossed[2]), vertex(crossed[3])});
    }

    // Whether no triangle lies between the ends. Through a triangle, winding numbers jump by 1.
    // Next to its rim they change by the edge's turn round the rim, which is less than half a turn:
    // 1/2.
    bool isSmooth(const Edge& edge) const {
        return std::abs(windings_[edge.from] - windings_[edge.to]) < 0.5f;
    }

    // Returns the index of the vertex where an edge crosses the surface.
    std::uint32_t vertex(const Edge& edge) {
        const auto [at, is_new] = vertices_.try_emplace(
            std::uint64_t{edge.from} * 8 + edge.axes,
            static_cast<std::uint32_t>(body_.positions.size()));
        if (is_new) body_.positions.push_back(glm::vec3(crossing(edge)));
        return at->second;
    }

    // Finds the crossing by bisection, to 1/256 of the edge.
    glm::dvec3 crossing(const Edge& edge) const {
        glm::dvec3 inside = positionOf(grid_, edge.from);
        glm::dvec3 outside = positionOf(grid_, edge.to);
        if (!isInside(edge.from)) std::swap(inside, outside);
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 middle = (inside + outside) / 2.0;
            (box_.isInside(middle, winding_(middle)) ? inside : outside) = middle;
        }
        return (inside + outside) / 2.0;
    }

    void addTriangle(const std::array<std::uint32_t, 3>& triangle) {
        const auto at = [&](std::size_t i) { return glm::dvec3(body_.positions[triangle[i]]); };
        if (glm::cross(at(1) - at(0), at(2) - at(0)) != glm::dvec3(0.0))
            body_.triangles.push_back(triangle);
    }

    const WindingNumber& winding_;
    MeshBox box_;
    const gpu::DistanceField& grid_;
    std::span<const float> windings_;
    OpenBody& body_;
    std::unordered_map<std::uint64_t, std::uint32_t> vertices_;  // by edge
};

}  // namespace

OpenBody makeOpenBody(
    const engine::Device& device, const groom::OpenMesh& mesh, const gpu::DistanceField& grid) {
    const WindingNumber winding(mesh.positions, mesh.triangles);
    const std::vector<float> windings = windingsAt(device, winding, grid);
    OpenBody body{
        .sides = sidesOf(winding, grid, windings), .positions = mesh.positions, .triangles = {}};
    if (std::ranges::find(body.sides, -1.0f) == body.sides.end()) {
        std::ostringstream reason;
        reason << "the winding number there is at most " << std::ranges::max(windings)
               << ", and a point is inside if it is 1/2 or more; raise /resolution, or close "
                  "more of the mesh";
        throw engine::Error("no point of the grid is inside the surface", reason.str());
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (!mesh.inner[i]) body.triangles.push_back(mesh.triangles[i]);
    Caps(winding, grid, windings, body).add();
    return body;
}

}  // namespace hair::simulation
