#include "hair/groom/mesh/body_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "engine/error.h"
#include "hair/groom/mesh/winding_number.h"

namespace hair::groom {
namespace {

using Face = std::array<std::uint32_t, 3>;
using FacePoints = std::array<glm::dvec3, 3>;

FacePoints pointsOfFace(const std::vector<glm::vec3>& positions, const Face& triangle) {
    return {
        glm::dvec3(positions[triangle[0]]), glm::dvec3(positions[triangle[1]]),
        glm::dvec3(positions[triangle[2]])};
}

// ---- Triangles that cross -----------------------------------------------------------------------

// Six times the signed volume of a tetrahedron.
double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

// Whether a segment crosses a triangle, if the segment's ends are on either side of its plane.
bool crosses(const glm::dvec3& from, const glm::dvec3& to, const FacePoints& triangle) {
    const double ab = volume(from, to, triangle[0], triangle[1]);
    const double bc = volume(from, to, triangle[1], triangle[2]);
    const double ca = volume(from, to, triangle[2], triangle[0]);
    return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

// Whether an edge of `other` goes through `triangle`.
bool intersects(const FacePoints& other, const FacePoints& triangle) {
    std::array<double, 3> heights;
    for (std::size_t i = 0; i < 3; ++i)
        heights[i] = volume(triangle[0], triangle[1], triangle[2], other[i]);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (heights[i] * heights[next] < 0.0 && crosses(other[i], other[next], triangle))
            return true;
    }
    return false;
}

bool contains(const auto& values, const auto& value) {
    return std::ranges::find(values, value) != values.end();
}

struct Bounds {
    glm::vec3 low, high;

    bool overlaps(const glm::vec3& other_low, const glm::vec3& other_high) const {
        return glm::all(glm::lessThanEqual(other_low, high)) &&
               glm::all(glm::greaterThanEqual(other_high, low));
    }
};

bool shareACorner(const Face& a, const Face& b) {
    return std::ranges::any_of(a, [&](std::uint32_t corner) { return contains(b, corner); });
}

// [triangle]: whether a triangle without a common corner goes through it.
std::vector<bool> intersectingTriangles(
    const std::vector<glm::vec3>& positions, const std::vector<Face>& triangles,
    const TriangleBvh& tree) {
    std::vector<Bounds> bounds;  // [slot in the leaves]
    bounds.reserve(triangles.size());
    for (const std::uint32_t triangle : tree.order) {
        const auto& [a, b, c] = triangles[triangle];
        bounds.push_back(
            {glm::min(glm::min(positions[a], positions[b]), positions[c]),
             glm::max(glm::max(positions[a], positions[b]), positions[c])});
    }
    std::vector<bool> crossed(triangles.size());
    const auto compare = [&](std::uint32_t one_slot, std::uint32_t two_slot) {
        if (!bounds[one_slot].overlaps(bounds[two_slot].low, bounds[two_slot].high)) return;
        const std::uint32_t one = tree.order[one_slot], two = tree.order[two_slot];
        if (shareACorner(triangles[one], triangles[two])) return;
        const FacePoints a = pointsOfFace(positions, triangles[one]);
        const FacePoints b = pointsOfFace(positions, triangles[two]);
        if (intersects(a, b) || intersects(b, a)) crossed[one] = crossed[two] = true;
    };
    std::vector<std::uint32_t> stack;
    for (const TriangleBvh::Node& leaf : tree.nodes) {
        if (leaf.count == 0) continue;
        const Bounds box{leaf.low, leaf.high};
        stack.assign(1, 0);
        while (!stack.empty()) {
            const TriangleBvh::Node& node = tree.nodes[stack.back()];
            stack.pop_back();
            if (!box.overlaps(node.low, node.high)) continue;
            if (node.count == 0) {
                stack.push_back(node.first);
                stack.push_back(node.first + 1);
                continue;
            }
            for (std::uint32_t one = leaf.first; one < leaf.first + leaf.count; ++one)
                for (std::uint32_t two = std::max(one + 1, node.first);
                     two < node.first + node.count; ++two)
                    compare(one, two);
        }
    }
    return crossed;
}

// ---- Patches ------------------------------------------------------------------------------------

// Disjoint sets of numbers (union-find); at first, each number is a set by itself.
class Joined {
public:
    explicit Joined(std::size_t count) : before_(count) {
        std::iota(before_.begin(), before_.end(), 0u);
    }

    std::uint32_t first(std::uint32_t i) {
        while (before_[i] != i) i = before_[i] = before_[before_[i]];
        return i;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        a = first(a), b = first(b);
        before_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> before_;  // a number of the same set that is no greater
};

// Groups triangles by the set that `setOf` gives for each.
template <class SetOf>
std::vector<std::vector<std::uint32_t>> gather(std::size_t triangles, SetOf&& setOf) {
    std::vector<std::vector<std::uint32_t>> sets;
    std::unordered_map<std::uint32_t, std::size_t> numbers;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const auto [at, is_new] = numbers.try_emplace(setOf(i), sets.size());
        if (is_new) sets.emplace_back();
        sets[at->second].push_back(i);
    }
    return sets;
}

// Returns the connected patches of triangles. `pairs` are the triangles at edges that two triangles
// share.
std::vector<std::vector<std::uint32_t>>
patchesOf(std::size_t triangles, const std::vector<std::array<std::uint32_t, 2>>& pairs) {
    Joined joined(triangles);
    for (const auto& [one, other] : pairs) joined.join(one, other);
    return gather(triangles, [&](std::uint32_t i) { return joined.first(i); });
}

// Returns the parts of triangles that are connected by corners.
std::vector<std::vector<std::uint32_t>> partsOf(const ClosedMesh& mesh) {
    Joined joined(mesh.positions.size());
    for (const auto& [a, b, c] : mesh.triangles) joined.join(a, b), joined.join(b, c);
    return gather(
        mesh.triangles.size(), [&](std::uint32_t i) { return joined.first(mesh.triangles[i][0]); });
}

// ---- Winding numbers on either side -------------------------------------------------------------

struct Sides {
    double front, behind;  // winding numbers beside the middle of a triangle
};

// Winding numbers beside triangles.
class Beside {
public:
    Beside(const std::vector<glm::vec3>& positions, const std::vector<Face>& triangles)
        : positions_(positions), triangles_(triangles), winding_(positions, triangles) {
        const TriangleBvh::Node& root = tree().nodes.front();
        // Much more than a rounding and much less than a cell of any grid.
        offset_ = 1e-5 * glm::distance(glm::dvec3(root.low), glm::dvec3(root.high));
    }

    const TriangleBvh& tree() const { return winding_.tree(); }

    Sides operator()(std::uint32_t triangle) const {
        const auto [a, b, c] = pointsOfFace(positions_, triangles_[triangle]);
        const glm::dvec3 middle = (a + b + c) / 3.0;
        const glm::dvec3 off = offset_ * glm::normalize(glm::cross(b - a, c - a));
        return {winding_(middle + off), winding_(middle - off)};
    }

    double area(std::uint32_t triangle) const {
        const auto [a, b, c] = pointsOfFace(positions_, triangles_[triangle]);
        return glm::length(glm::cross(b - a, c - a)) / 2.0;
    }

private:
    const std::vector<glm::vec3>& positions_;
    const std::vector<Face>& triangles_;
    WindingNumber winding_;
    double offset_;
};

// Winding numbers on either side of a patch, at some of its triangles.
struct PatchSides {
    double least_front = 1e30;
    double greatest_behind = -1e30;
    double middle = 0.0;  // the mean of both sides, weighted by area
};

// Triangles of a patch that are evaluated at most: winding numbers beside it change only near
// openings.
constexpr std::size_t kMostAsked = 64;

PatchSides sidesOfPatch(const std::vector<std::uint32_t>& patch, const Beside& beside) {
    PatchSides sides;
    double area = 0.0;
    const std::size_t count = std::min(patch.size(), kMostAsked);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t triangle = patch[i * patch.size() / count];
        const auto [front, behind] = beside(triangle);
        sides.least_front = std::min(sides.least_front, front);
        sides.greatest_behind = std::max(sides.greatest_behind, behind);
        sides.middle += beside.area(triangle) * (front + behind) / 2.0;
        area += beside.area(triangle);
    }
    sides.middle /= area;
    return sides;
}

// Bound of the error of winding numbers by multipoles.
constexpr double kSeriesError = 0.01;

// The mean winding number of both sides is about 1/2 for a patch that bounds a body, and about -1/2
// for one that faces inward. A sheet in front of an open mesh may be as low, but not by itself.
constexpr double kFacesInward = -0.25;

bool facesInward(
    const JoinedMesh& mesh, const std::vector<std::uint32_t>& patch, const PatchSides& sides) {
    if (sides.middle >= kFacesInward) return false;
    std::vector<Face> faces;
    for (const std::uint32_t triangle : patch) faces.push_back(mesh.triangles[triangle]);
    std::vector<std::uint32_t> all(patch.size());
    std::iota(all.begin(), all.end(), 0u);
    return sidesOfPatch(all, Beside(mesh.positions, faces)).middle < kFacesInward / 2;
}

constexpr const char* kTurnOutward =
    "; make all normals point outward (in Blender: Mesh, Normals, Recalculate Outside)";

[[noreturn]] void throwInward(const JoinedMesh& mesh, const std::vector<std::uint32_t>& patch) {
    const auto [a, b, c] = pointsOfFace(mesh.positions, mesh.triangles[patch.front()]);
    const glm::dvec3 at = (a + b + c) / 3.0;
    std::ostringstream reason;
    reason << patch.size() << " connected triangles, the first at (" << at.x << ", " << at.y << ", "
           << at.z << ")" << kTurnOutward;
    throw engine::Error("the surface faces inward", reason.str());
}

[[noreturn]] void throwNothingInside(double greatest) {
    std::ostringstream reason;
    reason
        << "its winding number is at most " << greatest
        << ", and a point is inside if it is 1/2 or more; close more of the mesh, or use capsules";
    throw engine::Error("the surface encloses nothing", reason.str());
}

// Describes the faults and their numbers; empty for a closed surface.
std::string
faultsOf(const MeshEdges& edges, std::size_t crossed, std::size_t inner, std::size_t repeated) {
    std::string text = edges.faults;
    const auto add = [&](const char* what, std::size_t count) {
        if (count > 0)
            text += (text.empty() ? "" : "; ") + std::string(what) + ": " + std::to_string(count);
    };
    add("triangles that intersect others", crossed);
    add("triangles with the inside on both sides", inner);
    add("repeated triangles", repeated);
    return text;
}

// ---- Closed meshes ------------------------------------------------------------------------------

// Whether the sign of the nearest triangle is right everywhere: no triangle goes through another,
// and the outside of each part is the outside of all.
bool boundsABody(const ClosedMesh& closed) {
    const TriangleBvh tree = buildTriangleBvh(closed.positions, closed.triangles, 4);
    const std::vector<bool> crossed =
        intersectingTriangles(closed.positions, closed.triangles, tree);
    if (contains(crossed, true)) return false;
    const auto parts = partsOf(closed);
    if (parts.size() == 1) return true;
    const Beside beside(closed.positions, closed.triangles);
    return std::ranges::all_of(parts, [&](const std::vector<std::uint32_t>& part) {
        return std::abs(beside(part.front()).front) < 0.5;
    });
}

// Absent if the mesh is not closed, or is inside out.
std::optional<ClosedMesh> closedMesh(const Mesh& mesh) {
    try {
        return closeMesh(mesh);
    } catch (const engine::Error&) {
        return std::nullopt;
    }
}

}  // namespace

OpenMesh openMesh(const Mesh& mesh) {
    JoinedMesh joined = joinMesh(mesh);
    if (joined.triangles.empty())
        throw engine::Error("the surface encloses nothing", "it has no triangle with an area");
    MeshEdges edges = meshEdges(joined);
    if (edges.opposed > 0)
        throw engine::Error("the surface faces both ways", edges.faults + kTurnOutward);

    const Beside beside(joined.positions, joined.triangles);
    const auto crossed = intersectingTriangles(joined.positions, joined.triangles, beside.tree());
    std::erase_if(
        edges.pairs, [&](const auto& pair) { return crossed[pair[0]] || crossed[pair[1]]; });
    double greatest = -1e30;
    std::size_t inner_count = 0;
    std::vector<bool> inner(joined.triangles.size());
    for (const auto& patch : patchesOf(joined.triangles.size(), edges.pairs)) {
        const PatchSides sides = sidesOfPatch(patch, beside);
        if (facesInward(joined, patch, sides)) throwInward(joined, patch);
        greatest = std::max(greatest, sides.greatest_behind);
        // Only a part of a crossed triangle may be inside.
        if (sides.least_front < 0.5 - 2 * kSeriesError || crossed[patch.front()]) continue;
        for (const std::uint32_t triangle : patch) inner[triangle] = true;
        inner_count += patch.size();
    }
    if (greatest < 0.5 + kSeriesError) throwNothingInside(greatest);
    const auto crossed_count = static_cast<std::size_t>(std::ranges::count(crossed, true));
    return {
        .positions = std::move(joined.positions),
        .triangles = std::move(joined.triangles),
        .inner = std::move(inner),
        .reason = faultsOf(edges, crossed_count, inner_count, joined.repeated)};
}

BodyMesh bodyMesh(const Mesh& mesh) {
    std::optional<ClosedMesh> closed = closedMesh(mesh);
    if (closed && boundsABody(*closed)) return *std::move(closed);
    return openMesh(mesh);
}

std::string bodyWarning(const BodyMesh& mesh) {
    const auto* const open = std::get_if<OpenMesh>(&mesh);
    if (!open) return {};
    return "the surface is not closed: " + open->reason +
           ". A point is inside if its winding number is 1/2 or more: openings are capped";
}

}  // namespace hair::groom
