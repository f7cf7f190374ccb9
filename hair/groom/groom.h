#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

// A strand between guides: at rest, vertex k is the weighted mean of vertex k of the three guides
// plus `offset`.
struct StrandBinding {
    std::array<std::uint32_t, 3> guides{};
    glm::vec3 weights{1.0f, 0.0f, 0.0f};  // sum 1
    glm::vec3 offset{0.0f, 0.0f, 0.0f};   // m; puts the root where the file has it
};

// Guide hairs at rest with the triangles that span them: what import and growth make, and what
// simulation and rendering read. Nothing changes it after it is built.
struct Groom {
    std::uint32_t strand_count = 0;
    std::uint32_t vertices_per_strand = 0;  // V >= 2, the same for every strand
    std::vector<glm::vec3> points;          // [strand][vertex], m, root first
    std::vector<glm::vec3> root_normals;  // [strand], of the scalp, unit length; empty: not known
    std::vector<float> widths;  // [strand][vertex], diameters, m; empty: not known
    std::vector<std::array<std::uint32_t, 3>>
        root_triangles;  // guide indices; strands grow between them
    std::vector<StrandBinding>
        bindings;  // the strands of the file that the guides were chosen from

    std::uint32_t segmentsPerStrand() const { return vertices_per_strand - 1; }
    std::span<const glm::vec3> strand(std::uint32_t index) const {
        return std::span(points).subspan(
            std::size_t{index} * vertices_per_strand, vertices_per_strand);
    }
};

}  // namespace hair
