#include "hair/groom/style/strand_frames.h"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace hair {
namespace {

constexpr double kParallel = 1e-3;  // sine of the angle below which two directions span no plane

glm::dvec3 perpendicularPart(const glm::dvec3& vector, const glm::dvec3& unit) {
    return vector - glm::dot(vector, unit) * unit;
}

// One for each point: of the chord between its neighbours, or, where those coincide, of the segment
// before.
std::vector<glm::dvec3> tangents(std::span<const glm::vec3> points) {
    std::vector<glm::dvec3> tangents(points.size());
    glm::dvec3 last = rootDirection(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 before(points[i == 0 ? 0 : i - 1]);
        const glm::dvec3 after(points[i + 1 == points.size() ? i : i + 1]);
        const double length = glm::distance(before, after);
        if (length > 0.0) last = (after - before) / length;
        tangents[i] = last;
    }
    return tangents;
}

glm::dvec3 rootNormal(
    std::span<const glm::vec3> points, const glm::dvec3& tangent, const glm::vec3* root_normal) {
    if (root_normal) {
        const glm::dvec3 part = perpendicularPart(glm::dvec3(*root_normal), tangent);
        if (glm::length(part) > kParallel) return glm::normalize(part);
    }
    glm::dvec3 furthest(0.0);
    double reach = 0.0;
    for (const glm::vec3& point : points) {
        const glm::dvec3 from_root = glm::dvec3(point) - glm::dvec3(points.front());
        const glm::dvec3 part = perpendicularPart(from_root, tangent);
        if (glm::length(part) > glm::length(furthest)) furthest = part;
        reach = std::max(reach, glm::length(from_root));
    }
    if (glm::length(furthest) > kParallel * reach) return glm::normalize(furthest);
    return across(tangent);
}

glm::dvec3 reflect(const glm::dvec3& vector, const glm::dvec3& along, double along_squared) {
    return vector - 2.0 / along_squared * glm::dot(along, vector) * along;
}

// The normal at the next point, from that at this one.
glm::dvec3
carried(const StrandFrame& frame, const glm::dvec3& step, const glm::dvec3& next_tangent) {
    glm::dvec3 normal = frame.normal;
    glm::dvec3 tangent = frame.tangent;
    if (const double squared = glm::dot(step, step); squared > 0.0) {
        normal = reflect(normal, step, squared);
        tangent = reflect(tangent, step, squared);
    }
    const glm::dvec3 turn = next_tangent - tangent;
    if (const double squared = glm::dot(turn, turn); squared > 1e-20)
        normal = reflect(normal, turn, squared);
    normal = perpendicularPart(normal, next_tangent);  // of rounding alone
    const double length = glm::length(normal);
    return length > kParallel ? normal / length : across(next_tangent);
}

}  // namespace

glm::dvec3 rootDirection(std::span<const glm::vec3> points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 step = glm::dvec3(points[i]) - glm::dvec3(points[i - 1]);
        if (const double length = glm::length(step); length > 0.0) return step / length;
    }
    return {0.0, 0.0, 1.0};
}

glm::dvec3 across(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    glm::dvec3 axis(0.0);
    axis[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1.0;
    return glm::normalize(glm::cross(direction, axis));
}

std::vector<StrandFrame>
strandFrames(std::span<const glm::vec3> points, const glm::vec3* root_normal) {
    assert(!points.empty());
    const std::vector<glm::dvec3> directions = tangents(points);
    std::vector<StrandFrame> frames(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 normal =
            i == 0 ? rootNormal(points, directions.front(), root_normal)
                   : carried(
                         frames[i - 1], glm::dvec3(points[i]) - glm::dvec3(points[i - 1]),
                         directions[i]);
        frames[i] = {directions[i], normal, glm::cross(directions[i], normal)};
    }
    return frames;
}

}  // namespace hair
