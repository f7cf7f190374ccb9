// Tests reading files that usd-core itself wrote.
#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hair/groom/files.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/groom/formats/usd_files.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// One curve along y.
std::string basisCurves(const std::string& name, int points = 2) {
    std::string places = "(0, 0, 0)";
    for (int i = 1; i < points; ++i) places += ", (0, " + std::to_string(i) + ", 0)";
    return "def BasisCurves \"" + name + "\" {\nint[] curveVertexCounts = [" +
           std::to_string(points) + "]\npoint3f[] points = [" + places +
           "]\nuniform token type = \"linear\"\n}\n";
}

using UsdImportTest = UsdFiles;

class UsdImportFormatTest : public UsdImportTest,
                            public testing::WithParamInterface<const char*> {};

TEST_P(UsdImportFormatTest, ReadsAllThatStrandsHaveToTheLastBit) {
    const StrandSet set = read(std::string("everything.") + GetParam());
    EXPECT_THAT(set.ends, ElementsAre(3u, 4u, 8u));
    ASSERT_EQ(set.points.size(), 8u);
    for (int k = 0; k < 7; ++k) EXPECT_EQ(set.points[k], glm::vec3(madePoint(k))) << k;
    EXPECT_EQ(set.points[7], glm::vec3(-0.0f, 1e-40f, 3e38f));
    EXPECT_TRUE(std::signbit(set.points[7].x));
    ASSERT_EQ(set.widths.values.size(), 8u);
    for (int k = 0; k < 8; ++k) EXPECT_EQ(set.widths.at(k), static_cast<float>((k + 1) / 30.0));
    ASSERT_EQ(set.colors.values.size(), 8u);
    EXPECT_EQ(set.colors.at(2), glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(set.colors.at(3), glm::vec3(0.4f, 0.5f, 0.6f));
    EXPECT_EQ(set.colors.at(4), glm::vec3(1.0f, 0.0f, 0.7f));
    EXPECT_EQ(set.transparencies.everywhere, 0.25f);
    EXPECT_THAT(
        set.root_uvs,
        ElementsAre(glm::vec2(0.1f, 0.9f), glm::vec2(0.2f, 0.8f), glm::vec2(0.3f, 0.7f)));
    EXPECT_TRUE(set.root_triangles.empty());
    EXPECT_EQ(set.metres_per_unit, 0.01);
    EXPECT_EQ(set.comment, "made by \"usd-core\": \u00e4\nsecond line");
    EXPECT_THAT(set.warnings, ElementsAre("normals, primvars:id: left out"));
}

INSTANTIATE_TEST_SUITE_P(, UsdImportFormatTest, testing::Values("usda", "usdc", "usd", "usdz"));

// p scaled by 2, turned by 90 degrees about z, moved by (1, 2, 3); then z up becomes y up. cos(90)
// is 6e-17 in double precision, so sums round to the expected whole numbers.
TEST_F(UsdImportTest, AppliesTransformsOfParentsAndInstances) {
    const StrandSet set = read("transforms.usda");
    const auto expected = [](glm::vec3 p) {
        const glm::vec3 turned(-2 * p.y + 1, 2 * p.x + 2, 2 * p.z + 3);
        return glm::vec3(turned.x, turned.z, -turned.y);
    };
    EXPECT_THAT(set.ends, ElementsAre(2u, 4u, 6u));
    ASSERT_EQ(set.points.size(), 6u);
    EXPECT_EQ(set.points[0], expected({1, 2, 3}));
    EXPECT_EQ(set.points[1], expected({4, 5, 6}));
    EXPECT_EQ(set.points[2], glm::vec3(10, 0, 0));
    EXPECT_EQ(set.points[3], glm::vec3(10, 1, 0));
    EXPECT_EQ(set.points[4], glm::vec3(20, 0, 0));
    EXPECT_EQ(set.points[5], glm::vec3(20, 1, 0));
    EXPECT_EQ(set.widths.everywhere, 1.0f);  // 0.5 scaled by 2, and the instances' own
    EXPECT_EQ(set.metres_per_unit, 1.0);
    EXPECT_THAT(set.warnings, ElementsAre("/scattered: instances on points are left out"));
}

TEST_F(UsdImportTest, TurnsZUpWithoutRounding) {
    const StrandSet set = read("z_up.usdc");
    ASSERT_EQ(set.points.size(), 3u);
    for (int k = 0; k < 3; ++k) {
        const glm::vec3 p(madePoint(k));
        EXPECT_EQ(set.points[k], glm::vec3(p.x, p.z, -p.y));
    }
    EXPECT_FALSE(set.widths.known());
    EXPECT_FALSE(set.colors.known());
    EXPECT_FALSE(set.transparencies.known());
}

TEST_F(UsdImportTest, ReadsTheFirstSampleOfWhatMoves) {
    const StrandSet set = read("animated.usd");
    EXPECT_THAT(set.points, ElementsAre(glm::vec3(5, 0, 100), glm::vec3(0, 5, 100)));
    EXPECT_EQ(set.widths.everywhere, 0.25f);
    EXPECT_FALSE(set.metres_per_unit);  // USD's default is no statement
    EXPECT_THAT(set.warnings, ElementsAre("/hair: one of its 3 time samples is read"));
}

TEST_F(UsdImportTest, SaysWhatItLeavesOut) {
    const StrandSet set = read("mixed.usdc");
    EXPECT_THAT(set.ends, ElementsAre(2u, 4u));
    EXPECT_THAT(set.widths.values, ElementsAre(0.25f, 0.5f, 2.0f, 2.0f));
    EXPECT_THAT(
        set.colors.values,
        ElementsAre(glm::vec3(1, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1), glm::vec3(1)));
    EXPECT_THAT(
        set.warnings, ElementsAre(
                          HasSubstr("missing.usda"), "/third: its HermiteCurves are left out",
                          "2 of 4 points have no colour and become white"));
}

// All files are read in one process, because a process takes half a second to start.
TEST_F(UsdImportTest, RefusesNamingThePrim) {
    const std::string refusals =
        runPython("tests/groom/formats/usd_refusals.py", "'" + folder().string() + "'").output;
    const std::pair<const char*, const char*> kRefused[] = {
        {"periodic.usda",
         "/wig/hair: its curves are periodic: only curves with two ends are strands"},
        {"negative_count.usda", "/wig/hair: curve 0 has -4 vertices"},
        {"huge_count.usda", "/wig/hair: points: 4 x 3 numbers, but 2147483647 x 3 are needed"},
        {"too_few_points.usda", "/wig/hair: points: 4 x 3 numbers, but 5 x 3 are needed"},
        {"no_points.usda", "/wig/hair: points: 0 x 3 numbers, but 4 x 3 are needed"},
        {"no_bezier.usda",
         "/wig/hair: curve 0 has 5 vertices, which do not make a nonperiodic bezier curve"},
        {"short_bspline.usda",
         "/wig/hair: curve 1 has 3 vertices, which do not make a nonperiodic bspline curve"},
        {"basis.usda", "/wig/hair: unknown basis 'hermite'; known: bezier, bspline, catmullRom"},
        {"knots_equal.usda", "/hair: curve 0 has no different knots within its range"},
        {"knots_fall.usda", "/hair: curve 0 has knots that decrease"},
        {"knots_few.usda",
         "/hair: 5 knots, but 6 are needed: for each curve as many as its vertices and its order"},
        {"knots_nan.usda", "/hair: knot 5 is not finite"},
        {"order_high.usda",
         "/hair: curve 0 has the order 4 and 3 vertices; expected an order from 2 to 16, and as "
         "many vertices"},
        {"order_one.usda",
         "/hair: curve 0 has the order 1 and 3 vertices; expected an order from 2 to 16, and as "
         "many vertices"},
        {"orders_many.usda", "/hair: 2 orders of 1 curves"},
        {"weight_zero.usda", "/hair: weight 1 is not a positive number"},
        {"kind.usda", "/wig/hair: unknown type 'quintic'; known: linear, cubic"},
        {"few_widths.usda", "/wig/hair: widths (vertex): 2 x 1 numbers, but 4 x 1 are needed"},
        {"two_constants.usda", "/wig/hair: widths (constant): 2 x 1 numbers, but 1 x 1 are needed"},
        {"triangles.usda",
         "/wig/hair: hairbench:rootTriangles: each needs three of the prim's own strands"},
        {"groups_of_floats.usda", "/wig/hair: groom_group_id: integers are needed"},
        {"groups_of_some.usda", "/wig/hair: groom_group_id: 1 numbers, but 2 are needed"},
        {"syntax.usda", "line 2:13: Expected }"},
        {"words.usda", ""},
        {"short.usdc", ""},
        {"short.usdz", ""},
        {"empty.usd", ""},
        {"bald.usda", "the stage has no BasisCurves or NurbsCurves with points"},
    };
    for (const auto& [name, reason] : kRefused) {
        const std::string line = "refused " + std::string(name) + ": " + reason;
        EXPECT_THAT(refusals, HasSubstr(line));
    }
    const std::regex line("(^|\n)refused ");
    EXPECT_EQ(
        std::distance(std::sregex_iterator(refusals.begin(), refusals.end(), line), {}),
        std::ssize(kRefused))
        << refusals;
}

TEST_F(UsdImportTest, FailsWithTheToolsWords) {
    EXPECT_EQ(errorText([] { read("negative_count.usda"); }), "/wig/hair: curve 0 has -4 vertices");
}

// One strand each; a width of all that is not finite is left out alone.
TEST_F(UsdImportTest, LeavesOutStrandsThatAreNotFinite) {
    for (const char* name : {"nan.usda", "infinite.usda", "overflow.usda"})
        EXPECT_EQ(
            errorText([&] { usableStrands(read(name)); }),
            "no strand can be used; the file has only 1 strand with a position that is not finite "
            "(strand 0, counted from 0)")
            << name;
    EXPECT_THAT(
        errorText([&] { usableStrands(read("negative_width.usda")); }),
        HasSubstr("1 strand with a negative width"));
    const StrandSet set = usableStrands(read("nan_width.usda"));
    EXPECT_EQ(set.strandCount(), 1u);
    EXPECT_FALSE(set.widths.known());
    EXPECT_THAT(
        set.warnings, testing::Contains("the width of all strands is not finite and is left out"));
}

// Other layers must be in the scene's folders. A pipe must not make the reader wait for its writer.
TEST_F(UsdImportTest, OpensFilesOfItsFoldersAlone) {
    const TemporaryFolder files;
    const std::string curve = "#usda 1.0\n(defaultPrim = \"c\")\n" + basisCurves("c");
    files.write("scene/own.usda", curve);
    files.write("private.usda", curve);
    std::filesystem::create_symlink("../private.usda", files.file("scene/link.usda"));
    ASSERT_EQ(mkfifo(files.file("scene/pipe.usda").c_str(), 0600), 0);
    const auto errorOf = [&](const std::string& arc) {
        const auto path = files.write("scene/a.usda", "#usda 1.0\n" + arc);
        const NamedFileCheck check(
            [](const std::filesystem::path&) {}, {std::filesystem::canonical(files.file("scene"))});
        return errorText([&] { importStrands(path, 0, check); });
    };
    const auto reference = [](const std::string& file) {
        return "def \"a\" (references = @" + file + "@) {}\n";
    };
    EXPECT_EQ(errorOf(reference("./own.usda")), "no error");
    for (const char* outside : {"../private.usda", "./link.usda"})
        EXPECT_THAT(errorOf(reference(outside)), HasSubstr("is outside the scene's folder"));
    EXPECT_THAT(
        errorOf("def \"a\" (payload = @../private.usda@) {}\n"),
        HasSubstr("is outside the scene's folder"));
    EXPECT_THAT(
        errorOf("(subLayers = [@../private.usda@])\n"), HasSubstr("is outside the scene's folder"));
    EXPECT_THAT(errorOf(reference("./pipe.usda")), HasSubstr("pipe.usda: is not a file"));
    // Without a check, the file's own folder is the limit.
    errorOf(reference("../private.usda"));
    EXPECT_THAT(
        errorText([&] { importStrands(files.file("scene/a.usda")); }), HasSubstr("is outside"));
    // The arguments of a format do not belong to the file's name.
    EXPECT_EQ(errorOf(reference("./own.usda:SDF_FORMAT_ARGS:a=b")), "no error");
    EXPECT_THAT(
        errorOf(reference("./link.usda:SDF_FORMAT_ARGS:a=b")),
        HasSubstr("is outside the scene's folder"));
    EXPECT_THAT(
        errorOf("(expressionVariables = { string A = \"li\" }\nsubLayers = "
                "[@`\"./${A}nk.usda\"`@])\n"),
        HasSubstr("layer names given by expressions are not read"));
}

// USD opens the layers of value clips when values are read.
TEST_F(UsdImportTest, OpensClipsOfItsFoldersAlone) {
    const TemporaryFolder files;
    files.write("private.usda", "#usda 1.0\n" + basisCurves("c"));
    const auto errorOf = [&](const std::string& clips) {
        const std::string prim = " (clips = { dictionary default = {\n" + clips +
                                 "\nstring primPath = \"/c\"\ndouble2[] active = [(0, 0)]\n} })";
        std::string text;
        for (const bool in_variant : {false, true}) {
            const std::string name = in_variant ? "variant.usda" : "prim.usda";
            const auto path = files.write(
                "scene/" + name,
                "#usda 1.0\n" + (in_variant ? "def \"a\" (prepend variantSets = \"v\") {\n"
                                              "variantSet \"v\" = { \"x\"" +
                                                  prim + " {} }\n}\n"
                                            : "def \"a\"" + prim + " {}\n"));
            const NamedFileCheck check(
                [](const std::filesystem::path&) {},
                {std::filesystem::canonical(files.file("scene"))});
            text += errorText([&] { importStrands(path, 0, check); }) + '\n';
        }
        return text;
    };
    const auto twice = [](const std::string& words) {
        return testing::ContainsRegex(words + "(.|\n)*" + words);
    };
    EXPECT_THAT(
        errorOf("asset[] assetPaths = [@../private.usda@]"),
        twice("is outside the scene's folder"));
    EXPECT_THAT(
        errorOf("asset manifestAssetPath = @../private.usda@"),
        twice("is outside the scene's folder"));
    EXPECT_THAT(errorOf("string templateAssetPath = \"p.#.usda\""), twice("from a template"));
    EXPECT_THAT(errorOf("string[] assetPaths = [\"x\"]"), twice("its value clips are not assets"));
}

// 8^9 curves in about 3 kB, and 1,000 prims that share 100,000 points.
TEST_F(UsdImportTest, HoldsReferencesAgainstTheFile) {
    const TemporaryFolder files;
    std::string nested = "#usda 1.0\n" + basisCurves("l0");
    for (int i = 1; i < 10; ++i) {
        nested += "def \"l" + std::to_string(i) + "\" {\n";
        for (int k = 0; k < 8; ++k)
            nested += "def \"c" + std::to_string(k) + "\" (references = </l" +
                      std::to_string(i - 1) + ">) {}\n";
        nested += "}\n";
    }
    EXPECT_THAT(
        errorText([&] { importStrands(files.write("nested.usda", nested)); }),
        HasSubstr("its references make"));
    std::string large = "#usda 1.0\n" + basisCurves("l", 100000);
    for (int i = 0; i < 1000; ++i)
        large += "def \"c" + std::to_string(i) + "\" (references = </l>) {}\n";
    EXPECT_THAT(
        errorText([&] { importStrands(files.write("large.usda", large)); }),
        HasSubstr("its instances expand to more than"));
    // 1,000 prims that share a face of 3,000 corners, whose points are few.
    std::string corners = "0";
    for (int i = 1; i < 3000; ++i) corners += ", " + std::to_string(i % 3);
    std::string faces = "#usda 1.0\ndef Mesh \"m\" {\nint[] faceVertexCounts = [3000]\n"
                        "int[] faceVertexIndices = [" +
                        corners + "]\npoint3f[] points = [(0, 0, 0), (0, 1, 0), (1, 0, 0)]\n}\n";
    for (int i = 0; i < 1000; ++i)
        faces += "def \"c" + std::to_string(i) + "\" (references = </m>) {}\n";
    EXPECT_THAT(
        errorText([&] { importMesh(files.write("faces.usda", faces)); }),
        HasSubstr("its instances expand to more than"));
}

// 20 pairs of layers. Each layer contains both layers of the next pair, which makes 2^20 paths.
TEST_F(UsdImportTest, RefusesSublayersInTooManyWays) {
    const TemporaryFolder files;
    for (int i = 0; i < 20; ++i) {
        const std::string next = std::to_string(i + 1) + ".usda@";
        const std::string text = "#usda 1.0\n(subLayers = [@l" + next + ", @m" + next + "])\n";
        for (const char* name : {"l", "m"}) files.write(name + std::to_string(i) + ".usda", text);
    }
    const std::string curve = "#usda 1.0\n" + basisCurves("c");
    for (const char* name : {"l20.usda", "m20.usda"}) files.write(name, curve);
    EXPECT_EQ(errorText([&] { importStrands(files.file("l18.usda")); }), "no error");
    EXPECT_THAT(
        errorText([&] { importStrands(files.file("l0.usda")); }),
        HasSubstr("more than 256 sublayers, including those of sublayers"));
}

// For each prim, USD looks up values in the prims around it and in the prims that it is composed
// of.
TEST_F(UsdImportTest, RefusesDeepNestsAndManyVariants) {
    const TemporaryFolder files;
    std::string deep = "#usda 1.0\n", names, sets;
    for (int i = 0; i < 150; ++i) deep += "def \"d" + std::to_string(i) + "\" {\n";
    deep += basisCurves("c");
    for (int i = 0; i < 150; ++i) deep += "}\n";
    EXPECT_THAT(
        errorText([&] { importStrands(files.write("deep.usda", deep)); }),
        HasSubstr("more than 128 nested prims"));
    for (int i = 0; i < 300; ++i) {
        const std::string name = "\"s" + std::to_string(i) + "\"";
        names += (i > 0 ? ", " : "") + name;
        sets += "variantSet " + name + " = { \"x\" { } }\n";
    }
    EXPECT_THAT(
        errorText([&] {
            importStrands(files.write(
                "sets.usda",
                "#usda 1.0\ndef \"a\" (prepend variantSets = [" + names + "]) {\n" + sets + "}\n"));
        }),
        HasSubstr("/a: is composed of 301 prims and variants, more than 256"));
}

TEST(UsdImport, SaysWhatItNeeds) {
    EXPECT_EQ(
        errorText([] { importUsd({}); }), "USD can be read only from a file, not from memory");
    const char* before = std::getenv("HAIRBENCH_PYTHON");
    const std::string saved = before ? before : "";
    setenv("HAIRBENCH_PYTHON", "/no/such/python", 1);
    EXPECT_THAT(
        errorText([] { importUsd({.bytes = {}, .path = "a.usda"}); }),
        HasSubstr("needs the project's Python environment: run scripts/setup --python"));
    before ? setenv("HAIRBENCH_PYTHON", saved.c_str(), 1) : unsetenv("HAIRBENCH_PYTHON");
}

// The curves or their parent have the constants, as arrays or as single values. Points or curves
// have the colours.
TEST_F(UsdImportTest, ReadsWhatUnrealEngineNames) {
    const StrandSet set = read("groom.usda");
    EXPECT_THAT(set.ends, ElementsAre(2u, 5u, 7u));
    EXPECT_THAT(set.groups, ElementsAre(7, 7, -3));
    EXPECT_THAT(set.guides, ElementsAre(0, 0, 1));
    EXPECT_THAT(
        set.root_uvs,
        ElementsAre(glm::vec2(0.1f, 0.2f), glm::vec2(0.3f, 0.4f), glm::vec2(0.5f, 0.6f)));
    EXPECT_THAT(set.widths.values, ElementsAre(1, 2, 3, 4, 5, 9, 9));
    ASSERT_EQ(set.colors.values.size(), 7u);
    EXPECT_EQ(set.colors.at(2), glm::vec3(0, 1, 0));
    EXPECT_EQ(set.colors.at(6), glm::vec3(0, 0, 1));
    EXPECT_THAT(set.warnings, ElementsAre("primvars:groom_roughness: left out"));
}

// A triangle each. A mesh below an invisible prim is hidden, too. USD's default of a centimetre is
// no statement.
TEST_F(UsdImportTest, LeavesOutHiddenMeshes) {
    const TemporaryFolder files;
    const auto mesh = [](const std::string& name, const std::string& more = "") {
        return "def Mesh \"" + name + "\" {\nint[] faceVertexCounts = [3]\n" +
               "int[] faceVertexIndices = [0, 1, 2]\n" +
               "point3f[] points = [(0, 0, 0), (0, 1, 0), (1, 0, 0)]\n" + more + "\n}\n";
    };
    const std::string invisible = "token visibility = \"invisible\"\n";
    const std::string hidden = "def Xform \"x\" {\n" + invisible + mesh("a") + "}\n" +
                               mesh("b", invisible) +
                               mesh("c", "uniform token purpose = \"proxy\"") +
                               mesh("d", "uniform token purpose = \"guide\"");
    const Mesh read = importMesh(files.write(
        "a.usda", "#usda 1.0\n" + mesh("shown", "uniform token purpose = \"render\"") + hidden));
    EXPECT_THAT(read.parts, ElementsAre("shown"));
    EXPECT_EQ(read.positions[1], glm::vec3(0, 1, 0));
    EXPECT_FALSE(read.is_placed);
    EXPECT_THAT(
        read.warnings, ElementsAre("2 meshes of invisible prims, 1 mesh of prims of purpose "
                                   "\"guide\", 1 mesh of prims of purpose \"proxy\": left out"));
    const Mesh stated = importMesh(files.write(
        "b.usda", "#usda 1.0\n(metersPerUnit = 0.25\nupAxis = \"Z\")\n" + mesh("shown")));
    EXPECT_EQ(stated.positions[1], glm::vec3(0, 0, -0.25f));
    EXPECT_TRUE(stated.is_placed);
    EXPECT_THAT(stated.warnings, ElementsAre());
    EXPECT_THAT(
        errorText([&] { importMesh(files.write("c.usda", "#usda 1.0\n" + hidden)); }),
        HasSubstr("the stage has no Mesh with faces that is shown, but 2 meshes of invisible"));
}

TEST_F(UsdImportTest, LeavesOutACurveWithoutVerticesAndItsTextureCoordinates) {
    const TemporaryFolder files;
    const auto curves = [](const std::string& name, const std::string& more) {
        return "def BasisCurves \"" + name + "\" {\nuniform token type = \"linear\"\n" + more +
               " (interpolation = \"vertex\")\n}\n";
    };
    const StrandSet set = importStrands(files.write(
        "a.usda",
        "#usda 1.0\n" +
            curves(
                "none", "int[] curveVertexCounts = [0]\npoint3f[] points = []\n"
                        "texCoord2f[] primvars:st = []") +
            curves(
                "one", "int[] curveVertexCounts = [2]\npoint3f[] points = [(0, 0, 0), (0, 1, 0)]\n"
                       "texCoord2f[] primvars:st = [(0.5, 0.25), (0, 0)]")));
    EXPECT_EQ(set.strandCount(), 1u);
    EXPECT_THAT(set.root_uvs, ElementsAre(glm::vec2(0.5f, 0.25f)));
    EXPECT_THAT(
        set.warnings,
        ElementsAre("1 strand without points (strand 0, counted from 0) is left out"));
}

TEST_F(UsdImportTest, ReadsUnitsThatAreStoredAsFloats) {
    EXPECT_EQ(read("float_unit.usdc").metres_per_unit, 0.5);
    EXPECT_EQ(read("float_centimetre.usdc").metres_per_unit, 0.01);
}

}  // namespace
}  // namespace hair::groom
