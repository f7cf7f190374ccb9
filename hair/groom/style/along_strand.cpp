#include "hair/groom/style/along_strand.h"

#include <glm/geometric.hpp>

namespace hair {

AlongStrand::AlongStrand(std::span<const glm::vec3> points) : arcs_(points.size(), 0.0) {
    for (std::size_t i = 1; i < points.size(); ++i)
        arcs_[i] = arcs_[i - 1] + glm::distance(glm::dvec3(points[i - 1]), glm::dvec3(points[i]));
}

}  // namespace hair
