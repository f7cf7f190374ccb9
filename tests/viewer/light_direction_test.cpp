#include "benchmarks/viewer/view_tools.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

using hair::LightType;

const Sphere kGroom{{0.1f, 0.2f, 0.0f}, 0.2f};

// All lengths are a few metres, so 1e-6 is a few float steps.
constexpr float kStep = 2e-6f;

TEST(LightTool, MovesALightRoundTheGroomAtItsDistance) {
    for (const LightType type : {LightType::point, LightType::sphere, LightType::rectangle}) {
        hair::LightSettings light{.type = type, .position = {0.1f, 0.2f, 5.0f}};
        setLightDirection(light, kGroom, {0, 3, 4});
        EXPECT_LT(glm::distance(light.position, {0.1f, 3.2f, 4.0f}), kStep);
        EXPECT_LT(glm::distance(lightDirection(light, kGroom), {0, 0.6f, 0.8f}), kStep);
        EXPECT_NEAR(lightDistance(light, kGroom).value(), 5.0f, kStep);
        // Only a rectangle has a direction.
        const glm::vec3 faces = type == LightType::rectangle ? glm::vec3(0, -0.6f, -0.8f)
                                                             : hair::LightSettings{}.direction;
        EXPECT_LT(glm::distance(light.direction, faces), kStep);
    }
}

TEST(LightTool, TurnsADirectionalLight) {
    hair::LightSettings light{.type = LightType::directional};
    const glm::vec3 position = light.position;
    setLightDirection(light, kGroom, {0, 3, 4});
    EXPECT_LT(glm::distance(light.direction, {0, -0.6f, -0.8f}), kStep);
    EXPECT_EQ(light.position, position);
    EXPECT_FALSE(lightDistance(light, kGroom));
    setLightDistance(light, kGroom, 1.0f);
    EXPECT_EQ(light.position, position);
}

TEST(LightTool, KeepsADirectionWhereThereIsNone) {
    hair::LightSettings light{.position = kGroom.center};
    setLightDirection(light, kGroom, {0, 0, 0});
    EXPECT_EQ(light.position, kGroom.center);
    setLightDistance(light, kGroom, 2.0f);
    EXPECT_NEAR(glm::distance(light.position, kGroom.center), 2.0f, kStep);
}

TEST(LightTool, TurnsTheEnvironmentWithinHalfATurn) {
    hair::RenderSettings render;
    turnEnvironment(render, 100.0f);
    EXPECT_EQ(render.environment_turn, 100.0f);
    turnEnvironment(render, 100.0f);
    EXPECT_EQ(render.environment_turn, -160.0f);
}

}  // namespace
}  // namespace benchmarks::viewer
