#include "hair/groom/mesh/deforming_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/error.h"

namespace hair::groom {
namespace {

// Relative to a triangle's squared edges: triangles with a smaller area count as without area.
constexpr double kNoArea = 1e-9;
// Greatest ratio of the mean edge length to that at rest.
constexpr double kMostStretch = 4.0;

// Absent if the triangle has no area.
std::optional<glm::dmat3> triangleFrame(const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 edge = corners[1] - corners[0];
    const glm::dvec3 other = corners[2] - corners[0];
    const glm::dvec3 normal = glm::cross(edge, other);
    const double area = glm::length(normal);
    if (!(area > kNoArea * (glm::dot(edge, edge) + glm::dot(other, other)))) return {};
    const glm::dvec3 along = glm::normalize(edge);
    return glm::dmat3(along, glm::cross(normal / area, along), normal / area);
}

// The smallest rotation that turns one unit vector to another; the identity if they are opposite.
glm::dquat shortestTurn(const glm::dvec3& from, const glm::dvec3& to) {
    const double cosine = glm::dot(from, to);
    if (cosine < -1.0 + 1e-12) return {1.0, 0.0, 0.0, 0.0};
    const glm::dvec3 axis = glm::cross(from, to);
    return glm::normalize(glm::dquat(1.0 + cosine, axis.x, axis.y, axis.z));
}

// A triangle's edges from its first corner, along the first two axes of its frame.
glm::dmat2 edgesIn(const glm::dmat3& frame, const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 edge = corners[1] - corners[0];
    const glm::dvec3 other = corners[2] - corners[0];
    return {
        glm::dot(edge, frame[0]), glm::dot(edge, frame[1]),  //
        glm::dot(other, frame[0]), glm::dot(other, frame[1])};
}

template <class Vector>
std::array<glm::dvec3, 3>
cornersAt(const std::array<std::uint32_t, 3>& corners, std::span<const Vector> positions) {
    return {
        glm::dvec3(positions[corners[0]]), glm::dvec3(positions[corners[1]]),
        glm::dvec3(positions[corners[2]])};
}

double meanEdge(
    std::span<const std::array<std::uint32_t, 3>> triangles,
    std::span<const glm::dvec3> positions) {
    double sum = 0.0;
    for (const auto& corners : triangles)
        sum += glm::distance(positions[corners[0]], positions[corners[1]]);
    return sum / static_cast<double>(triangles.size());
}

}  // namespace

// With U the edges at rest and V those now, each in the axes of its own triangle, V = F U. The
// rotation in the plane that is nearest to F turns by atan2(F10 - F01, F00 + F11).
SurfaceMotion motionOf(const SurfaceBinding& binding, const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 carried = binding.weights.x * corners[0] + binding.weights.y * corners[1] +
                               binding.weights.z * corners[2];
    SurfaceMotion motion;
    if (const std::optional<glm::dmat3> frame = triangleFrame(corners)) {
        const glm::dmat2 change = edgesIn(*frame, corners) * glm::inverse(binding.edges);
        const double angle = std::atan2(change[0][1] - change[1][0], change[0][0] + change[1][1]);
        const glm::dmat3 in_plane(
            std::cos(angle), std::sin(angle), 0.0,  //
            -std::sin(angle), std::cos(angle), 0.0,  //
            0.0, 0.0, 1.0);
        motion.rotation =
            glm::normalize(glm::quat_cast(*frame * in_plane * glm::transpose(binding.frame)));
    }
    motion.translation = carried - motion.rotation * binding.nearest;
    return motion;
}

SurfaceMotion
meanMotion(std::span<const SurfaceMotion> motions, std::span<const glm::vec3> points) {
    assert(!motions.empty() && motions.size() == points.size());
    glm::dquat sum(0.0, 0.0, 0.0, 0.0);
    glm::dvec3 from(0.0), to(0.0);
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const glm::dquat& rotation = motions[i].rotation;
        sum = sum + (glm::dot(rotation, motions.front().rotation) < 0.0 ? -rotation : rotation);
        from += glm::dvec3(points[i]);
        to += motions[i](glm::dvec3(points[i]));
    }
    const auto count = static_cast<double>(motions.size());
    SurfaceMotion mean{.rotation = motions.front().rotation};
    if (glm::length(sum) > 1e-6 * count) mean.rotation = glm::normalize(sum);
    mean.translation = to / count - mean.rotation * (from / count);
    return mean;
}

DeformingMesh::DeformingMesh(
    const Mesh& mesh, MeshAnimation animation, const AnimationSettings& settings)
    : animation_(std::move(animation)), speed_(double{settings.speed}), repeats_(settings.repeat),
      rest_(mesh.positions), normals_(mesh.normals), triangles_(mesh.triangles) {
    if (animation_.vertexCount() != rest_.size())
        throw engine::Error(
            "the animation has " + std::to_string(animation_.vertexCount()) +
            " vertices, but the mesh " + std::to_string(rest_.size()));
    std::map<std::tuple<float, float, float>, std::uint32_t> places;
    for (std::uint32_t i = 0; i < rest_.size(); ++i)
        joined_.push_back(
            places.try_emplace({rest_[i].x, rest_[i].y, rest_[i].z}, i).first->second);
    const std::vector<glm::dvec3> rest(rest_.begin(), rest_.end());
    facing(rest, facing_);
    const double stretch = meanEdge(triangles_, positions(0.0)) / meanEdge(triangles_, rest);
    if (!(stretch < kMostStretch && stretch > 1.0 / kMostStretch)) {
        std::ostringstream reason;
        reason << "the animation makes the mesh " << stretch
               << " times as large as its nodes do: its skin and its nodes differ in scale";
        throw engine::Error(reason.str());
    }
}

std::vector<SurfaceBinding> DeformingMesh::bind(std::span<const glm::vec3> points) const {
    std::vector<std::array<std::uint32_t, 3>> with_area;
    for (const auto& triangle : triangles_)
        if (triangleFrame(cornersAt<glm::vec3>(triangle, rest_))) with_area.push_back(triangle);
    if (with_area.empty()) throw engine::Error("no triangle of the mesh has an area");
    const NearestSurface nearest(rest_, with_area);
    std::vector<SurfaceBinding> bindings;
    bindings.reserve(points.size());
    for (const glm::vec3& point : points) {
        const MeshPoint found = nearest(glm::dvec3(point));
        const auto corners = cornersAt<glm::vec3>(with_area[found.triangle], rest_);
        const glm::dmat3 frame = *triangleFrame(corners);
        bindings.push_back(
            {.corners = with_area[found.triangle],
             .weights = found.weights,
             .nearest = found.position,
             .frame = frame,
             .edges = edgesIn(frame, corners)});
    }
    return bindings;
}

void DeformingMesh::motions(
    std::span<const SurfaceBinding> bindings, double time, Scratch& scratch,
    std::vector<SurfaceMotion>& motions) const {
    animation_.poseAt(clipTime(time), scratch.pose);
    motions.clear();
    motions.reserve(bindings.size());
    for (const SurfaceBinding& binding : bindings) {
        std::array<glm::dvec3, 3> corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = animation_.position(scratch.pose, binding.corners[i]);
        motions.push_back(motionOf(binding, corners));
    }
}

std::vector<SurfaceMotion>
DeformingMesh::motions(std::span<const SurfaceBinding> bindings, double time) const {
    Scratch scratch;
    std::vector<SurfaceMotion> found;
    motions(bindings, time, scratch, found);
    return found;
}

void DeformingMesh::positions(
    double time, Scratch& scratch, std::vector<glm::dvec3>& positions) const {
    animation_.poseAt(clipTime(time), scratch.pose);
    animation_.positions(scratch.pose, positions);
}

std::vector<glm::dvec3> DeformingMesh::positions(double time) const {
    Scratch scratch;
    std::vector<glm::dvec3> found;
    positions(time, scratch, found);
    return found;
}

void DeformingMesh::normals(
    std::span<const glm::dvec3> positions, Scratch& scratch,
    std::vector<glm::vec3>& normals) const {
    facing(positions, scratch.facing);
    normals.clear();
    normals.reserve(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dquat turn = shortestTurn(facing_[i], scratch.facing[i]);
        normals.emplace_back(glm::normalize(turn * glm::dvec3(normals_[i])));
    }
}

std::vector<glm::vec3> DeformingMesh::normals(std::span<const glm::dvec3> positions) const {
    Scratch scratch;
    std::vector<glm::vec3> found;
    normals(positions, scratch, found);
    return found;
}

double DeformingMesh::period() const { return speed_ > 0.0 ? animation_.duration() / speed_ : 0.0; }

double DeformingMesh::clipTime(double time) const {
    const double duration = animation_.duration();
    const double played = speed_ * time;
    if (!repeats_ || duration <= 0.0 || played <= duration) return std::min(played, duration);
    return std::fmod(played, duration);
}

// Finds the directions that the surface faces at every vertex: the sum of the normals of the
// triangles at its place, weighted by area. Vertices without triangles face up. Unit length.
void DeformingMesh::facing(
    std::span<const glm::dvec3> positions, std::vector<glm::dvec3>& sums) const {
    sums.assign(positions.size(), glm::dvec3(0.0));
    for (const auto& triangle : triangles_) {
        const auto corners = cornersAt(triangle, positions);
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        for (const std::uint32_t vertex : triangle) sums[joined_[vertex]] += normal;
    }
    for (glm::dvec3& sum : sums) {
        const double length = glm::length(sum);
        sum = length > 0.0 ? sum / length : glm::dvec3(0.0, 1.0, 0.0);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sums[joined_[i]];
}

}  // namespace hair::groom
