// GLSL files that scenes name: docs/extending.md.
#include "benchmarks/scene/extensions.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/sweep.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

class SceneExtensions : public testing::Test {
protected:
    SceneExtensions() {
        folder.write("in/toon.glsl", kToon);
        folder.write("in/flat.glsl", kFlat);
        folder.write("private.glsl", kFlat);
    }

    scene::Scene load(const std::string& text) const {
        return scene::loadScene(folder.write("in/s.json", text));
    }

    // Returns the error of a scene with this text, when it is read or its file compiled.
    std::string error(const std::string& text) const {
        return folder.relative(errorText([&] {
            const scene::Scene read = load(text);
            try {
                scene::checkExtensions(read.settings);
            } catch (const engine::Error& error) {
                throw engine::Error(read.path.string(), error.what());
            }
        }));
    }

    // Returns the error of a shading model with this text.
    std::string modelError(const std::string& glsl) const {
        folder.write("in/mine.glsl", glsl);
        return error(R"({"shading": {"model": "mine.glsl"}})");
    }

    static std::vector<float> valuesOf(const hair::Settings& settings) {
        std::vector<float> values;
        for (const auto& value : settings.shading.model_parameters.values)
            values.push_back(value.value.x);
        return values;
    }

    static constexpr const char* kToon =
        "// @parameter bands 3 [1, 12] count: steps\n"
        "// @parameter tint (0.5, 0.25, 1) [0, 1] 1: of the shade\n"
        "vec3 shadeHair(HairPoint point) { return tint * bands * point.color; }\n";
    static constexpr const char* kFlat =
        "// @parameter bands 8 [1, 12] count: others\n"
        "vec3 shadeHair(HairPoint point) { return vec3(bands / 12.0); }\n";

    TemporaryFolder folder;
};

TEST_F(SceneExtensions, ParametersAreFieldsWithTheFilesDefaults) {
    const scene::Scene read =
        load(R"({"shading": {"model": "toon.glsl", "model_parameters": {"tint": [1, 0, 0.5]}}})");
    EXPECT_EQ(read.settings.shading.model, hair::ShadingModel::extension);
    EXPECT_EQ(
        read.resolved.json()["shading"]["model_parameters"].dump(),
        R"({"bands":3,"tint":[1,0,0.5]})");
    EXPECT_EQ(read.resolved.json()["shading"]["model"], "toon.glsl");
    EXPECT_EQ(errorText([&] { scene::checkExtensions(read.settings); }), "no error");
}

TEST_F(SceneExtensions, ParametersAreHeldToTheFile) {
    const auto with = [&](const std::string& parameters) {
        return error(
            R"({"shading": {"model": "toon.glsl", "model_parameters": {)" + parameters + "}}}");
    };
    const std::string at = "in/s.json: /shading/model_parameters/";
    EXPECT_EQ(with(R"("bands": 99)"), at + "bands: 99 is outside [1, 12] count");
    EXPECT_EQ(with(R"("tint": [0, 2, 0])"), at + "tint/1: 2 is outside [0, 1]");
    EXPECT_EQ(with(R"("tint": 1)"), at + "tint: expected an array of 3 numbers, found a number");
    EXPECT_EQ(with(R"("bands": [1, 2, 3])"), at + "bands: expected a number, found an array");
    EXPECT_EQ(with(R"("bands": "x")"), at + "bands: expected a number, found the string \"x\"");
    EXPECT_EQ(
        with(R"("band": 2)"),
        at + "band: unknown key (did you mean \"bands\"?); known: bands, tint");
    EXPECT_EQ(
        error(R"({"shading": {"model_parameters": {"bands": 2}}})"),
        "in/s.json: /shading/model_parameters: is set, but /shading/model names no file");
}

TEST_F(SceneExtensions, ParametersSweep) {
    const scene::Scene read = load(
        R"({"shading": {"model": "toon.glsl"}, "sweep": {"/shading/model_parameters/bands": [2, 5]}})");
    std::vector<std::vector<float>> values;
    for (const scene::CaseSpec& each : scene::expand(read))
        values.push_back(valuesOf(each.settings));
    EXPECT_THAT(values, ElementsAre(ElementsAre(2, 0.5f), ElementsAre(5, 0.5f)));

    const auto axis = scene::parseAxis("/shading/model_parameters/bands=4,40");
    EXPECT_THAT(
        errorText([&] { scene::expand(read, std::vector{axis}); }),
        EndsWith(
            "s.json: s/bands:40: /shading/model_parameters/bands: 40 is outside [1, 12] count"));
}

// Each case has the parameters of its own file, with that file's defaults.
TEST_F(SceneExtensions, FilesSweep) {
    const scene::Scene read = load(
        R"({"shading": {"model": "toon.glsl", "model_parameters": {"tint": [0, 0, 0]}},
            "sweep": {"/shading/model": ["toon.glsl", "flat.glsl", "phong"]}})");
    std::vector<std::vector<float>> values;
    for (const scene::CaseSpec& each : scene::expand(read))
        values.push_back(valuesOf(each.settings));
    EXPECT_THAT(values, ElementsAre(ElementsAre(3, 0), ElementsAre(8), ElementsAre()));
}

TEST_F(SceneExtensions, AnotherFileTakesItsOwnParameters) {
    scene::Scene read = load(
        R"({"shading": {"model": "toon.glsl", "model_parameters": {"bands": 5, "tint": [0, 0, 0]}}})");
    scene::setField(read, "/shading/model", "flat.glsl");
    EXPECT_THAT(valuesOf(read.settings), ElementsAre(5));
    scene::setField(read, "/shading/model", "phong");
    EXPECT_THAT(valuesOf(read.settings), ElementsAre());
    EXPECT_EQ(read.settings.shading.model, hair::ShadingModel::phong);
}

TEST_F(SceneExtensions, ABasesFileIsFoundFromElsewhere) {
    folder.write("in/below/base.json", R"({"shading": {"model": "own.glsl"}})");
    folder.write("in/below/own.glsl", kFlat);
    const scene::Scene read = load(R"({"base": "below/base.json"})");
    EXPECT_EQ(read.settings.shading.model_file, "below/own.glsl");
    EXPECT_THAT(valuesOf(read.settings), ElementsAre(8));
}

TEST_F(SceneExtensions, FilesAreBoundAsAllThatAreNamed) {
    const auto named = [&](const std::string& file) {
        return error(R"({"shading": {"model": ")" + file + "\"}}");
    };
    EXPECT_THAT(
        named("../private.glsl"),
        AllOf(HasSubstr("in/s.json: /shading/model: "), HasSubstr("lies outside of")));
    EXPECT_THAT(named("none.glsl"), HasSubstr("in/s.json: /shading/model: in/none.glsl: "));
    folder.write("in/folder.glsl/x", "");
    EXPECT_THAT(named("folder.glsl"), HasSubstr("in/s.json: /shading/model: in/folder.glsl: "));
    folder.write("in/large.glsl", std::string(hair::kLargestExtension + 1, ' '));
    EXPECT_THAT(named("large.glsl"), HasSubstr("in/s.json: /shading/model: in/large.glsl: "));
    EXPECT_THAT(named("toon.frag"), HasSubstr("unknown name \"toon.frag\""));
}

TEST_F(SceneExtensions, ErrorsOfTheCompilerHaveFileAndLine) {
    EXPECT_EQ(
        modelError("// @parameter bands 3 [1, 12] count: steps\n\n"
                   "vec3 shadeHair(HairPoint point) {\n    return colour * bands;\n}\n"),
        "in/s.json: /shading/model: in/mine.glsl:4: 'colour' : undeclared identifier");
    EXPECT_EQ(
        modelError("vec3 shade(HairPoint point) { return point.color; }\n"),
        "in/s.json: /shading/model: in/mine.glsl: has no function 'shadeHair' with the parameters "
        "that are asked for");
    EXPECT_EQ(
        modelError("vec3 shadeHair(HairPoint point) { return point.color; }\nvoid main() {}\n"),
        "in/s.json: /shading/model: in/mine.glsl: 'main' is a function of the program's own: "
        "rename it");
}

// A file cannot use the program's functions, buffers and extensions.
TEST_F(SceneExtensions, SeesItsInterfaceAlone) {
    const auto body = [&](const std::string& statement) {
        return modelError(
            "vec3 shadeHair(HairPoint point) {\n" + statement + "\n    return point.color;\n}\n");
    };
    const std::string at = "in/s.json: /shading/model: in/mine.glsl:2: ";
    EXPECT_EQ(body("// buffer, layout: in a comment they may stand"), "no error");
    EXPECT_EQ(
        body("    point.color = vec3(kLightCount);"), at + "'kLightCount' : undeclared identifier");
    EXPECT_EQ(body("    point.color = push.picture.xxx;"), at + "'push' : undeclared identifier");
    EXPECT_EQ(
        body("#include \"common/picture.glsl\""),
        at + "#include has no place in a file that a scene names");
    EXPECT_EQ(
        body("# extension GL_EXT_buffer_reference : require"),
        at + "#extension has no place in a file that a scene names");
    EXPECT_EQ(body("ab\\"), at + "'\\' has no place in a file that a scene names");
    EXPECT_EQ(body("#define AB 1"), at + "#define has no place in a file that a scene names");
    // Otherwise the linker would find the program's functions, some of which take addresses.
    for (const char* const declaration :
         {"void storePair(uvec2 at, uint index, uvec2 pair);", "float[2] storePair(uvec2 at);",
          "struct S { float x; } storePair(uvec2 at);", "const vec3 storePair(uvec2 at) ;"})
        EXPECT_EQ(
            body(declaration), at + "'storePair' is declared and not defined, which has no place "
                                    "in a file that a scene names");
    EXPECT_EQ(
        body("if (point.along > 2.0) {} normalize(point.color); do {} while (false);"), "no error");
    for (const char* const global :
         {"vec4 extended_picture;", "float extended_picture[1] = {1.0};",
          "const float one = 1.0; float two = 2.0;",
          "struct PictureParameters { vec3 eye; } extended_picture;"})
        EXPECT_THAT(
            modelError("\n" + std::string(global) + "\n"),
            testing::StartsWith(at + "what is declared outside of functions has to be const"));
    EXPECT_EQ(
        modelError("struct Pair { float a; float b; };\nconst float kOne[2] = float[2](1.0, 2.0);\n"
                   "float[2] both(Pair p) { return float[2](p.a, p.b); }\n"
                   "vec3 shadeHair(HairPoint point) {\n    Pair p = Pair(kOne[0], 2.0);\n"
                   "    return vec3(both(p)[0]);\n}\n"),
        "no error");
    // The compiler ends a comment at a carriage return.
    EXPECT_EQ(
        body("// \r#extension GL_EXT_buffer_reference : require"), at + "has a control character");
    EXPECT_EQ(body("//" + std::string(60000, 'x')), at + "is longer than 1000 letters");
    for (const char* const word : {"layout", "buffer", "uniform", "shared"})
        EXPECT_THAT(
            body("    " + std::string(word) + " x;"),
            testing::StartsWith(at + '\'' + word + "' has no place"));
}

TEST_F(SceneExtensions, DeclarationsHaveAForm) {
    const auto declared = [&](const std::string& declaration) {
        return modelError("\n// @parameter " + declaration + "\n");
    };
    const std::string at = "in/s.json: /shading/model: in/mine.glsl:2: ";
    for (const char* const wrong :
         {"bands", "bands 3", "bands 3 [1, 2]", "Bands 1 [0, 2] 1: x", "1a 1 [0, 2] 1: x",
          "a 1 [0, 2] 1", "a 1 [0; 2] 1: x", "a 1 0 [0, 2] 1: x"})
        EXPECT_EQ(
            declared(wrong), at + "a parameter is declared so: // @parameter NAME DEFAULT [LEAST, "
                                  "MOST] UNIT: meaning")
            << wrong;
    EXPECT_EQ(declared("a 1 [2, 0] 1: x"), at + "[2, 0] is no range");
    EXPECT_EQ(
        declared("a 3 [0, 2] 1: x"), at + "3 is neither a number nor (x, y, z) within the range");
    EXPECT_EQ(
        declared("a (0, 1, x) [0, 2] 1: x"),
        at + "(0, 1, x) is neither a number nor (x, y, z) within the range");
    EXPECT_EQ(
        modelError("// @parameter a 1 [0, 2] 1: x\n// @parameter a 1 [0, 2] 1: x\n"),
        at + "'a' is declared twice");
}

TEST_F(SceneExtensions, OffsetsDeclareHowFarTheyReach) {
    folder.write("in/offset.glsl", "vec3 offsetHair(HairPlace place) { return vec3(0.0); }\n");
    EXPECT_THAT(
        error(R"({"strands": {"offset_function": "offset.glsl"}})"),
        testing::StartsWith("in/s.json: /strands/offset_function: in/offset.glsl: declares no "
                            "parameter `reach`"));
}

// The shipped extensions compile, and the documentation page names them.
TEST(ShippedExtensions, AreDocumentedAndCompile) {
    const std::string page = textOf(HAIRBENCH_SOURCE_DIR "/docs/extending.md");
    for (const char* const name : {"toon", "crimped", "vortex"}) {
        const std::filesystem::path path = std::filesystem::path(HAIRBENCH_SCENES_DIR) /
                                           "extended" / (std::string(name) + ".json");
        const scene::Scene read = scene::loadScene(path);
        const auto extensions = scene::namedExtensions(read.settings);
        ASSERT_EQ(extensions.size(), 1u) << name;
        EXPECT_EQ(extensions.front().file, std::string(name) + ".glsl");
        EXPECT_THAT(page, HasSubstr("(../scenes/extended/" + std::string(name) + ".json)"));
        EXPECT_EQ(errorText([&] { scene::checkExtensions(read.settings); }), "no error");
    }
}

}  // namespace
}  // namespace benchmarks
