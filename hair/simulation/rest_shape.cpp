#include "hair/simulation/rest_shape.h"

#include <cmath>

#include <glm/ext/quaternion_common.hpp>
#include <glm/ext/quaternion_geometric.hpp>
#include <glm/geometric.hpp>

#include "hair/gpu_structs.h"
#include "hair/simulation/rotation_between.h"

namespace hair {

std::vector<glm::vec4> transportedRestEdges(const Groom& groom) {
    std::vector<glm::vec4> edges;
    edges.reserve(groom.points.size());
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const auto points = groom.strand(strand);
        edges.emplace_back(0.0f);
        glm::dquat transport{1.0, 0.0, 0.0, 0.0};  // Q_(i-1) ... Q_2
        glm::dvec3 tangent{0.0, 1.0, 0.0};          // of the last segment that had one
        for (std::uint32_t i = 1; i < groom.vertices_per_strand; ++i) {
            const glm::dvec3 edge = glm::dvec3(points[i]) - glm::dvec3(points[i - 1]);
            const double length = glm::length(edge);
            const glm::dvec3 next =
                length < double{gpu::kShortestSegment} ? tangent : edge / length;
            edges.emplace_back(glm::vec3(glm::conjugate(transport) * edge), length);
            if (i > 1) transport = glm::normalize(rotationBetween(tangent, next) * transport);
            tangent = next;
        }
    }
    return edges;
}

std::vector<double> meanSegmentLengths(const Groom& groom) {
    std::vector<double> means;
    means.reserve(groom.strand_count);
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const auto points = groom.strand(strand);
        double sum = 0.0;
        for (std::uint32_t i = 1; i < groom.vertices_per_strand; ++i)
            sum += glm::length(glm::dvec3(points[i]) - glm::dvec3(points[i - 1]));
        means.push_back(sum / groom.segmentsPerStrand());
    }
    return means;
}

}  // namespace hair
