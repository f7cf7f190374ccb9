#include "hair/simulation/bodies.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "engine/transfer.h"
#include "hair/groom/mesh/winding_number.h"
#include "hair/simulation/stiffness.h"

namespace hair::simulation {

// ---- Fields of open meshes ----------------------------------------------------------------------

namespace {

using groom::WindingNumber;

constexpr engine::Purpose kBodiesPurpose("simulation");

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
    const engine::Buffer node_buffer =
        engine::makeBuffer(device, nodes, "distance field dipoles", kBodiesPurpose);
    const engine::Buffer triangles =
        engine::makeBuffer(device, corners, "distance field triangles", kBodiesPurpose);
    const glm::uvec3 points = grid.points;
    const std::size_t bytes = std::size_t{points.x} * points.y * points.z * sizeof(float);
    const engine::Buffer windings(
        device,
        {.size = bytes, .name = "distance field winding numbers", .purpose = kBodiesPurpose});
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

// ---- Bodies -------------------------------------------------------------------------------------

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
    return engine::makeBuffer(device, values, name, kBodiesPurpose);
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
        sides = makeBuffer(device, body.sides, "distance field sides");
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
    distances_ = {device, {.size = bytes, .name = "distance field", .purpose = kBodiesPurpose}};
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
        device, {.size = count * sizeof(gpu::BlockMiddle),
                 .name = "distance field block middles",
                 .purpose = kBodiesPurpose});
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
      distances_(engine::makeBuffer(device, baked.distances, "distance field", kBodiesPurpose)),
      warning_(baked.warning) {
    parameters_.distances = distances_.address();
}

BakedField DistanceField::read(const engine::Device& device) const {
    BakedField baked{.grid = parameters_, .distances = {}, .warning = warning_};
    baked.grid.distances = 0;
    baked.distances = engine::downloadAs<float>(device, distances_);
    return baked;
}

engine::MemoryRows Bodies::rows(const SimulationSettings& settings) {
    engine::MemoryRows rows(
        kBodiesPurpose,
        {{"capsules", engine::bytesOf<gpu::Capsule>(settings.colliders.size())},
         {"distance fields", engine::bytesOf<gpu::BodyField>(settings.distance_fields.size())}});
    for (const DistanceFieldSettings& field : settings.distance_fields) {
        // Points, plus one cell of padding on either side.
        const std::uint64_t side = std::uint64_t{field.resolution} + 3;
        rows.add(
            kBodiesPurpose, {{.name = "distance field",
                              .size = engine::bytesOf<float>(side * side * side),
                              .at_most = true}});
    }
    return rows;
}

Bodies::Bodies(
    const engine::Device& device, const SimulationSettings& settings,
    std::span<const groom::Mesh> meshes, std::span<const BakedField* const> baked)
    : distances_(bake(device, settings, meshes, baked)), capsules_(makeCapsules(device, settings)),
      fields_(engine::makeBuffer(
          device, fieldsOf(settings, distances_), rows(settings), "distance fields")),
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
        .buffer = engine::makeBuffer(device, capsulesOf(settings), rows(settings), "capsules"),
        .count = static_cast<std::uint32_t>(settings.colliders.size())};
}

// ---- Segments -----------------------------------------------------------------------------------

namespace {

using engine::Access;

static_assert(sizeof(gpu::SegmentPush) == 76 && offsetof(gpu::SegmentPush, frame_before) == 44);

}  // namespace

SegmentPass::SegmentPass(
    const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
    const SimulationSettings& settings)
    : strand_count_(strand_count), keeps_rest_(settings.rest == RestShape::balanced ? 1 : 0),
      starts_(device, rows(std::uint64_t{strand_count} * vertices_per_strand)["guide starts"]),
      pipeline_(
          device, {.shader = "simulation/segments.comp",
                   .constants = {{gpu::kSegmentVerticesConstant, vertices_per_strand}},
                   .push_size = sizeof(gpu::SegmentPush)}) {}

void SegmentPass::recordStart(engine::Commands& commands, const engine::Buffer& positions) const {
    commands.copy(positions, starts_, starts_.size());
}

void SegmentPass::record(
    engine::Commands& commands, const GuideAddresses& guides, const gpu::RigidFrame& frame,
    const gpu::RigidFrame& frame_before) const {
    commands.uses(
        {{guides.positions, Access::compute_write}, {guides.previous, Access::compute_write}});
    commands.bind(
        pipeline_, gpu::SegmentPush{
                       .guides = guides.parameters,
                       .starts = commands.reads(starts_),
                       .frame = frame,
                       .frame_before = frame_before,
                       .keeps_rest = keeps_rest_});
    commands.dispatchInvocations(strand_count_, gpu::kGuideGroupSize);
}

}  // namespace hair::simulation
