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
        with(R"("band": 2)"), at + "band: unknown key (did you mean 'bands'?); known: bands, tint");
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
        AllOf(HasSubstr("in/s.json: /shading/model: "), HasSubstr("is outside")));
    EXPECT_THAT(named("none.glsl"), HasSubstr("in/s.json: /shading/model: in/none.glsl: "));
    folder.write("in/folder.glsl/x", "");
    EXPECT_THAT(named("folder.glsl"), HasSubstr("in/s.json: /shading/model: in/folder.glsl: "));
    folder.write("in/large.glsl", std::string(hair::kLargestExtension + 1, ' '));
    EXPECT_THAT(named("large.glsl"), HasSubstr("in/s.json: /shading/model: in/large.glsl: "));
    EXPECT_THAT(named("toon.frag"), HasSubstr("unknown name 'toon.frag'"));
}

TEST_F(SceneExtensions, ErrorsOfTheCompilerHaveFileAndLine) {
    EXPECT_EQ(
        modelError("// @parameter bands 3 [1, 12] count: steps\n\n"
                   "vec3 shadeHair(HairPoint point) {\n    return colour * bands;\n}\n"),
        "in/s.json: /shading/model: in/mine.glsl:4: 'colour' : undeclared identifier");
    EXPECT_EQ(
        modelError("vec3 shade(HairPoint point) { return point.color; }\n"),
        "in/s.json: /shading/model: in/mine.glsl: has no function vec3 shadeHair(HairPoint point)");
    EXPECT_EQ(
        modelError("vec3 shadeHair(vec3 point) { return point; }\n"),
        "in/s.json: /shading/model: in/mine.glsl: has no function vec3 shadeHair(HairPoint point)");
    EXPECT_EQ(
        modelError("float shadeHair(HairPoint point) { return 1.0; }\n"),
        "in/s.json: /shading/model: in/mine.glsl:1: 'shadeHair' : overloaded functions must have "
        "the same return type; expected vec3 shadeHair(HairPoint point)");
    EXPECT_EQ(
        modelError("vec3 shadeHair(HairPoint point) { return point.color; }\nvoid main() {}\n"),
        "in/s.json: /shading/model: in/mine.glsl: 'main' has the name of one of the program's own "
        "functions: rename it");
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
        at + "#include is not permitted in a file that a scene names");
    EXPECT_EQ(
        body("# extension GL_EXT_buffer_reference : require"),
        at + "#extension is not permitted in a file that a scene names");
    EXPECT_EQ(body("ab\\"), at + "'\\' is not permitted in a file that a scene names");
    EXPECT_EQ(body("#define AB 1"), at + "#define is not permitted in a file that a scene names");
    // A function that is declared but not defined is refused. Otherwise the linker would use the
    // program's function of that name, and some of these take addresses.
    for (const char* const declaration :
         {"void storePair(uvec2 at, uint index, uvec2 pair);", "float[2] storePair(uvec2 at);",
          "struct S { float x; } storePair(uvec2 at);", "const vec3 storePair(uvec2 at) ;"})
        EXPECT_EQ(
            body(declaration), at + "'storePair' is declared but not defined, which is not "
                                    "permitted in a file that a scene names");
    EXPECT_EQ(
        body("if (point.along > 2.0) {} normalize(point.color); do {} while (false);"), "no error");
    for (const char* const global :
         {"vec4 extended_picture;", "float extended_picture[1] = {1.0};",
          "const float one = 1.0; float two = 2.0;",
          "struct PictureParameters { vec3 eye; } extended_picture;"})
        EXPECT_THAT(
            modelError("\n" + std::string(global) + "\n"),
            testing::StartsWith(at + "a declaration outside functions must be const"));
    EXPECT_EQ(
        modelError("struct Pair { float a; float b; };\nconst float kOne[2] = float[2](1.0, 2.0);\n"
                   "float[2] both(Pair p) { return float[2](p.a, p.b); }\n"
                   "vec3 shadeHair(HairPoint point) {\n    Pair p = Pair(kOne[0], 2.0);\n"
                   "    return vec3(both(p)[0]);\n}\n"),
        "no error");
    // The compiler ends a comment at a carriage return.
    EXPECT_EQ(
        body("// \r#extension GL_EXT_buffer_reference : require"), at + "has a control character");
    EXPECT_EQ(body("//" + std::string(60000, 'x')), at + "is longer than 1000 characters");
    for (const char* const word : {"layout", "buffer", "uniform", "shared"})
        EXPECT_THAT(
            body("    " + std::string(word) + " x;"),
            testing::StartsWith(at + '\'' + word + "' is not permitted"));
}

// The compiler continues a line, or a comment, after a backslash at its end. So the compiler would
// read text that a check line by line takes for a comment.
TEST_F(SceneExtensions, HaveNoBackslashAnywhere) {
    for (const char* const end : {"\\\n", "\\\r\n", "\\ "})
        for (const char* const hidden :
             {"#define AB 1", "#extension GL_EXT_buffer_reference : require",
              "layout(buffer_reference, std430) buffer Memory { vec4 at; };", "shared float x;"})
            EXPECT_EQ(
                modelError(
                    "// x " + std::string(end) + "/*\n" + hidden + "\n// */\n" +
                    "vec3 shadeHair(HairPoint point) { return point.color; }\n"),
                "in/s.json: /shading/model: in/mine.glsl:1: '\\' is not permitted in a file that a "
                "scene names")
                << hidden;
}

// Functions get the same arguments in every stage. Other inputs, such as gl_FragCoord, exist in the
// stages of one back end and not in those of another.
TEST_F(SceneExtensions, AreTheSameInEveryStage) {
    const auto shading = [&](const std::string& statement) {
        return modelError(
            "vec3 shadeHair(HairPoint point) {\n    " + statement +
            "\n    return point.color;\n}\n");
    };
    const std::string at = "in/s.json: /shading/model: in/mine.glsl:2: ";
    const std::string no_place = " is not permitted in a file that a scene names";
    EXPECT_EQ(shading("if (point.along > 2.0) discard;"), at + "'discard'" + no_place);
    for (const char* const derivative : {"dFdx", "dFdy", "fwidth"})
        EXPECT_EQ(
            shading("point.color = " + std::string(derivative) + "(point.color);"),
            at + "a derivative such as dFdx()" + no_place);
    for (const char* const input :
         {"gl_FragCoord.xyz", "vec3(gl_PrimitiveID)", "vec3(gl_SampleID)"})
        EXPECT_EQ(
            shading("point.color = " + std::string(input) + ";"),
            at + "a stage's own input such as gl_FragCoord" + no_place);
    EXPECT_EQ(
        shading("gl_FragDepth = 0.5;"), at + "a stage's own output such as gl_Position" + no_place);
    EXPECT_EQ(
        shading("point.color = vec3(gl_GlobalInvocationID);"),
        at + "'gl_GlobalInvocationID' : undeclared identifier");
    EXPECT_THAT(shading("barrier();"), testing::StartsWith(at + "'barrier'"));
    // Doubles are optional for devices.
    EXPECT_EQ(
        shading("double exact = 2.0LF; point.color *= float(exact);"),
        at + "a number that does not have 32 bits" + no_place);

    folder.write(
        "in/offset.glsl", "// @parameter reach 0.02 [0, 0.1] m: most\n"
                          "vec3 offsetHair(HairPlace place) { return vec3(gl_VertexIndex); }\n");
    EXPECT_EQ(
        error(R"({"strands": {"offset_function": "offset.glsl"}})"),
        "in/s.json: /strands/offset_function: in/offset.glsl:2: a stage's own input such as "
        "gl_FragCoord" +
            no_place);
    folder.write(
        "in/force.glsl",
        "vec3 accelerateGuide(GuidePoint point) {\n    return vec3(gl_LocalInvocationID);\n}\n");
    EXPECT_EQ(
        error(R"({"simulation": {"force": "force.glsl"}})"),
        "in/s.json: /simulation/force: in/force.glsl:2: a stage's own input such as gl_FragCoord" +
            no_place);
    folder.write(
        "in/solver.glsl", "void solveGuide(Guide guide) {\n"
                          "    setGuidePosition(1u, vec3(gl_GlobalInvocationID));\n}\n");
    EXPECT_EQ(
        error(R"({"simulation": {"solver": "solver.glsl"}})"),
        "in/s.json: /simulation/solver: in/solver.glsl:2: a stage's own input such as "
        "gl_FragCoord" +
            no_place);
}

// A solver moves guides by functions of the program's and sees no more of it.
TEST_F(SceneExtensions, SolversSeeTheirInterfaceAlone) {
    const auto with = [&](const std::string& before, const std::string& statement) {
        folder.write(
            "in/solver.glsl",
            before + "void solveGuide(Guide guide) {\n    " + statement + "\n}\n");
        return error(R"({"simulation": {"solver": "solver.glsl"}})");
    };
    const std::string at = "in/s.json: /simulation/solver: in/solver.glsl";
    EXPECT_EQ(
        with("", "setGuidePosition(1u, guidePredicted(1u)); setGuideMemory(0u, 0u, vec4(1.0));"),
        "no error");
    for (const char* const own :
         {"push.guides", "solved_guide", "solvedGuides().positions", "solvedVertex(1u)",
          "State(uvec2(0u)).at[0].x", "kExtendedMemory", "extension_turns"})
        EXPECT_THAT(
            with("", "float x = float(" + std::string(own) + ");"),
            AllOf(
                testing::StartsWith(at + ":2: "),
                testing::ContainsRegex("undeclared identifier|no matching overloaded function")))
            << own;
    for (const char* const global : {"uint solved_guide;", "vec3 guides[2];"})
        EXPECT_THAT(
            with(std::string(global) + "\n", ""),
            testing::StartsWith(at + ":1: a declaration outside functions must be const"));
    for (const char* const function :
         {"uint solvedVertex(uint vertex)", "vec3 guidePosition(uint vertex)",
          "bool isOnGuide(uint vertex)"})
        EXPECT_THAT(
            with(std::string(function) + ";\n", ""),
            HasSubstr("is declared but not defined, which is not permitted"))
            << function;
    EXPECT_THAT(
        with("bool guideHeld(uint vertex) { return false; }\n", ""),
        HasSubstr("'guideHeld' has the name of one of the program's own functions: rename it"));
    EXPECT_THAT(
        with("uint solvedVertex(uint vertex) { return 0u; }\n", ""),
        HasSubstr("'solvedVertex' has the name of one of the program's own functions: rename it"));
    EXPECT_EQ(
        with(
            "void f(uint v) { solveGuide(Guide(v, v, 0., 0., GuideFrame(vec4(0), vec3(0)), "
            "GuideFrame(vec4(0), vec3(0)))); }\n",
            "f(1u);"),
        at + ": 'solveGuide' calls itself: recursion is not permitted");
    EXPECT_THAT(with("", "barrier();"), testing::StartsWith(at + ":2: "));
    EXPECT_THAT(with("", "atomicAdd(guide.number, 1u);"), testing::StartsWith(at + ":2: "));

    folder.write("in/solver.glsl", "void solve(Guide guide) {}\n");
    EXPECT_EQ(
        error(R"({"simulation": {"solver": "solver.glsl"}})"),
        at + ": has no function void solveGuide(Guide guide)");
    folder.write("in/solver.glsl", "// @parameter longest_substep 1 [0, 1] s: x\n");
    EXPECT_EQ(
        error(R"({"simulation": {"solver": "solver.glsl"}})"),
        at + ": has a parameter 'longest_substep' that must be a number of at least 1e-05 s, the "
             "longest substep of /simulation/substeps 0");
}

TEST_F(SceneExtensions, CurvesSeeTheirInterfaceAlone) {
    const auto with = [&](const std::string& text) {
        folder.write("in/curve.glsl", text);
        return error(R"({"strands": {"curve": "curve.glsl"}})");
    };
    const auto body = [&](const std::string& statement) {
        return with(
            "HairCurvePoint curveHair(HairSegment segment, float t) {\n    " + statement +
            "\n    return HairCurvePoint(segment.from, segment.to);\n}\n");
    };
    const std::string at = "in/s.json: /strands/curve: in/curve.glsl";
    EXPECT_EQ(body(""), "no error");
    EXPECT_EQ(
        body("float x = float(gl_VertexIndex);"),
        at + ":2: a stage's own input such as gl_FragCoord is not permitted in a file that a scene "
             "names");
    for (const char* const own :
         {"kCurve", "splineWeights(t).x", "hairbenchPush", "guideVertex(0u).x", "gl_Position.x"})
        EXPECT_THAT(body("float x = " + std::string(own) + ";"), testing::StartsWith(at + ":2: "))
            << own;
    EXPECT_THAT(
        with("vec4 curveWeights(float t) { return vec4(t); }\n"
             "HairCurvePoint curveHair(HairSegment segment, float t) {\n"
             "    return HairCurvePoint(segment.from, segment.to);\n}\n"),
        HasSubstr("'curveWeights' has the name of one of the program's own functions: rename it"));
    EXPECT_EQ(
        with("vec3 curve(HairSegment segment, float t) { return segment.from; }\n"),
        at + ": has no function HairCurvePoint curveHair(HairSegment segment, float t)");
    EXPECT_EQ(
        with("vec3 curveHair(HairSegment segment, float t) { return segment.from; }\n"),
        at + ":1: 'curveHair' : overloaded functions must have the same return type; expected "
             "HairCurvePoint curveHair(HairSegment segment, float t)");
}

TEST_F(SceneExtensions, LoopsHaveConditionsOfEveryForm) {
    const auto body = [&](const std::string& statement) {
        return modelError(
            "vec3 shadeHair(HairPoint point) {\n    int n = 0;\n" + statement +
            "\n    return point.color;\n}\n");
    };
    for (const char* const loop :
         {"for (;;) if (++n > 3) break;", "for (int i = (2 + 1); i < (n + 4); ++i) ++n;",
          "while (n < 3 || (n & 1) == 0) ++n;", "do ++n; while (n < 3);",
          "while(++n<3){for(int i=0;i<n;++i);}", "for (int i = 0, j = 1; i < j || n > 1;) ++i;",
          "bool whiles = true, fors = whiles; // while (",
          "for (/* ; */ int i = 0; i < 3; i++) {}"})
        EXPECT_EQ(body(loop), "no error") << loop;
    const std::string at = "in/s.json: /shading/model: in/mine.glsl:3: ";
    EXPECT_EQ(
        body("while (bool odd = n > 3) ++n;"),
        at + "a loop's condition declares a variable: declare it before the loop");
    for (const char* const malformed : {"while () ++n;", "for (int i = 0) ++n;", "while (n < 3"})
        EXPECT_THAT(body(malformed), HasSubstr("syntax error")) << malformed;
    EXPECT_EQ(
        modelError("bool hairbenchNextTurn() { return true; }\n"
                   "vec3 shadeHair(HairPoint point) { return point.color; }\n"),
        "in/s.json: /shading/model: in/mine.glsl: 'hairbenchNextTurn' has the name of one of the "
        "program's own functions: rename it");
}

// Beyond these bounds a driver's compiler may take minutes and gigabytes, or crash.
TEST_F(SceneExtensions, AreBoundedInSize) {
    const auto with = [&](const std::string& before, const std::string& statement) {
        return modelError(
            before + "vec3 shadeHair(HairPoint point) {\n    " + statement +
            "\n    return point.color;\n}\n");
    };
    const std::string at = "in/s.json: /shading/model: in/mine.glsl";
    const auto array = [&](const std::string& size) {
        return with(
            "", "float a[" + size +
                    "]; a[int(point.along)] = 1.0; point.color.x = a[int(point.width)];");
    };
    EXPECT_EQ(array("1024"), "no error");
    for (const char* const size : {"1025", "1048576", "2147483647"})
        EXPECT_EQ(
            array(size), at + ":2: a type has " + size + " numbers; at most 1024 are permitted");
    // Inlined, these are 2^18 bodies of the innermost function.
    std::string doubling = "float f0(float x) { return sin(x); }\n";
    for (int i = 1; i <= 18; ++i) {
        const std::string inner = 'f' + std::to_string(i - 1);
        doubling += "float f" + std::to_string(i) + "(float x) { return " + inner + "(x) + " +
                    inner + "(0.5 * x); }\n";
    }
    EXPECT_THAT(
        with(doubling, "point.color.x = f18(point.along);"),
        testing::StartsWith(at + ": is too large: numbers "));
    EXPECT_EQ(with(doubling, "point.color.x = f5(point.along);"), "no error");
    const auto nested = [&](std::size_t depth) {
        std::string blocks, ends(depth, '}');
        for (std::size_t i = 0; i < depth; ++i) blocks += "if (point.along > 0.5) {\n";
        return with("", blocks + "point.color.x = 1.0;" + ends);
    };
    EXPECT_EQ(nested(32), "no error");
    EXPECT_EQ(
        nested(33), at + ": is too large: nested blocks: 33, counting the body of each function at "
                         "each call; at most 32 are permitted");
    EXPECT_EQ(
        with("float f(float x) { return f(x); }\n", "point.color.x = f(1.0);"),
        at + ": 'f' calls itself: recursion is not permitted");
}

// Everything in the language that works with values alone is allowed.
TEST_F(SceneExtensions, HaveTheLanguagesMathematics) {
    EXPECT_EQ(
        modelError(R"(const float kTable[8] = float[8](1., 2., 3., 4., 5., 6., 7., 8.);
void put(inout float to[4], int at) { to[at] = kTable[at]; }
vec3 shadeHair(HairPoint point) {
    mat3 m = mat3(point.color, point.normal, point.to_eye);
    m = inverse(m) * transpose(m);
    float d = determinant(m), whole, array[4];
    put(array, int(point.along));
    int exponent;
    d = frexp(d, exponent) + modf(d, whole) + array[exponent & 3];
    uint high, low, carry;
    umulExtended(3u, uint(d), high, low);
    int bits = bitfieldInsert(bitfieldExtract(int(uaddCarry(high, low, carry)), 2, 3), exponent, 1, 2);
    bits += bitCount(low) + findMSB(bitfieldReverse(carry)) % 3 ^ ~bits << 2;
    vec4 packed = unpackUnorm4x8(packUnorm4x8(vec4(d))) + unpackHalf2x16(packHalf2x16(vec2(d))).xyxy;
    bool odd = any(lessThan(point.color, packed.xyz)) || isnan(d) && !isinf(whole);
    switch (exponent) {
    case 0: d += 1.0; break;
    case 3: d = fma(d, whole, packed.x);
    default: d = ldexp(d, 2);
    }
    do { if (++bits == 3) continue; d *= uintBitsToFloat(high); } while (bits < 10);
    precise vec3 r = refract(point.normal, point.to_eye, 1.5) + reflect(point.normal, point.tangent);
    r = mix(point.color, r, bvec3(odd, false, true)) + outerProduct(point.color, r)[1];
    r += pow(abs(r), vec3(2.0)) + roundEven(r) + atanh(r) + atan(r, r.zyx) + mod(r, 2.0);
    r[bits % 3] = cross(r, point.normal).y;
    return odd ? r * m : m * r;
}
)"),
        "no error");
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
            declared(wrong), at + "expected // @parameter NAME DEFAULT [LEAST, MOST] UNIT: meaning")
            << wrong;
    EXPECT_EQ(
        declared("a 1 [2, 0] 1: x"),
        at + "[2, 0] is not a range: expected two numbers, the first below the second");
    EXPECT_EQ(
        declared("a 1e39 [0, 1e40] 1: x"),
        at + "[0, 1e40] exceeds the range of 32-bit numbers, which ends at 3.4e38");
    EXPECT_EQ(
        declared("a 1e39 [0, 2] 1: x"),
        at + "1e39 is neither a number nor (x, y, z) within the range");
    EXPECT_EQ(
        declared("a 3 [0, 2] 1: x"), at + "3 is neither a number nor (x, y, z) within the range");
    EXPECT_EQ(
        declared("a (0, 1, x) [0, 2] 1: x"),
        at + "(0, 1, x) is neither a number nor (x, y, z) within the range");
    EXPECT_EQ(
        modelError("// @parameter a 1 [0, 2] 1: x\n// @parameter a 1 [0, 2] 1: x\n"),
        at + "'a' is declared twice");
}

// Files of shading, offsets and curves are linked into the same stages.
TEST_F(SceneExtensions, FilesOfOneStageHaveDifferentNames) {
    const auto with = [&](const std::string& name, const std::string& constant) {
        folder.write(
            "in/offset.glsl", "// @parameter reach 0.02 [0, 0.1] m: most\nconst float kOne = 1.0;\n"
                              "vec3 offsetHair(HairPlace place) { return vec3(reach * kOne); }\n");
        folder.write(
            "in/curve.glsl",
            "// @parameter " + name + " 0.02 [0, 0.1] m: x\nconst float " + constant +
                " = 2.0;\nHairCurvePoint curveHair(HairSegment segment, float t) {\n"
                "    return HairCurvePoint(segment.from, segment.to * " +
                constant + ");\n}\n");
        return error(R"({"strands": {"curve": "curve.glsl", "offset_function": "offset.glsl"}})");
    };
    EXPECT_EQ(with("wide", "kTwo"), "no error");
    EXPECT_EQ(
        with("reach", "kTwo"), "in/s.json: /strands/curve: declares 'reach' as the file of "
                               "/strands/offset_function does: rename one");
    EXPECT_EQ(
        with("wide", "kOne"), "in/s.json: /strands/curve: in/curve.glsl: 'kOne' is a constant of "
                              "another file too: rename one");
}

TEST_F(SceneExtensions, OffsetsDeclareHowFarTheyReach) {
    folder.write("in/offset.glsl", "vec3 offsetHair(HairPlace place) { return vec3(0.0); }\n");
    EXPECT_THAT(
        error(R"({"strands": {"offset_function": "offset.glsl"}})"),
        testing::StartsWith("in/s.json: /strands/offset_function: in/offset.glsl: must declare a "
                            "parameter 'reach'"));
}

// The shipped extensions compile, and the documentation page names them.
TEST(ShippedExtensions, AreDocumentedAndCompile) {
    const std::string page = textOf(HAIRBENCH_SOURCE_DIR "/docs/extending.md");
    for (const char* const name : {"toon", "crimped", "vortex", "mass_spring", "helix"}) {
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
