#include "hair/rendering/strand_bounds.h"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hair {

Sphere strandBounds(const Groom& groom, const StrandSettings& settings) {
    if (groom.strand_count == 0) return {};
    glm::vec3 least(std::numeric_limits<float>::max());
    glm::vec3 most(std::numeric_limits<float>::lowest());
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) {
        least = glm::min(least, groom.strand(i)[0]);
        most = glm::max(most, groom.strand(i)[0]);
    }
    Sphere bounds{.centre = 0.5f * (least + most)};
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) {
        const auto strand = groom.strand(i);
        float reach = glm::distance(bounds.centre, strand[0]);
        for (std::size_t k = 1; k < strand.size(); ++k)
            reach += glm::distance(strand[k - 1], strand[k]);
        bounds.radius = std::max(bounds.radius, reach);
    }
    float beside = settings.curl.radius + settings.variation.amplitude;
    for (const StrandBinding& binding : groom.bindings)
        beside = std::max(beside, glm::length(binding.offset));
    bounds.radius += beside;
    return bounds;
}

}  // namespace hair
