#include "benchmarks/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "benchmarks/scene/settings_json.h"
#include "benchmarks/scene/sweep.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Scene, KnowsWhereItIs) {
    const TemporaryFolder folder;
    const auto path = folder.write("curl.json", "{}");
    const scene::Scene scene = scene::loadScene(path);
    EXPECT_EQ(scene.path, path);
    EXPECT_EQ(scene.directory, folder.path());
    EXPECT_EQ(scene.name, "curl");
    EXPECT_EQ(scene::changedFields(scene.settings).dump(), "{}");
    EXPECT_TRUE(scene.axes.empty());
}

TEST(Scene, SeparatesSettingsFromTheReadersMembers) {
    const TemporaryFolder folder;
    const scene::Scene scene = scene::loadScene(folder.write(
        "s.json",
        R"({"$schema": "x", "seed": 7, "sweep": {"/strands/density": [64.0, 16], "/render/msaa": [1]}})"));
    EXPECT_EQ(scene::changedFields(scene.settings).dump(), R"({"seed":7})");
    EXPECT_THAT(
        scene.resolved.text(), HasSubstr(R"("seed":7,"groom":{"file":"","points_per_strand":0,)"));
    EXPECT_THAT(scene.resolved.text(), Not(HasSubstr("sweep")));
    EXPECT_EQ(scene.settings.seed, 7u);
    ASSERT_EQ(scene.axes.size(), 2u);
    EXPECT_EQ(scene.axes[0].pointer, "/strands/density");
    EXPECT_THAT(scene.axes[0].values, ElementsAre(scene::Document(64), scene::Document(16)));
}

TEST(Scene, IsAppliedToItsBase) {
    const TemporaryFolder folder;
    folder.write("base.json", R"({"seed": 7, "strands": {"density": 8, "tessellation": 2},
                                  "sweep": {"/strands/density": [1, 2], "/render/msaa": [1, 4]}})");
    const scene::Scene scene = scene::loadScene(folder.write(
        "s.json", R"({"base": "base.json", "strands": {"density": 9, "tessellation": null},
                      "sweep": {"/strands/density": null}})"));
    EXPECT_EQ(scene::changedFields(scene.settings).dump(), R"({"seed":7,"strands":{"density":9}})");
    ASSERT_EQ(scene.axes.size(), 1u);
    EXPECT_EQ(scene.axes[0].pointer, "/render/msaa");
}

TEST(Scene, TakesAwayTheBasesSweep) {
    const TemporaryFolder folder;
    folder.write("a.json", R"({"sweep": {"/strands/density": [1, 2]}})");
    folder.write("b.json", R"({"base": "a.json", "sweep": null})");
    EXPECT_TRUE(scene::loadScene(folder.write("c.json", R"({"base": "b.json", "sweep": null})"))
                    .axes.empty());
}

TEST(Scene, FindsTheFilesOfABaseInAnotherFolder) {
    const TemporaryFolder folder;
    folder.write("lib/base.json", R"({"groom": {"grow": {"mesh": "../m/head.glb"}}})");
    folder.write("lib/file.json", R"({"groom": {"file": "a.hgl", "grow": {"mesh": "/head.glb"}}})");
    folder.write("lib/silent.json", "{}");
    folder.write(
        "lib/bodies.json",
        R"({"simulation": {"distance_fields": [{"mesh": ""}, {"mesh": "body.obj"}]}})");
    const auto load = [&](const char* text) {
        const auto path = folder.write("s.json", text);
        return scene::loadScene(path, scene::Outside::allowed).settings.groom;
    };
    EXPECT_EQ(load(R"({"base": "lib/base.json"})").grow.mesh, "m/head.glb");
    EXPECT_EQ(load(R"({"base": "lib/file.json"})").file, "lib/a.hgl");
    EXPECT_EQ(load(R"({"base": "lib/file.json"})").grow.mesh, "/head.glb");
    EXPECT_EQ(load(R"({"base": "lib/silent.json"})").grow.mesh, "lib/assets/head.glb");
    const scene::Scene bodies =
        scene::loadScene(folder.write("b.json", R"({"base": "lib/bodies.json"})"));
    EXPECT_EQ(bodies.settings.simulation.distance_fields[0].mesh, "");
    EXPECT_EQ(bodies.settings.simulation.distance_fields[1].mesh, "lib/body.obj");
}

TEST(SetField, IsAsIfTheFileHadIt) {
    const TemporaryFolder folder;
    scene::Scene scene = scene::loadScene(folder.write("s.json", R"({"seed": 7})"));
    scene::setField(scene, "/run/frames", 64);
    EXPECT_EQ(scene::changedFields(scene.settings).dump(), R"({"seed":7,"run":{"frames":64}})");
    EXPECT_EQ(scene.settings.run.frames, 64u);
    EXPECT_THAT(scene.resolved.text(), HasSubstr(R"("frames":64)"));
    EXPECT_EQ(
        errorText([&] { scene::setField(scene, "/run/frames", 0); }),
        "/run/frames: 0 is outside [1, 1000000] count");
}

// ---- Errors ---------------------------------------------------------------------------------

struct BadScene {
    const char* text;
    const char* error;  // follows the file's name
};

void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.text; }

class SceneError : public testing::TestWithParam<BadScene> {};

TEST_P(SceneError, IsOneLine) {
    const TemporaryFolder folder;
    const auto path = folder.write("s.json", GetParam().text);
    const std::string error = folder.relative(errorText([&] { scene::loadScene(path); }));
    EXPECT_EQ(error, std::string("s.json") + GetParam().error);
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

const BadScene kBadJson[] = {
    {"", ": is empty; a scene is at least {}"},
    {" \n", ": is empty; a scene is at least {}"},
    {"{\n  \"seed\": 1,\n}",
     ":3:1: syntax error while parsing object key - unexpected '}'; expected string literal"},
    {"{} x", ":1:4: syntax error while parsing value - invalid literal; last read: '{} x'; "
             "expected end of input"},
    {"{ // why\n}", ":1:3: syntax error while parsing object key - invalid literal; last read: '{ "
                    "/'; expected string "
                    "literal"},
    {R"({"seed": 1e999})", ":1:14: number overflow parsing '1e999'"},
    {"[1]", ": expected an object, found an array of 1"},
    {R"({"seed": 1, "seed": 2})", ": /seed: appears twice"},
    {R"({"simulation": {"colliders": [{}, {"radius": 1, "radius": 2}]}})",
     ": /simulation/colliders/1/radius: appears twice"}};
INSTANTIATE_TEST_SUITE_P(Json, SceneError, testing::ValuesIn(kBadJson));

const BadScene kBadFields[] = {
    {R"({"strands": {"tessalation": 1}})",
     ": /strands/tessalation: unknown key (did you mean 'tessellation'?); known: backend, "
     "source, interpolation, blend, collision_rule, collision, randomness, density, tessellation, "
     "width, root_width, tip_width, curl, variation, offsets, offset_function, "
     "offset_parameters, opacity, texture, curve, curve_parameters, taper, "
     "taper_start, submission, rays"},
    {R"({"sweeep": {}})", ": /sweeep: unknown key (did you mean 'sweep'?); known: description, "
                          "seed, groom, simulation, strands, "
                          "lod, copies, shading, camera, render, run, $schema, base, sweep"},
    {R"({"run": {"a/b\n~": 1}})",
     ": /run/a~1b?~0: unknown key; known: warmup, frames, precision, "
     "max_time, case_timeout, warmup_time, round_time, frame_time, interpolate, frames_in_flight, "
     "overlapped_stamps, "
     "async_compute, clocks, busy_pass, busy_work, reference, compare_backends, probes"},
    {R"({"strands": 3})", ": /strands: expected an object, found 3"},
    {R"({"strands": {"density": "64"}})",
     ": /strands/density: expected an integer, found the string \"64\""},
    {R"({"strands": {"density": null}})", ": /strands/density: expected an integer, found null"},
    {R"({"strands": {"root_width": true}})",
     ": /strands/root_width: expected a number, found true"},
    {R"({"strands": {"backend": 1}})", ": /strands/backend: expected a name, found 1"},
    {R"({"render": {"head": 1}})", ": /render/head: expected true or false, found 1"},
    {R"({"groom": {"file": {}}})", ": /groom/file: expected a string, found an object"},
    {R"({"render": {"msaa": "x"}})", ": /render/msaa: expected an integer, found the string \"x\""},
    {R"({"strands": {"density": 0}})", ": /strands/density: 0 is outside [1, 4096] count"},
    {R"({"strands": {"density": -1}})", ": /strands/density: -1 is outside [1, 4096] count"},
    {R"({"groom": {"guides": 1300000}})", ": /groom/guides: 1300000 is outside [0, 1000000] count"},
    {R"({"seed": 4294967296})", ": /seed: 4294967296 is outside [0, 4294967295]"},
    {R"({"simulation": {"friction": 1.5}})", ": /simulation/friction: 1.5 is outside [0, 1]"},
    {R"({"simulation": {"time_step": 1e-9}})",
     ": /simulation/time_step: 1e-09 is outside [0.0005, 0.1] s"},
    {R"({"strands": {"density": 2.5}})", ": /strands/density: 2.5 is not an integer"},
    {R"({"render": {"msaa": 3}})", ": /render/msaa: 3 is not one of 1, 2, 4, 8 samples"},
    {R"({"strands": {"curve": "bsplin"}})",
     ": /strands/curve: unknown name 'bsplin' (did you mean 'bspline'?); known: bspline, "
     "bspline_unpinned, catmull_rom"},
    {R"({"camera": {"position": [0, 1]}})",
     ": /camera/position: expected an array of 3 numbers, found an array of 2"},
    {R"({"camera": {"position": 1}})",
     ": /camera/position: expected an array of 3 numbers, found 1"},
    {R"({"camera": {"position": [0, "y", 1]}})",
     ": /camera/position/1: expected a number, found the string \"y\""},
    {R"({"camera": {"up": [0, 0, 2]}})", ": /camera/up/2: 2 is outside [-1, 1]"},
    {R"({"simulation": {"colliders": {}}})",
     ": /simulation/colliders: expected an array, found an object"},
    {R"({"simulation": {"colliders": [{"radius": 0}]}})",
     ": /simulation/colliders/0/radius: 0 is outside [0.0001, 10] m"},
    {R"({"simulation": {"colliders": [{"r": 1}]}})",
     ": /simulation/colliders/0/r: unknown key; known: a, b, radius, follows"}};
INSTANTIATE_TEST_SUITE_P(Fields, SceneError, testing::ValuesIn(kBadFields));

const BadScene kBadReaderMembers[] = {
    {R"({"$schema": 1})", ": /$schema: expected a string, found 1"},
    {R"({"base": 1})", ": /base: expected a string, found 1"},
    {R"({"base": "none.json"})", ": /base: none.json: no such file"},
    {R"({"base": "s.json"})", ": /base: s.json is built on this file: a cycle"},
    {R"({"sweep": null})", ": /sweep: expected an object, found null"},
    {R"({"sweep": []})", ": /sweep: expected an object, found an array of 0"},
    {R"({"sweep": {"/strands/density": 3}})",
     ": /sweep: /strands/density: expected an array of values, found 3"},
    {R"({"sweep": {"/strands/density": []}})",
     ": /sweep: /strands/density: an axis needs at least one value"},
    {R"({"sweep": {"/strands/density": [4, 4.0]}})", ": /sweep: /strands/density: 4 appears twice"},
    {R"({"sweep": {"/strands/density": [1, 0]}})",
     ": /sweep: /strands/density: 0 is outside [1, 4096] count"},
    {R"({"sweep": {"/strands/density": [1, null]}})",
     ": /sweep: /strands/density: expected an integer, found null"},
    {R"({"sweep": {"strands": [1]}})",
     ": /sweep: 'strands': a JSON pointer starts with '/', as in /strands/density"},
    {R"({"sweep": {"/lod~2": [1]}})",
     ": /sweep: /lod~2: '~' must be written ~0, and '/' in a name ~1"},
    {R"({"sweep": {"/lod/levle": [1]}})", ": /sweep: /lod/levle: unknown key (did you mean "
                                          "'level'?); known: mode, level, near_distance, "
                                          "far_distance, maximum_level, error, merged"},
    {R"({"sweep": {"/seed/x": [1]}})", ": /sweep: /seed/x: 1 has no members"},
    {R"({"sweep": {"/sweep": [1]}})",
     ": /sweep: /sweep: unknown key (did you mean 'seed'?); known: description, seed, "
     "groom, simulation, strands, lod, copies, shading, "
     "camera, render, run"},
    {R"({"sweep": {"/camera/up/3": [1]}})", ": /sweep: /camera/up/3: the array has 3 elements"},
    {R"({"sweep": {"/simulation/colliders/0/radius": [1]}})",
     ": /sweep: /simulation/colliders/0: the array has 0 elements"},
    {R"({"sweep": {"/simulation/wind": [{"strenght": 1}]}})",
     ": /sweep: /simulation/wind/strenght: unknown key (did you mean 'strength'?); known: "
     "mode, strength, direction, cone_angle, gust_rate, speed, turbulence, turbulence_scale, "
     "turbulence_octaves, air_density, air_viscosity, drag_along"}};
INSTANTIATE_TEST_SUITE_P(ReaderMembers, SceneError, testing::ValuesIn(kBadReaderMembers));

TEST(SceneErrors, OfAFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(
        folder.relative(errorText([&] { scene::loadScene(folder.path() / "no.json"); })),
        "no.json: no such file");
    EXPECT_EQ(
        errorText([&] { scene::loadScene(folder.path()); }),
        folder.path().string() + ": is a folder, not a scene file");
}

TEST(SceneErrors, OfALongList) {
    const TemporaryFolder folder;
    std::string list = "{}";
    for (int i = 0; i < 8; ++i) list += ", {}";
    const auto path =
        folder.write("s.json", R"({"simulation": {"distance_fields": [)" + list + "]}}");
    EXPECT_EQ(
        folder.relative(errorText([&] { scene::loadScene(path); })),
        "s.json: /simulation/distance_fields: has 9 elements; at most 8 are permitted");
}

TEST(SceneErrors, OfDeepNesting) {
    const TemporaryFolder folder;
    const auto path = folder.write("s.json", std::string(1000000, '['));
    EXPECT_EQ(
        folder.relative(errorText([&] { scene::loadScene(path); })),
        "s.json: is nested deeper than 64 levels");
}

TEST(SceneErrors, OfABaseNameBothFiles) {
    const TemporaryFolder folder;
    folder.write("base.json", R"({"seed": -1})");
    const auto path = folder.write("s.json", R"({"base": "base.json", "seed": 1})");
    EXPECT_EQ(
        folder.relative(errorText([&] { scene::loadScene(path); })),
        "s.json: /base: base.json: /seed: -1 is outside [0, 4294967295]");
}

TEST(SceneErrors, OfACycleOfBases) {
    const TemporaryFolder folder;
    folder.write("a.json", R"({"base": "sub/../b.json"})");
    folder.write("sub/x", "");
    const auto path = folder.write("b.json", R"({"base": "a.json"})");
    EXPECT_EQ(
        folder.relative(errorText([&] { scene::loadScene(path); })),
        "b.json: /base: a.json: /base: sub/../b.json is built on this file: a cycle");
}

TEST(SceneErrors, OfALongChainOfBases) {
    const TemporaryFolder folder;
    folder.write("0.json", "{}");
    for (int i = 1; i <= 4000; ++i)
        folder.write(
            std::to_string(i) + ".json", R"({"base": ")" + std::to_string(i - 1) + R"(.json"})");
    EXPECT_EQ(scene::loadScene(folder.file("16.json")).settings.seed, 1u);
    for (const char* path : {"17.json", "4000.json"})
        EXPECT_THAT(
            errorText([&] { scene::loadScene(folder.file(path)); }),
            HasSubstr("/base: the chain of bases is longer than 16 scenes"));
}

TEST(SceneErrors, OfManyMembers) {
    const TemporaryFolder folder;
    std::string members = R"("0": 1)";
    for (int i = 1; i < 300000; ++i) members += ", \"" + std::to_string(i) + "\": 1";
    for (const auto& [before, after, place] :
         {std::tuple{"{", "}", "/4096"}, {R"({"strands": {)", "}}", "/strands/4096"}})
        EXPECT_EQ(
            folder.relative(errorText(
                [&] { scene::loadScene(folder.write("s.json", before + members + after)); })),
            std::string("s.json: ") + place + ": the object has more than 4096 members");
}

TEST(SceneErrors, OfALongName) {
    const TemporaryFolder folder;
    const auto load = [&](std::size_t length) {
        return folder.relative(errorText([&] {
            scene::loadScene(folder.write("s.json", "{\"" + std::string(length, 'a') + "\": 1}"));
        }));
    };
    EXPECT_EQ(load(10000000), "s.json: a name has 10000000 bytes; at most 512 are permitted");
    EXPECT_THAT(load(512), HasSubstr("unknown key; known: description, seed, groom, "));
}

TEST(SceneErrors, OfALongAxis) {
    const TemporaryFolder folder;
    std::string values = "1";
    for (int i = 2; i <= 100000; ++i) values += ", " + std::to_string(i);
    std::string rows = R"({"/seed": 1})";
    for (int i = 2; i <= 100000; ++i) rows += R"(, {"/seed": )" + std::to_string(i) + '}';
    const auto load = [&](const std::string& sweep) {
        return folder.relative(errorText(
            [&] { scene::loadScene(folder.write("s.json", R"({"sweep": {)" + sweep + "}}")); }));
    };
    EXPECT_EQ(
        load(R"("/seed": [)" + values + "]"),
        "s.json: /sweep: /seed: has 100000 values; at most 10000 are permitted");
    EXPECT_EQ(
        load(R"("cases": [)" + rows + "]"),
        "s.json: /sweep/cases: has 100000 values; at most 10000 are permitted");
}

// Their sizes are sufficient for the errors, so they are not read.
TEST(SceneErrors, OfALargeFile) {
    const TemporaryFolder folder;
    const auto path = folder.write("s.json", "{}");
    std::filesystem::resize_file(path, std::uintmax_t{1} << 40);
    EXPECT_EQ(
        folder.relative(errorText([&] { scene::loadScene(path); })),
        "s.json: is larger than 256 MiB");
    folder.write("t.json", std::string(std::size_t{17} << 20, ' '));
    EXPECT_EQ(
        folder.relative(errorText([&] { scene::loadScene(folder.file("t.json")); })),
        "t.json: is larger than 16 MiB, the limit of a scene file, and is not a picture");
}

#ifndef _WIN32

// Reading a pipe without a writer would wait forever.
TEST(SceneErrors, OfAPipe) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo(folder.file("pipe.json").c_str(), 0600), 0);
    const auto load = [&](const std::filesystem::path& path) {
        return folder.relative(errorText([&] { scene::loadScenes(path); }));
    };
    EXPECT_EQ(load(folder.file("pipe.json")), "pipe.json: is not a file");
    EXPECT_EQ(
        load(folder.write("s.json", R"({"base": "pipe.json"})")),
        "s.json: /base: pipe.json: is not a file");
    EXPECT_THAT(
        load(folder.write("suite.json", R"({"suite": ["pipe.json"]})")),
        HasSubstr("pipe.json: is not a file"));
    EXPECT_EQ(load("/dev/zero"), "/dev/zero: is not a file");
}

#endif

TEST(SceneErrors, OfARemovalThatRemovesNothing) {
    const TemporaryFolder folder;
    folder.write("base.json", R"({"sweep": {"/strands/density": [1, 2]}})");
    const auto path =
        folder.write("s.json", R"({"base": "base.json", "sweep": {"/strands/densty": null}})");
    EXPECT_EQ(
        folder.relative(errorText([&] { scene::loadScene(path); })),
        "s.json: /sweep/~1strands~1densty: nothing to remove (did you mean '/strands/density'?); "
        "known: "
        "/strands/density");
}

}  // namespace
}  // namespace benchmarks
