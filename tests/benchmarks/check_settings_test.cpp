#include "benchmarks/scene/schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/error_text.h"

namespace benchmarks {
namespace {

template <class Change>
std::string broken(Change&& change) {
    hair::Settings settings;
    change(settings);
    return errorText([&] { scene::checkSettings(settings); });
}

TEST(CheckSettings, AcceptsTheDefaults) {
    EXPECT_EQ(broken([](hair::Settings&) {}), "no error");
}

TEST(CheckSettings, WantsPlanesInOrder) {
    EXPECT_EQ(
        broken([](hair::Settings& s) { s.camera.near_plane = s.camera.far_plane; }),
        "/camera/near_plane: is not below /camera/far_plane");
    EXPECT_EQ(
        broken([](hair::Settings& s) { s.lod.near_distance = 9.0f; }),
        "/lod/near_distance: is not below /lod/far_distance");
}

TEST(CheckSettings, WantsFramesWithRoomForTheirSteps) {
    const auto steps = [](float count) {
        return broken([count](hair::Settings& s) {
            s.simulation.time_step = 0.001f;
            s.run.frame_time = count * 0.001f;
        });
    };
    EXPECT_EQ(steps(199.0f), "no error");
    EXPECT_EQ(steps(201.0f), "/run/frame_time: is more than 200 times /simulation/time_step");
}

// Frames of 1/60 s have 1 or 2 steps of 0.01 s, and 0 or 1 of 1/15 s. A step that divides them is
// suggested: 1/120 s, or a whole frame.
TEST(StepWarning, IsOfStepsThatDoNotDivideFrames) {
    const auto warning = [](float step, bool interpolate = false) {
        hair::Settings settings;
        settings.run.frame_time = 1.0f / 60.0f;
        settings.run.interpolate = interpolate;
        settings.simulation.time_step = step;
        return scene::stepWarning(settings);
    };
    EXPECT_THAT(warning(0.01f), testing::HasSubstr("a frame advances by 1 or 2 steps"));
    EXPECT_THAT(
        warning(0.01f), testing::HasSubstr("set /simulation/time_step to 0.008333334 or "
                                           "/run/interpolate to true"));
    EXPECT_THAT(warning(1.0f / 15.0f), testing::HasSubstr("by 0 or 1 steps"));
    EXPECT_THAT(warning(1.0f / 15.0f), testing::HasSubstr("to 0.016666668 or"));
    for (const float step : {1.0f / 60.0f, 1.0f / 120.0f, 1.0f / 240.0f})
        EXPECT_EQ(warning(step), "");
    EXPECT_EQ(warning(0.01f, true), "");
}

TEST(CheckSettings, WantsAPassForBusyWork) {
    const auto busy = [](const char* pass, std::uint32_t work) {
        return broken([&](hair::Settings& s) {
            s.run.busy_pass = pass;
            s.run.busy_work = work;
        });
    };
    EXPECT_EQ(busy("", 1), "/run/busy_work: is above 0, but /run/busy_pass is empty");
    EXPECT_EQ(busy("strands", 1), "no error");
    EXPECT_EQ(busy("strands", 0), "no error");  // a sweep of /run/busy_work may start with this
}

TEST(CheckSettings, WantsCoverageToBeSeen) {
    EXPECT_EQ(
        broken([](hair::Settings& s) { s.render.coverage = hair::Coverage::analytic; }),
        "/render/coverage: is analytic, but /render/transparency is none");
    const auto samples = [](std::uint32_t msaa) {
        return broken([msaa](hair::Settings& s) {
            s.render.coverage = hair::Coverage::analytic;
            s.render.transparency = hair::Transparency::alpha_to_coverage;
            s.render.msaa = msaa;
        });
    };
    EXPECT_EQ(samples(1), "/render/transparency: is alpha_to_coverage, but /render/msaa is 1");
    EXPECT_EQ(samples(2), "no error");
}

TEST(CheckSettings, WantsACameraThatLooksSomewhere) {
    EXPECT_EQ(
        broken([](hair::Settings& s) { s.camera.target = s.camera.position; }),
        "/camera/target: equals /camera/position");
    EXPECT_EQ(
        broken([](hair::Settings& s) { s.camera.up = glm::vec3(0.0f); }), "/camera/up: is zero");
    EXPECT_EQ(
        broken([](hair::Settings& s) { s.camera.up = {0.0f, 0.0f, -0.5f}; }),
        "/camera/up: is parallel to the view");
    EXPECT_EQ(broken([](hair::Settings& s) { s.camera.up = {0.0f, 0.001f, 0.5f}; }), "no error");
}

TEST(CheckSettings, WantsRectanglesToShineSomewhere) {
    EXPECT_EQ(
        broken([](hair::Settings& s) {
            s.shading.lights[0].direction = glm::vec3(0.0f);
            s.shading.lights[0].type = hair::LightType::rectangle;
        }),
        "/shading/lights: entry 0 is a rectangle, but its direction is zero");
}

TEST(CheckSettings, WantsRoomForTheMapsOfLights) {
    const auto spheres = [](std::size_t count) {
        return broken([count](hair::Settings& s) {
            s.shading.lights.assign(count, {.type = hair::LightType::sphere, .shadow_samples = 64});
        });
    };
    EXPECT_EQ(spheres(2), "no error");  // 126 maps
    EXPECT_EQ(
        spheres(3), "/shading/lights: has 189 shadow maps by shadow_samples besides one per light; "
                    "at most 128 are permitted");
}

TEST(CheckSettings, WantsDirectionalLightToGoSomewhere) {
    const auto still = [](hair::Settings& s) { s.shading.lights[0].direction = glm::vec3(0.0f); };
    EXPECT_EQ(broken(still), "no error");
    EXPECT_EQ(
        broken([&](hair::Settings& s) {
            still(s), s.shading.lights[0].type = hair::LightType::directional;
        }),
        "/shading/lights: entry 0 is directional, but its direction is zero");
}

TEST(CheckSettings, WantsWindToBlowSomewhere) {
    const auto calm = [](hair::Settings& s) { s.simulation.wind.direction = glm::vec3(0.0f); };
    EXPECT_EQ(broken(calm), "no error");
    EXPECT_EQ(
        broken([&](hair::Settings& s) { calm(s), s.simulation.wind.strength = 3.0f; }),
        "/simulation/wind/direction: is zero, but /simulation/wind/strength is above 0");
    const auto blows = [&](hair::Settings& s) { calm(s), s.simulation.wind.speed = 3.0f; };
    EXPECT_EQ(broken(blows), "no error");  // thesis mode does not use speed
    EXPECT_EQ(
        broken([&](hair::Settings& s) { blows(s), s.simulation.wind.mode = hair::WindMode::drag; }),
        "/simulation/wind/direction: is zero, but /simulation/wind/speed is above 0");
}

TEST(CheckSettings, WantsSolversThatKnowSectionsAndForcesOfContact) {
    const auto with = [](hair::Solver solver, float ellipticity, bool warm_start) {
        return broken([&](hair::Settings& s) {
            s.simulation.solver = solver;
            s.simulation.material.ellipticity = ellipticity;
            s.simulation.collision.warm_start = warm_start;
        });
    };
    EXPECT_EQ(with(hair::Solver::rod, 1.8f, true), "no error");
    EXPECT_EQ(with(hair::Solver::shape, 1.8f, false), "no error");  // `shape` has no material
    EXPECT_EQ(
        with(hair::Solver::stable_cosserat, 1.8f, false),
        "/simulation/material/ellipticity: is not 1, but of the rod solvers only rod supports "
        "elliptic cross-sections");
    EXPECT_EQ(
        with(hair::Solver::shape, 1.0f, true),
        "/simulation/collision/warm_start: is on, but only the solver rod carries contact forces "
        "from one substep to the next");
}

TEST(CheckSettings, WantsASolverThatTakesSets) {
    const auto with = [](hair::Solver solver, float share) {
        return broken([&](hair::Settings& s) {
            s.simulation.solver = solver;
            s.simulation.material.set_share = share;
        });
    };
    EXPECT_EQ(with(hair::Solver::rod, 0.5f), "no error");
    EXPECT_EQ(with(hair::Solver::shape, 0.0f), "no error");
    for (const hair::Solver solver :
         {hair::Solver::none, hair::Solver::shape, hair::Solver::ftl, hair::Solver::stable_cosserat,
          hair::Solver::position_based_rod, hair::Solver::augmented_mass_spring,
          hair::Solver::extension})
        EXPECT_EQ(
            with(solver, 0.5f),
            "/simulation/material/set_share: is above 0, but only the solver rod takes a set");
}

TEST(CheckSettings, WantsASolverThatTwists) {
    const auto with = [](hair::Solver solver, float twist, hair::RestShape rest) {
        return broken([&](hair::Settings& s) {
            s.simulation.solver = solver;
            s.simulation.rest = rest;
            s.simulation.material.twist = twist;
        });
    };
    constexpr auto kGroom = hair::RestShape::groom;
    for (const hair::Solver solver :
         {hair::Solver::rod, hair::Solver::stable_cosserat, hair::Solver::position_based_rod})
        EXPECT_EQ(with(solver, -50.0f, kGroom), "no error");
    EXPECT_EQ(with(hair::Solver::rod, 0.0f, hair::RestShape::balanced), "no error");
    EXPECT_EQ(
        with(hair::Solver::rod, 50.0f, hair::RestShape::balanced),
        "/simulation/material/twist: is not 0, but balanced hair rests in the groom's shape");
    for (const hair::Solver solver :
         {hair::Solver::none, hair::Solver::shape, hair::Solver::ftl,
          hair::Solver::augmented_mass_spring, hair::Solver::extension}) {
        EXPECT_EQ(with(solver, 0.0f, kGroom), "no error");
        EXPECT_EQ(
            with(solver, 50.0f, kGroom),
            "/simulation/material/twist: is not 0, which only the solvers rod, stable_cosserat and "
            "position_based_rod support");
    }
}

TEST(CheckSettings, WantsSolversThatKeepSegmentsOut) {
    const auto with = [](hair::Solver solver, bool warm_start) {
        return broken([&](hair::Settings& s) {
            s.simulation.solver = solver;
            s.simulation.collision.warm_start = warm_start;
            s.simulation.collision.parts = hair::CollisionParts::segments;
        });
    };
    for (const hair::Solver solver :
         {hair::Solver::shape, hair::Solver::ftl, hair::Solver::rod, hair::Solver::extension})
        EXPECT_EQ(with(solver, false), "no error");
    EXPECT_EQ(
        with(hair::Solver::stable_cosserat, false),
        "/simulation/collision/parts: is segments, which only the solvers shape, ftl, rod "
        "and files support");
    EXPECT_EQ(
        with(hair::Solver::rod, true), "/simulation/collision/parts: is segments, but warm_start "
                                       "carries only the contact forces of vertices");
}

TEST(CheckSettings, GivesHairOneKindOfFriction) {
    const auto with = [](float friction, float coefficient, float cohesion) {
        return broken([&](hair::Settings& s) {
            s.simulation.hair_hair.friction = friction;
            s.simulation.hair_hair.repulsion = 0.3f;
            s.simulation.hair_hair.friction_coefficient = coefficient;
            s.simulation.hair_hair.cohesion = cohesion;
        });
    };
    EXPECT_EQ(with(0.0f, 0.5f, 0.1f), "no error");
    EXPECT_EQ(with(0.1f, 0.0f, 0.0f), "no error");
    for (const auto& [coefficient, cohesion] : {std::pair(0.5f, 0.0f), std::pair(0.0f, 0.1f)})
        EXPECT_EQ(
            with(0.1f, coefficient, cohesion),
            "/simulation/hair_hair/friction: is above 0, but friction_coefficient or cohesion "
            "takes its place");
}

TEST(CheckSettings, WantsCurvesOfFilesBetweenGuides) {
    const auto from = [](hair::StrandSource source) {
        return broken([&](hair::Settings& s) {
            s.groom.grow.strands = 50;
            s.strands.curve = hair::Curve::extension;
            s.strands.source = source;
        });
    };
    EXPECT_EQ(from(hair::StrandSource::root_triangles), "no error");
    EXPECT_EQ(
        from(hair::StrandSource::groom), "/strands/curve: is a file, which draws strands between "
                                         "guides only: /strands/source is groom");
}

TEST(CheckSettings, WantsKeyframesInOrder) {
    const auto times = [](std::vector<float> all) {
        return broken([&](hair::Settings& s) {
            for (const float time : all) s.simulation.motion.keyframes.push_back({.time = time});
        });
    };
    EXPECT_EQ(times({0.5f}), "no error");
    EXPECT_EQ(times({0.0f, 1.0f, 1.5f}), "no error");
    EXPECT_EQ(
        times({0.0f, 1.0f, 1.0f}), "/simulation/motion/keyframes: entry 2 is not after entry 1");
    EXPECT_EQ(
        times({1.0f, 0.5f, 2.0f}), "/simulation/motion/keyframes: entry 1 is not after entry 0");
}

TEST(CheckSettings, WantsRepeatedMotionToClose) {
    const auto ending = [](const hair::Keyframe& last) {
        return broken([&](hair::Settings& s) {
            s.simulation.motion = {
                .keyframes = {{.time = 0.0f, .rotation = {0, -35, 0}}, last}, .repeat = true};
        });
    };
    EXPECT_EQ(ending({.time = 1.0f, .rotation = {0, -35, 0}}), "no error");
    EXPECT_EQ(ending({.time = 1.0f, .rotation = {360, 325, -720}}), "no error");
    const std::string reason = "/simulation/motion/repeat: is on, but the last keyframe does not "
                               "have the pose of the first";
    EXPECT_EQ(ending({.time = 1.0f, .rotation = {0, 35, 0}}), reason);
    EXPECT_EQ(ending({.time = 1.0f, .rotation = {0, -35, 0}, .translation = {0, 0, 0.1f}}), reason);
}

TEST(CheckSettings, WantsASourceOfGuides) {
    EXPECT_EQ(broken([](hair::Settings& s) { s.groom.file = "a.hgl"; }), "no error");
    EXPECT_EQ(
        broken([](hair::Settings& s) { s.groom.grow.mesh = ""; }),
        "/groom/grow/mesh: is empty, and so is /groom/file: guides need one of them");
}

TEST(CheckSettings, WantsStrandsOfTwoVerticesAtLeast) {
    EXPECT_EQ(
        broken([](hair::Settings& s) { s.groom.vertices = 1; }),
        "/groom/vertices: 1 is neither 0 nor at least 2");
    EXPECT_EQ(broken([](hair::Settings& s) { s.groom.vertices = 2; }), "no error");
}

TEST(CheckSettings, WantsAPartingWithLength) {
    const auto closed = [](float strength) {
        return broken([&](hair::Settings& s) {
            s.groom.grow.parting.strength = strength;
            s.groom.grow.parting.to = s.groom.grow.parting.from;
        });
    };
    EXPECT_EQ(closed(1.0f), "/groom/grow/parting/to: equals /groom/grow/parting/from");
    EXPECT_EQ(closed(0.0f), "no error");
}

TEST(CheckSettings, DrawsStrandsOfAFileOnlyWhereThereIsOne) {
    const auto own = [](const char* file) {
        return broken([&](hair::Settings& s) {
            s.strands.source = hair::StrandSource::groom;
            s.groom.file = file;
        });
    };
    EXPECT_EQ(
        own(""),
        "/strands/source: is groom, but neither /groom/file nor /groom/grow/strands is set");
    EXPECT_EQ(own("a.hair"), "no error");
    EXPECT_EQ(
        broken([](hair::Settings& s) {
            s.strands.source = hair::StrandSource::groom;
            s.groom.grow.strands = 100;
        }),
        "no error");
}

}  // namespace
}  // namespace benchmarks
