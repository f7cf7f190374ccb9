#include "benchmarks/simulated_strands.h"

namespace benchmarks {

hair::StrandSet drawnStrands(const hair::StrandPoints& points) {
    hair::StrandSet set;
    set.metres_per_unit = 1.0;
    const hair::StrandPlan& plan = points.plan;
    const std::size_t most =
        plan.strands() * (std::uint64_t{plan.segments} * plan.forced_tessellation + 1);
    set.ends.reserve(plan.strands());
    set.points.reserve(most);
    set.widths.values.reserve(most);
    for (std::uint32_t triangle = 0; triangle < plan.triangles; ++triangle) {
        for (std::uint32_t strand = 0; strand < plan.forced_density; ++strand) {
            for (std::uint32_t segment = 0; segment < plan.segments; ++segment) {
                // The first point of a segment is the last of the one before.
                for (std::uint32_t i = segment == 0 ? 0 : 1; i <= plan.forced_tessellation; ++i) {
                    const auto& point = points.at(triangle, strand, segment, i);
                    if (point.width < 0.0f) break;
                    set.points.push_back(point.position);
                    set.widths.values.push_back(point.width);
                }
            }
            const auto end = static_cast<std::uint32_t>(set.points.size());
            if (end > (set.ends.empty() ? 0 : set.ends.back())) set.ends.push_back(end);
        }
    }
    return set;
}

hair::StrandSet guideStrands(const hair::Groom& groom, std::vector<glm::vec3> positions) {
    hair::StrandSet set;
    set.metres_per_unit = 1.0;
    set.points = std::move(positions);
    set.root_triangles = groom.root_triangles;
    for (std::uint32_t i = 1; i <= groom.strand_count; ++i)
        set.ends.push_back(i * groom.vertices_per_strand);
    return set;
}

}  // namespace benchmarks
