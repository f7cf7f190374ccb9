#include "hair/rendering/lod_levels.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "hair/rendering/strand_plan.h"

namespace hair {

double levelAtDistance(const LodSettings& lod, double distance) {
    const double octaves = std::log2(distance / lod.near_distance);
    const double all = std::log2(double{lod.far_distance} / lod.near_distance);
    return lod.maximum_level * std::clamp(octaves / all, 0.0, 1.0);
}

DistanceLod distanceLod(
    const Groom& groom, std::span<const glm::vec3> guides, const StrandView& view,
    const Settings& settings) {
    const auto root = [&](std::uint32_t guide) {
        return glm::dvec3(guides[std::size_t{guide} * groom.vertices_per_strand]);
    };
    const auto levelAt = [&](const glm::dvec3& place) {
        return levelAtDistance(
            settings.lod, glm::distance(place, glm::dvec3(settings.camera.position)));
    };

    DistanceLod result;
    if (settings.strands.source == StrandSource::groom) {
        for (const StrandBinding& binding : groom.bindings) {
            glm::dvec3 place = glm::dmat3(glm::mat3(view.head)) * glm::dvec3(binding.offset);
            for (int i = 0; i < 3; ++i)
                place +=
                    double{binding.weights[i]} * root(binding.guides[static_cast<std::size_t>(i)]);
            result.mean_level += levelAt(place) / static_cast<double>(groom.bindings.size());
        }
        return result;
    }
    const float least = view.greatest_width_scale > 0.0f ? 1.0f / view.greatest_width_scale : 0.0f;
    std::uint64_t strands = 0;
    for (const auto& [a, b, c] : groom.root_triangles) {
        const double level = levelAt((root(a) + root(b) + root(c)) / 3.0);
        result.mean_level += level / static_cast<double>(groom.root_triangles.size());
        const auto scale = static_cast<float>(std::exp2(-level));
        strands += drawnStrands(settings.strands.density, std::max(scale, least));
    }
    result.strands = strands;
    return result;
}

}  // namespace hair
