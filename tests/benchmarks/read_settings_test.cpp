#include "benchmarks/scene/settings_json.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/error_text.h"

namespace benchmarks {
namespace {

hair::Settings read(const char* text) { return scene::readSettings(scene::Json::parse(text)); }

TEST(ReadSettings, KeepsDefaultsOfWhatIsAbsent) {
    const hair::Settings settings = read(R"({"strands": {"density": 16}})");
    EXPECT_EQ(settings.strands.density, 16u);
    EXPECT_EQ(settings.strands.tessellation, hair::StrandSettings{}.tessellation);
    EXPECT_EQ(settings.groom.guides, hair::GroomSettings{}.guides);
}

TEST(ReadSettings, ReadsEveryKindOfField) {
    const hair::Settings s = read(R"({
        "description": "d", "seed": 4294967295,
        "simulation": {"solver": "none", "friction": 0.25, "gravity": [1, -2.5, 3],
                       "colliders": [{"radius": 1}, {"a": [1, 2, 3], "radius": 2}]},
        "render": {"msaa": 8, "head": false}})");
    EXPECT_EQ(s.description, "d");
    EXPECT_EQ(s.seed, 4294967295u);
    EXPECT_EQ(s.simulation.solver, hair::Solver::none);
    EXPECT_EQ(s.simulation.friction, 0.25f);
    EXPECT_EQ(s.simulation.gravity, glm::vec3(1.0f, -2.5f, 3.0f));
    ASSERT_EQ(s.simulation.colliders.size(), 2u);
    EXPECT_EQ(s.simulation.colliders[0].radius, 1.0f);
    EXPECT_EQ(s.simulation.colliders[1].a, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(s.render.msaa, 8u);
    EXPECT_FALSE(s.render.head);
}

TEST(ReadSettings, TakesAWholeNumberHoweverItIsWritten) {
    EXPECT_EQ(read(R"({"run": {"frames": 1e3}})").run.frames, 1000u);
    EXPECT_EQ(read(R"({"run": {"frames": 64.0}})").run.frames, 64u);
}

TEST(ReadSettings, PassesOverTheSceneReadersMembers) {
    EXPECT_NO_THROW(read(R"({"$schema": 1, "base": 2, "sweep": 3})"));
}

TEST(ReadSettings, RefusesNumbersThatAreNotFinite) {
    for (const double number :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const scene::Json document = {{"simulation", {{"friction", number}}}};
        EXPECT_EQ(
            errorText([&] { scene::readSettings(document); }),
            std::string("/simulation/friction: ") + (std::isnan(number) ? "nan" : "inf") +
                " is not finite");
    }
}

TEST(ReadSettings, RefusesADocumentThatIsNoObject) {
    EXPECT_EQ(
        errorText([] { read("[]"); }), "the document: expected an object, found an array of 0");
}

TEST(WriteSettings, WritesEveryFieldWithCleanNumbers) {
    const scene::Json echo = scene::writeSettings({});
    EXPECT_EQ(echo["simulation"]["global"]["stiffness"].dump(), "0.002");
    EXPECT_EQ(echo["simulation"]["gravity"].dump(), "[0,-9.8,0]");
    EXPECT_EQ(echo["lod"]["level"].dump(), "0");
    EXPECT_EQ(echo["strands"]["backend"], "automatic");
    EXPECT_EQ(echo["simulation"]["colliders"].dump(), "[]");
    EXPECT_EQ(echo["render"]["overlays"]["guides"], false);
    EXPECT_EQ(echo.begin().key(), "description");
}

TEST(WriteSettings, ReadsBackBitEqual) {
    hair::Settings settings;
    settings.simulation.time_step = std::nextafter(1.0f / 60.0f, 1.0f);
    settings.simulation.gravity = {-0.0f, 0.1f + 0.2f, 1e-30f};
    settings.simulation.colliders = {{.radius = 1.0f / 3.0f}, {.a = glm::vec3(2.0f / 7.0f)}};
    settings.strands.tip_width = 0.0005f;
    settings.seed = 4294967295u;
    settings.render.ssaa = 2;
    settings.simulation.stiffness_scaling = hair::StiffnessScaling::thesis;
    const std::string text = scene::writeSettings(settings).dump();
    const hair::Settings back = read(text.c_str());
    EXPECT_EQ(back.simulation.time_step, settings.simulation.time_step);
    EXPECT_EQ(back.simulation.gravity, settings.simulation.gravity);
    EXPECT_TRUE(std::signbit(back.simulation.gravity.x));
    EXPECT_EQ(back.simulation.colliders[0].radius, settings.simulation.colliders[0].radius);
    EXPECT_EQ(back.simulation.colliders[1].a, settings.simulation.colliders[1].a);
    EXPECT_EQ(back.strands.tip_width, settings.strands.tip_width);
    EXPECT_EQ(scene::writeSettings(back).dump(), text);
}

bool holdsNull(const scene::Json& value) {
    if (value.is_null()) return true;
    for (const scene::Json& member : value)
        if (value.is_structured() && holdsNull(member)) return true;
    return false;
}

TEST(WriteSettings, NamesEveryDefault) { EXPECT_FALSE(holdsNull(scene::writeSettings({}))); }

}  // namespace
}  // namespace benchmarks
