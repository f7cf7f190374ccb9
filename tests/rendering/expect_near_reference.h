#pragma once

#include <gtest/gtest.h>

#include "hair/rendering/renderer.h"
#include "tests/rendering/strand_reference.h"

namespace hair::rendering {

// Compares all points with the reference. Guides within 0.5 m have control points within 1.5 m.
// The sums of weights and of slopes are at most 2 (of Catmull and Rom's slopes 3), and a point
// takes about 20 roundings of 2^-24 of that.
inline void expectNearReference(
    const StrandPoints& points, const groom::Groom& groom, const Settings& settings,
    const std::vector<bool>& contacts = {}) {
    const double sum = settings.strands.curve == Curve::catmull_rom ? 3.0 : 2.0;
    const double tolerance = 20 * 0x1p-24 * 1.5 * sum;
    const StrandPlan& plan = points.plan;
    ASSERT_EQ(plan.triangles, groom.root_triangles.size());
    ASSERT_EQ(
        points.records.size(), plan.strands() * plan.segments * (plan.forced_tessellation + 1));
    std::size_t index = 0;
    for (std::uint32_t triangle = 0; triangle < plan.triangles; ++triangle) {
        for (std::uint32_t strand = 0; strand < plan.forced_density; ++strand) {
            for (std::uint32_t segment = 0; segment < plan.segments; ++segment) {
                for (std::uint32_t i = 0; i <= plan.forced_tessellation; ++i) {
                    SCOPED_TRACE(index);
                    const auto& record = points.records[index++];
                    const reference::Point expected = reference::pointOnStrand(
                        groom, settings, triangle, strand, segment,
                        static_cast<double>(i) / plan.forced_tessellation, contacts);
                    ASSERT_LT(
                        glm::distance(glm::dvec3(record.position), expected.position), tolerance);
                    ASSERT_LT(
                        glm::distance(glm::dvec3(record.tangent), expected.tangent), tolerance);
                    ASSERT_NEAR(record.width, expected.width, 1e-6 * expected.width);
                    ASSERT_NEAR(record.along, expected.along, 1e-6);
                }
            }
        }
    }
}

}  // namespace hair::rendering
