#include "benchmarks/viewer/toolbar.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

// Two guides of two vertices, a head that has turned by 90 degrees about +y and moved, and hair
// that hangs lower than at rest.
Shown moved() {
    Shown shown;
    shown.has_guides = true;
    shown.vertices_per_guide = 2;
    shown.rest_guides = {{0, 0, 0}, {0, 0.1f, 0}, {1, 0, 0}, {1, 0.1f, 0}};
    shown.head.rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(0, 1, 0));
    shown.head.translation = {0, 2, 0};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 sagged = shown.rest_guides[i] - glm::vec3(0, i == 3 ? 0.05f : 0.0f, 0);
        shown.guides.push_back(shown.head(sagged));
    }
    return shown;
}

// (x, y, z) turned by 90 degrees about +y is (z, y, -x).
TEST(StrokeTool, BrushesHairWhereItWasAtRest) {
    const Shown shown = moved();
    const glm::vec3 tip{0, 2.05f, -1};  // of the second guide, which sags by 0.05 m
    const RestPlace at_tip(shown, tip + glm::vec3(0, 0.001f, 0));
    EXPECT_LT(glm::distance(at_tip.toRest(tip), {1, 0.1f, 0}), 1e-6f);
    // A point beside it keeps its distance.
    EXPECT_LT(glm::distance(at_tip.toRest({0.02f, 2.05f, -1}), {1, 0.1f, 0.02f}), 1e-6f);

    const RestPlace at_root(shown, {0, 2, 0});
    EXPECT_LT(glm::distance(at_root.toRest({0, 2, 0.01f}), {-0.01f, 0, 0}), 1e-6f);
}

}  // namespace
}  // namespace benchmarks::viewer
