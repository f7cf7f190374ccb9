#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"

namespace hair::groom {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// The strands of expectTheStrands(), of radius 0.25.
const std::string kLinear =
    "<?xml version=\"1.0\"?>\n<!-- hair -->\n<scene>\n<Curves basis=\"linear\" type='flat'>\n"
    "<positions>\n0 0 0 0.25\n0 1 0 0.25\n0 2 0.5 0.25\n4 0 0 0.25\n4 1 0 0.25\n</positions>\n"
    "<indices>0 1 3</indices>\n</Curves>\n</scene>\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string
curves(const std::string& basis, const std::string& positions, const std::string& indices) {
    return "<scene><Curves basis=\"" + basis + "\" type=\"round\"><positions>" + positions +
           "</positions><indices>" + indices + "</indices></Curves></scene>";
}

StrandSet readXml(const std::string& text) { return readText(importEmbreeXml, text); }
std::string errorOfXml(const std::string& text) { return readError(importEmbreeXml, text); }

TEST(EmbreeXml, ReadsLinearCurves) {
    const StrandSet set = readXml(kLinear);
    expectTheStrands(set);
    EXPECT_THAT(set.widths.values, Each(0.5f));
    EXPECT_THAT(set.warnings, IsEmpty());
    EXPECT_EQ(brokenPromise(set), "");
    for (const char* older : {"LineSegments", "RoundLineSegments", "ConeSegments"}) {
        std::string text = replaced(kLinear, "Curves basis=\"linear\" type='flat'", older);
        expectTheStrands(readXml(replaced(text, "/Curves", std::string("/") + older)));
    }
}

// Two curves with consecutive vertices become one unless their numbers separate them.
TEST(EmbreeXml, TellsCurvesApartByTheirNumbers) {
    const std::string joined = replaced(kLinear, "0 1 3", "0 1 2 3");
    EXPECT_THAT(readXml(joined).ends, ElementsAre(5));
    const std::string numbered =
        replaced(joined, "</indices>", "</indices><curveid>7 7 8 8</curveid>");
    EXPECT_THAT(readXml(numbered).ends, ElementsAre(3, 6));
    EXPECT_THAT(
        errorOfXml(replaced(numbered, "8 8", "8")), StartsWith("line 12: 3 numbers of curves"));
}

// Bernstein's polynomials at 1/3: 8, 12, 6 and 1 of 27.
TEST(EmbreeXml, SamplesBezierCurves) {
    const StrandSet set = readXml(curves("bezier", "0 0 0 1  0 27 0 1  27 27 0 1  27 0 0 0", "0"));
    EXPECT_THAT(set.ends, ElementsAre(4));
    EXPECT_EQ(set.points[0], glm::vec3(0));
    EXPECT_NEAR(set.points[1].x, 6 + 1, 1e-5);  // floats of 2^4 are 1e-6 apart
    EXPECT_NEAR(set.points[1].y, 12 + 6, 1e-5);
    EXPECT_NEAR(set.widths.at(1), 2.0 * 26 / 27, 1e-6);
    EXPECT_EQ(set.points[3], glm::vec3(27, 0, 0));
    EXPECT_EQ(set.widths.at(3), 0.0f);
    // Hair has the curve's number next to each index; the second segment shares a vertex.
    const std::string pairs =
        "<scene><BezierHair><positions>0 0 0 1 1 0 0 1 2 0 0 1 3 0 0 1 4 0 0 1 5 0 0 1 6 0 0 1"
        "</positions><indices>0 5 3 5</indices></BezierHair></scene>";
    const StrandSet line = readXml(pairs);
    EXPECT_THAT(line.ends, ElementsAre(7));
    for (int k = 0; k < 7; ++k) EXPECT_NEAR(line.points[k].x, k, 1e-6) << k;
    EXPECT_THAT(readXml(replaced(pairs, "0 5 3 5", "0 5 3 6")).ends, ElementsAre(4, 8));
}

// Both bases have linear precision: the points are evenly spaced on a line, from the second vertex
// to the last but one. Catmull and Rom's curve always passes through them.
TEST(EmbreeXml, SamplesSplines) {
    const std::string even = "0 0 0 1 2 0 0 1 4 0 0 1 6 0 0 1 8 0 0 1";
    for (const char* basis : {"bspline", "catmull_rom"}) {
        const StrandSet set = readXml(curves(basis, even, "0 1"));
        // Two segments of five vertices: two pieces each.
        EXPECT_THAT(set.ends, ElementsAre(5)) << basis;
        for (int k = 0; k < 5; ++k) EXPECT_NEAR(set.points[k].x, 2 + k, 1e-6) << basis << k;
        EXPECT_THAT(set.widths.values, Each(testing::FloatEq(2.0f))) << basis;
    }
    const StrandSet bent = readXml(curves("catmull_rom", "0 0 0 1 1 5 0 1 2 -3 7 1 9 9 9 1", "0"));
    EXPECT_EQ(bent.points.front(), glm::vec3(1, 5, 0));
    EXPECT_EQ(bent.points.back(), glm::vec3(2, -3, 7));
}

// x = t^3 and y = t from 0 to 2: positions and derivatives at 0, 1 and 2.
TEST(EmbreeXml, SamplesHermiteCurves) {
    const std::string text = replaced(
        curves("hermite", "0 0 0 1  1 1 0 1  8 2 0 1", "0 1"), "<indices>",
        "<tangents>0 1 0 0  3 1 0 0  12 1 0 0</tangents><indices>");
    const StrandSet set = readXml(text);
    ASSERT_THAT(set.ends, ElementsAre(7));
    for (int k = 0; k < 7; ++k) {
        const double t = k / 3.0;
        EXPECT_NEAR(set.points[k].x, t * t * t, 1e-5) << k;  // floats of 2^3 are 1e-6 apart
        EXPECT_NEAR(set.points[k].y, t, 1e-6) << k;
        EXPECT_NEAR(set.widths.at(k), 2.0, 1e-6) << k;
    }
    EXPECT_THAT(
        errorOfXml(replaced(text, "0 1</indices>", "2</indices>")),
        HasSubstr("a segment of vertices 7 to 10, but there are 9"));
    EXPECT_THAT(
        errorOfXml(replaced(text, "12 1 0 0", "")), HasSubstr("2 tangents, but there are 3"));
    // For moving curves the first shape counts.
    std::string moving = replaced(text, "<tangents>", "<animated_tangents><tangents>");
    moving = replaced(
        moving, "</tangents>", "</tangents><tangents>0 0 0 0</tangents></animated_tangents>");
    const StrandSet first = readXml(moving);
    EXPECT_EQ(first.points, set.points);
    EXPECT_THAT(first.warnings, ElementsAre("the scene's 'animated_tangents' are left out"));
}

// x y z to 2 z, 2 x, 2 y and by (1, 2, 3): lengths twice as long.
TEST(EmbreeXml, FollowsGroupsAndTransforms) {
    std::string text = replaced(
        kLinear, "<scene>",
        "<scene><PointLight/><Group><Transform><AffineSpace>0 0 2 1 2 0 0 2 0 2 0 3</AffineSpace>");
    text = replaced(text, "</scene>", "</Transform></Group></scene>");
    const StrandSet set = readXml(text);
    EXPECT_EQ(set.points[2], glm::vec3(2 * 0.5f + 1, 2, 2 * 2 + 3));
    EXPECT_EQ(set.points[3], glm::vec3(1, 2 * 4 + 2, 3));
    // a cube root's rounding
    for (const float width : set.widths.values) EXPECT_FLOAT_EQ(width, 1.0f);
    EXPECT_THAT(set.warnings, ElementsAre("the scene's 'PointLight' are left out"));
    EXPECT_THAT(
        errorOfXml(replaced(text, "<AffineSpace>", "<AffineSpace rotate=\"1 2 3\">")),
        HasSubstr("an AffineSpace is 12 numbers"));
}

TEST(EmbreeXml, FollowsShortTransforms) {
    const auto placed = [](const std::string& space) {
        const std::string text =
            replaced(kLinear, "<scene>", "<scene><Transform><AffineSpace " + space + "/>");
        return replaced(text, "</scene>", "</Transform></scene>");
    };
    const StrandSet moved = readXml(placed("translate=\"1 2 3\""));
    EXPECT_EQ(moved.points[2], glm::vec3(1, 4, 3.5f));
    EXPECT_EQ(moved.widths.at(2), 0.5f);
    const StrandSet scaled = readXml(placed("scale=\"8 1 1\""));
    EXPECT_EQ(scaled.points[3], glm::vec3(32, 0, 0));
    EXPECT_FLOAT_EQ(scaled.widths.at(3), 1.0f);  // the geometric mean of 8, 1, 1 is 2
    for (const char* wrong :
         {"scale=\"1 2\"", "translate=\"1 2 3\" scale=\"1 1 1\"", "translate=\"1 2 x\""})
        EXPECT_THAT(errorOfXml(placed(wrong)), StartsWith("line 3: ")) << wrong;
}

// The nodes of an `assign` appear only at references, and at each of them.
TEST(EmbreeXml, FollowsReferences) {
    std::string text = replaced(kLinear, "<scene>", "<scene><assign type=\"scene\" id=\"hair\">");
    text = replaced(text, "</scene>", "</assign><Group><ref id=\"hair\"/></Group></scene>");
    expectTheStrands(readXml(text));
    const std::string twice = replaced(
        text, "<Group>",
        "<Transform><AffineSpace translate=\"9 0 0\"/><ref id=\"hair\"/></Transform><Group>");
    const StrandSet set = readXml(twice);
    ASSERT_THAT(set.ends, ElementsAre(3, 5, 8, 10));
    EXPECT_EQ(set.points[0], glm::vec3(9, 0, 0));
    EXPECT_EQ(set.points[5], glm::vec3(0));
    // A reference to an element's own id. The element itself is drawn too.
    std::string own = replaced(kLinear, "<Curves", "<Curves id=\"own\"");
    own = replaced(own, "</scene>", "<ref id=\"own\"/></scene>");
    EXPECT_THAT(readXml(own).ends, ElementsAre(3, 5, 8, 10));
    EXPECT_THAT(
        errorOfXml(replaced(text, "<ref id=\"hair\"", "<ref id=\"fur\"")),
        StartsWith("line 14: no earlier element has the id 'fur'"));
    EXPECT_EQ(
        errorOfXml(replaced(text, "<ref id=\"hair\"/>", "")), "line 3: the scene has no curves");
}

// A few lines that make 2^40 groups, and a group that contains itself.
TEST(EmbreeXml, RefusesEndlessReferences) {
    std::string text = "<scene><assign id=\"0\"><Group/></assign>";
    for (int i = 0; i < 40; ++i) {
        const std::string ref = "<ref id=\"" + std::to_string(i) + "\"/>";
        text += "<assign id=\"" + std::to_string(i + 1) + "\"><Group>" + ref + ref +
                "</Group></assign>";
    }
    EXPECT_THAT(
        errorOfXml(text + "<ref id=\"40\"/></scene>"),
        HasSubstr("the scene's references expand to more than 32 MiB"));
    EXPECT_THAT(
        errorOfXml("<scene><assign id=\"a\"><Group><ref id=\"a\"/></Group></assign>"
                   "<ref id=\"a\"/></scene>"),
        HasSubstr("does one refer to itself?"));
}

// 16,000 bytes of points, 20,000 times: 320 MB from a file of 0.5 MB.
TEST(EmbreeXml, HoldsWhatIsReferredToAgainstTheFile) {
    std::string positions;
    for (int i = 0; i < 1000; ++i) positions += "0 0 0 1\n";
    std::string text = "<scene><assign id=\"a\"><Curves basis=\"linear\"><positions>" + positions +
                       "</positions><indices>";
    for (int i = 0; i < 999; ++i) text += std::to_string(i) + ' ';
    text += "</indices></Curves></assign>";
    for (int i = 0; i < 20000; ++i) text += "<ref id=\"a\"/>";
    EXPECT_THAT(errorOfXml(text + "</scene>"), HasSubstr("references expand to more than"));
}

// All arrays read the same bytes of the file beside the scene.
TEST(EmbreeXml, HoldsArraysOfTheFileBesideItAgainstItsSize) {
    const TemporaryFolder folder;
    folder.write("scene.bin", std::string(1 << 16, '\0'));
    std::string text = "<scene>";
    for (int i = 0; i < 4000; ++i)
        text += "<Curves basis=\"linear\"><positions ofs=\"0\" size=\"4096\"/><indices>0</indices>"
                "</Curves>";
    const auto path = folder.write("scene.xml", text + "</scene>");
    EXPECT_THAT(
        errorText([&] { importStrands(path); }),
        HasSubstr("the arrays in the binary file expand to more than"));
}

TEST(EmbreeXml, AsksBeforeItOpensTheFileBesideIt) {
    const TemporaryFolder folder;
    folder.write("private.bin", std::string(64, '\0'));
    std::filesystem::create_symlink("private.bin", folder.file("scene.bin"));
    const auto path = folder.write(
        "scene.xml",
        "<scene><Curves basis=\"linear\"><positions ofs=\"0\" size=\"2\"/><indices>0</indices>"
        "</Curves></scene>");
    const auto refuse = [](const std::filesystem::path& file) {
        throw engine::Error(file.filename().string(), "refused");
    };
    EXPECT_THAT(
        errorText([&] { importStrands(path, 0, refuse); }), HasSubstr("scene.bin: refused"));
}

// Embree's own hair0.xml ends curves like this.
TEST(EmbreeXml, LeavesOutStrandsWithNan) {
    const StrandSet set = readXml(replaced(kLinear, "4 1 0", "4 nan 0"));
    EXPECT_THAT(set.ends, ElementsAre(3));
    EXPECT_EQ(set.points[2], glm::vec3(0, 2, 0.5f));
    EXPECT_THAT(set.warnings, ElementsAre(leftOutStrand(kNoPosition, 1)));
    std::string none = replaced(kLinear, "4 1 0", "4 nan 0");
    none = replaced(none, "0 0 0 0.25", "0 0 0 nan");
    EXPECT_THAT(errorOfXml(none), StartsWith("no strand can be used"));
}

TEST(EmbreeXml, ReadsNumbersBetweenComments) {
    expectTheStrands(
        readXml(replaced(kLinear, "<positions>", "<positions><!-- 1 2 3 4 -->\n<!-- <a> -->")));
    EXPECT_EQ(
        errorOfXml(replaced(kLinear, "0 1 0 0.25", "<!-- two\n -->0 x 0 0.25")),
        "line 8: 'x' is not a finite number");
}

TEST(EmbreeXml, ReadsArraysOfTheFileBesideIt) {
    const TemporaryFolder folder;
    Bytes bytes;
    bytes.zeros(8);
    bytes.f32(0, 0, 0, 0.25).f32(0, 1, 0, 0.25).f32(0, 2, 0.5, 0.25);
    bytes.f32(4, 0, 0, 0.25).f32(4, 1, 0, 0.25).u32(0).u32(1).u32(3);
    folder.write("scene.bin", bytes.str());
    const std::string text =
        "<scene><Curves basis=\"linear\" type=\"flat\"><positions ofs=\"8\" size=\"5\"/>"
        "<indices ofs=\"88\" size=\"3\"/></Curves></scene>";
    const StrandSet set = importStrands(folder.write("scene.xml", text));
    expectTheStrands(set);
    EXPECT_THAT(set.widths.values, Each(0.5f));
    for (const char* wrong : {"\"6\"", "\"4294967295\"", "\"1152921504606846976\""})
        EXPECT_THAT(
            errorText(
                [&] { importStrands(folder.write("scene.xml", replaced(text, "\"5\"", wrong))); }),
            HasSubstr("line 1: "))
            << wrong;
    EXPECT_THAT(errorOfXml(text), HasSubstr("lies in a file beside the scene"));
}

TEST(EmbreeXml, NamesTheLineOfWhatIsWrong) {
    const auto error = [](const std::string& from, const std::string& to) {
        return errorOfXml(replaced(kLinear, from, to));
    };
    EXPECT_EQ(error("4 1 0", "4 one 0"), "line 10: 'one' is not a finite number");
    EXPECT_EQ(error("4 1 0", "4 inf 0"), "no error");
    EXPECT_THAT(error("4 1 0", "4 1"), StartsWith("line 5: 'positions' is not made of groups"));
    EXPECT_EQ(error("0 1 0 0.25", "0 1 0 -1"), "no error");
    EXPECT_EQ(error("0 1 3", "0 1 4"), "line 12: a segment of vertices 4 to 5, but there are 5");
    EXPECT_EQ(error("0 1 3", "0 1 -3"), "line 12: '-3' is not an index");
    EXPECT_EQ(error("0 1 3", ""), "line 3: the scene has no curves");
    EXPECT_THAT(error("\"linear\"", "\"nurbs\""), StartsWith("line 4: curves of basis 'nurbs'"));
    EXPECT_EQ(
        error("\"linear\"", "\"hermite\""), "line 4: curves of basis 'hermite' without tangents");
    EXPECT_THAT(error("</Curves>", "</Kurves>"), StartsWith("line 13: the end of 'Curves'"));
    EXPECT_THAT(errorOfXml("<BGFscene></BGFscene>"), StartsWith("line 1: 'BGFscene'"));
    EXPECT_THAT(
        errorOfXml(kLinear + "<scene/>"), StartsWith("line 15: text after the end of the scene"));
    std::string nested;
    for (int i = 0; i < 100; ++i) nested += "<Group>";
    EXPECT_THAT(errorOfXml(nested), HasSubstr("more than 64"));
}

TEST(EmbreeXml, IsRefusedWhereverItEnds) {
    for (std::size_t size = 0; size + 1 < kLinear.size(); ++size)
        EXPECT_THAT(errorOfXml(kLinear.substr(0, size)), StartsWith("line ")) << size;
}

}  // namespace
}  // namespace hair::groom
