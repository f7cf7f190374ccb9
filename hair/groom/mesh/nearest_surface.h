#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

// A point of a triangle mesh.
struct MeshPoint {
    glm::dvec3 position{0.0};
    std::uint32_t triangle = 0;
    glm::dvec3 weights{1.0, 0.0, 0.0};  // of the triangle's corners, sum 1, none negative
    double distance = 0.0;              // from where it was asked for
};

// Finds the point of a mesh that is nearest to a point, by a hierarchy of boxes. Borrows nothing.
class NearestSurface {
public:
    // At least one triangle; those without area count too.
    NearestSurface(
        std::span<const glm::vec3> positions,
        std::span<const std::array<std::uint32_t, 3>> triangles);

    MeshPoint operator()(const glm::dvec3& point) const;

private:
    struct Node {
        glm::vec3 low;
        glm::vec3 high;
        std::uint32_t first;  // of its triangles in `corners_`, or of its two children
        std::uint32_t count;  // triangles; 0: an inner node
    };
    std::vector<Node> nodes_;
    std::vector<std::array<glm::vec3, 3>> corners_;  // in the order of the leaves
    std::vector<std::uint32_t> sources_;             // the mesh's triangle of each
};

}  // namespace hair
