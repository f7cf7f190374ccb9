#include "benchmarks/scene/settings_json.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/edited_document.h"
#include "tests/error_text.h"
#include "tests/viewer/random_settings.h"

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

std::vector<std::string> pointersInto(const scene::Json& value, const std::string& pointer = "") {
    std::vector<std::string> pointers;
    if (!pointer.empty()) pointers.push_back(pointer);
    if (value.is_structured())
        for (const auto& [key, member] : value.items())
            for (std::string& each : pointersInto(member, pointer + '/' + key))
                pointers.push_back(std::move(each));
    return pointers;
}

// Returns the settings after an edit of their whole document, as text, or the error.
std::string
afterEditOfDocument(scene::Json document, const std::string& pointer, const scene::Json& value) {
    std::string text;
    const std::string error = errorText([&] {
        editDocument(document, pointer, value);
        text = scene::writeSettings(scene::readSettings(document)).dump();
    });
    return text.empty() ? error : text;
}

// Returns the same after setField().
std::string
afterSetField(hair::Settings settings, const std::string& pointer, const scene::Json& value) {
    std::string text;
    const std::string error = errorText([&] {
        scene::setField(settings, pointer, value);
        text = scene::writeSettings(settings).dump();
    });
    return text.empty() ? error : text;
}

TEST(SetField, ChangesWhatAnEditOfTheDocumentChanges) {
    RandomSettings random(5, 0.2);
    std::size_t edits = 0;
    for (int i = 0; i < 4; ++i) {
        const hair::Settings from = random();
        const scene::Json before = scene::writeSettings(from);
        scene::Json wanted = scene::writeSettings(random());
        for (const std::string& pointer : pointersInto(wanted)) {
            if (!before.contains(scene::Json::json_pointer(pointer))) continue;
            const scene::Json& value = scene::valueAt(wanted, pointer);
            EXPECT_EQ(
                scene::valueAt(from, pointer).dump(),
                before.at(scene::Json::json_pointer(pointer)).dump());
            ASSERT_EQ(
                afterSetField(from, pointer, value), afterEditOfDocument(before, pointer, value))
                << pointer << ' ' << value;
            ++edits;
        }
    }
    EXPECT_GT(edits, 1000u);
}

TEST(SetField, RefusesWhatAnEditOfTheDocumentRefuses) {
    hair::Settings settings;
    settings.simulation.colliders.resize(2);
    const scene::Json document = scene::writeSettings(settings);
    for (const std::string& pointer : pointersInto(document))
        for (const char* const text :
             {"null", "true", "-1", "0.5", "1e30", "\"x\"", "[]", "[1, 2, 3]", "[1, \"x\", 3]",
              "[{}]", "{}", R"({"x": 1})", R"({"radius": 2, "a": null})",
              R"({"strength": null, "gust_rate": 2})"}) {
            const scene::Json value = scene::Json::parse(text);
            EXPECT_EQ(
                afterSetField(settings, pointer, value),
                afterEditOfDocument(document, pointer, value))
                << pointer << ' ' << text;
        }
}

TEST(SetField, NamesTheTokenThatIsUnknown) {
    hair::Settings settings;
    settings.simulation.colliders.resize(2);
    scene::Json document = scene::writeSettings(settings);
    for (const char* const pointer :
         {"", "seed", "/", "/strands/densty", "/strands/density/0", "/camera/position/3",
          "/camera/position/01", "/camera/position/x", "/camera/position/0/1", "/a~2",
          "/simulation/colliders/2", "/simulation/colliders/-", "/simulation/colliders/1/radios",
          "/simulation/force_parameters/x", "/render/head/x", "/description/x"}) {
        const std::string expected = errorText([&] { scene::valueAt(document, pointer); });
        EXPECT_EQ(errorText([&] { scene::setField(settings, pointer, 1); }), expected);
        EXPECT_EQ(errorText([&] { scene::valueAt(settings, pointer); }), expected);
        EXPECT_NE(expected, "no error") << pointer;
    }
}

TEST(SetField, ReplacesAGroupAsAFileDoes) {
    hair::Settings settings;
    settings.simulation.wind.strength = 7.0f;
    settings.simulation.wind.gust_rate = 2.0f;
    scene::setField(settings, "/simulation/wind", {{"strength", 3.0}}, scene::Objects::replaced);
    EXPECT_EQ(settings.simulation.wind.strength, 3.0f);
    EXPECT_EQ(settings.simulation.wind.gust_rate, hair::WindSettings{}.gust_rate);
}

}  // namespace
}  // namespace benchmarks
