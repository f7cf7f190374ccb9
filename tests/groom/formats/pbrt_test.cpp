#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/strand_files.h"

// pbrt-v4's format of files; expected points follow from the definitions of Bézier curves and
// uniform B-splines.
namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

StrandSet readPbrt(std::string_view text) {
    const StrandSet set = readText(importPbrt, text);
    EXPECT_EQ(brokenPromise(set), "");
    return set;
}

// Distance to an expected place that rounding to float explains.
void expectNear(const glm::vec3& point, const glm::dvec3& expected) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(point[axis], expected[axis], 1e-6) << axis;
}

// De Casteljau's construction of a Bézier curve.
glm::dvec3 casteljau(std::vector<glm::dvec3> vertices, double t) {
    for (std::size_t size = vertices.size() - 1; size > 0; --size)
        for (std::size_t i = 0; i < size; ++i) vertices[i] += t * (vertices[i + 1] - vertices[i]);
    return vertices.front();
}

TEST(Pbrt, SamplesCubicBezierCurves) {
    const StrandSet set =
        readPbrt("Shape \"curve\" \"point3 P\" [0 0 0  0 3 0  3 3 0  3 0 6] \"float width0\" 0.5 "
                 "\"float width1\" 0.125");
    ASSERT_THAT(set.ends, ElementsAre(4));  // as many points as vertices
    const std::vector<glm::dvec3> vertices{{0, 0, 0}, {0, 3, 0}, {3, 3, 0}, {3, 0, 6}};
    for (std::size_t i = 0; i < 4; ++i) {
        expectNear(set.points[i], casteljau(vertices, double(i) / 3.0));
        EXPECT_FLOAT_EQ(set.widths.values[i], 0.5f - 0.125f * static_cast<float>(i));
    }
}

TEST(Pbrt, SamplesQuadraticBezierCurves) {
    const StrandSet set = readPbrt(
        "Shape \"curve\" \"integer degree\" [2] \"point3 P\" [0 0 0 2 4 0 4 0 0 6 -4 0 8 0 2]");
    ASSERT_THAT(set.ends, ElementsAre(5));
    EXPECT_EQ(set.points[0], glm::vec3(0, 0, 0));
    expectNear(set.points[1], casteljau({{0, 0, 0}, {2, 4, 0}, {4, 0, 0}}, 0.5));
    EXPECT_EQ(set.points[2], glm::vec3(4, 0, 0));
    expectNear(set.points[3], casteljau({{4, 0, 0}, {6, -4, 0}, {8, 0, 2}}, 0.5));
    EXPECT_EQ(set.points[4], glm::vec3(8, 0, 2));
    EXPECT_FALSE(set.widths.known());
}

// At the ends of its segments a uniform cubic B-spline has 1/6, 4/6 and 1/6 of three vertices, a
// quadratic one halves of two.
TEST(Pbrt, SamplesBsplines) {
    const StrandSet cubic = readPbrt("Shape \"curve\" \"string basis\" \"bspline\" \"point3 P\" [0 "
                                     "0 0 6 0 0 6 6 0 0 6 0 0 0 6]");
    ASSERT_THAT(cubic.ends, ElementsAre(5));
    expectNear(cubic.points[0], {5, 1, 0});
    expectNear(cubic.points[2], {5, 5, 0});
    expectNear(cubic.points[4], {1, 5, 1});
    const StrandSet quadratic = readPbrt(
        "Shape \"curve\" \"string basis\" [ \"bspline\" ] \"integer degree\" 2 \"point3 P\" "
        "[0 0 0 2 0 0 2 4 0]");
    ASSERT_THAT(quadratic.ends, ElementsAre(3));
    expectNear(quadratic.points[0], {1, 0, 0});
    expectNear(quadratic.points[1], {1.75, 0.5, 0});  // 1/8, 6/8 and 1/8 of the three
    expectNear(quadratic.points[2], {2, 2, 0});
}

TEST(Pbrt, JoinsSegmentsThatContinueEachOther) {
    const std::string first =
        "Shape \"curve\" \"float width\" 1 \"point3 P\" [0 0 0 0 1 0 0 2 0 0 3 0]";
    const std::string second =
        "Shape \"curve\" \"float width\" 1 \"point3 P\" [0 3 0 0 4 0 0 5 0 0 6 0]";
    // Vertices at thirds are straight segments, which are their ends.
    const StrandSet joined = readPbrt(first + '\n' + second);
    EXPECT_THAT(joined.ends, ElementsAre(3));
    EXPECT_THAT(
        joined.points, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(0, 3, 0), glm::vec3(0, 6, 0)));
    EXPECT_EQ(joined.widths.everywhere, 1.0f);
    EXPECT_THAT(
        readPbrt(first + "\nAttributeBegin\n" + second + "\nAttributeEnd").ends, ElementsAre(2, 4));
    std::string wider = second;
    wider.replace(wider.find("width\" 1"), 8, "width\" 2");
    EXPECT_THAT(readPbrt(first + wider).ends, ElementsAre(2, 4));
    EXPECT_THAT(readPbrt(second + first).ends, ElementsAre(2, 4));
}

TEST(Pbrt, PlacesCurvesByTheTransformsAroundThem) {
    const std::string curve =
        "Shape \"curve\" \"float width\" 1 \"point3 P\" [1 0 0 2 0 0 3 0 0 4 0 0]\n";
    const auto rootOf = [&](const std::string& before) {
        return readPbrt(before + '\n' + curve).points.front();
    };
    EXPECT_EQ(rootOf("Translate 1 2 3"), glm::vec3(2, 2, 3));
    expectNear(rootOf("Rotate 90 0 0 2"), {0, 1, 0});
    EXPECT_EQ(rootOf("Translate 1 0 0 Scale 2 3 4"), glm::vec3(3, 0, 0));
    EXPECT_EQ(rootOf("Translate 9 9 9 Identity"), glm::vec3(1, 0, 0));
    // The rows of the file's matrix are the columns of the map: x goes to y.
    EXPECT_EQ(rootOf("Transform [0 1 0 0  0 0 1 0  1 0 0 0  5 6 7 1]"), glm::vec3(5, 7, 7));
    EXPECT_EQ(
        rootOf("Translate 1 0 0 ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 0 1 0 1]"),
        glm::vec3(2, 1, 0));
    EXPECT_EQ(
        rootOf("AttributeBegin TransformBegin Scale 5 5 5 TransformEnd AttributeEnd"),
        glm::vec3(1, 0, 0));
    EXPECT_EQ(
        rootOf("LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" WorldBegin"), glm::vec3(1, 0, 0));
    EXPECT_EQ(*readPbrt("Scale 2 2 2 " + curve).widths.everywhere, 2.0f);
}

TEST(Pbrt, SkipsTheRestOfAScene) {
    const StrandSet set = readPbrt(
        "# a scene\n# of two lines\n"
        "Film \"rgb\" \"integer xresolution\" [ 100 ] \"bool savefp16\" true\n"
        "WorldBegin\nMakeNamedMaterial \"a\" \"string type\" \"hair\" \"float eumelanin\" 1.3\n"
        "Shape \"curve\" \"normal N\" [0 0 1 0 0 1] \"string type\" \"flat\" \"float splitdepth\" "
        "3\n"
        "  # the vertices\n  \"point3 P\" [0 0 0 0 1 0 0 2 0 0 3 0]\n"
        "Shape \"sphere\"\n");
    EXPECT_THAT(set.ends, ElementsAre(2));
    EXPECT_EQ(set.comment, "a scene\nof two lines");
    EXPECT_THAT(set.warnings, IsEmpty());
}

TEST(Pbrt, CountsWhatItLeavesOut) {
    const std::string good = "Shape \"curve\" \"point3 P\" [0 0 0 0 1 0 0 2 0 0 3 0]\n";
    const StrandSet set = readPbrt(
        "Include \"more.pbrt\"\nObjectBegin \"a\"\n" + good + "ObjectEnd\nObjectInstance \"a\"\n" +
        good + "Shape \"curve\" \"point3 P\" [0 0 0 0 nan 0 0 2 0 0 3 0]\n");
    EXPECT_THAT(set.ends, ElementsAre(2));
    EXPECT_THAT(
        set.warnings, ElementsAre(
                          "1 strand in objects (ObjectBegin) is left out",
                          "1 included files are left out: read each of them by itself",
                          leftOutStrand(kNoPosition, 1)));
}

TEST(Pbrt, RefusesOtherFiles) {
    const std::pair<const char*, const char*> kWrong[] = {
        {"", "line 1: the scene has no curves"},
        {"Shape \"sphere\"\n", "line 2: the scene has no curves"},
        {"Include \"a\"", "line 1: the scene has no curves, but it includes other files: read each "
                          "of them by itself"},
        {"12 13", "line 1: '12': a directive, such as Shape, is expected"},
        {"Shape \"curve", "line 1: a text has no end"},
        {"\nShape \"curve\" \"point3 P\" [0 0 0 1 1 1 2 2 2]",
         "line 2: 3 vertices, which do not make a bezier curve of degree 3"},
        {"Shape \"curve\" \"point3 P\" [0 0", "line 1: a list has no end"},
        {"Shape \"curve\" \"point3 P\" [0 0]", "line 1: 2 numbers are not whole vertices"},
        {"Shape \"curve\" \"point3 P\" 0", "line 1: the vertices P are not a list in brackets"},
        {"Shape \"curve\" \"integer degree\" 4 \"point3 P\" [0 0 0]",
         "line 1: a curve of the basis 'bezier' and the degree 4.00"},
        {"Shape \"curve\" \"string basis\" \"linear\"", "line 1: a curve of the basis 'linear'"},
        {"Shape \"curve\" \"float width\" [1 2]", "line 1: 'float width': one number is expected"},
        {"Shape \"curve\" \"width\"",
         "line 1: 'width' is not the type and the name of a parameter"},
        {"Shape \"curve\" \"float alpha\"", "line 1: 'float alpha' has no value"},
        {"AttributeBegin", "line 1: truncated: a block has no end"},
        {"AttributeBegin TransformEnd", "line 1: TransformEnd without TransformBegin"},
        {"Translate 1 2", "line 1: Translate needs 3 finite numbers"},
        {"Translate 1 2 inf", "line 1: Translate needs 3 finite numbers"},
        {"Rotate 1 0 0 0", "line 1: a rotation about no axis"},
        {"LookAt 0 0 1 0 0 0 0 1 0\nShape \"curve\" \"point3 P\" [0 0 0 0 1 0 0 2 0 0 3 0]",
         "line 2: the curve is placed by the LookAt or CoordSysTransform of line 1"}};
    for (const auto& [text, reason] : kWrong)
        EXPECT_THAT(readError(importPbrt, text), StartsWith(reason)) << text;
}

TEST(Pbrt, IsWrittenAsStraightSegments) {
    StrandSet set{.ends = {2, 4}, .points = {{0, 0, 0}, {0, 3, 0}, {0, 3, 0}, {6, 3, 0}}};
    set.widths.everywhere = 0.5f;
    set.comment = "two\nlines";
    EXPECT_EQ(
        writeText(exportPbrt, set).bytes,
        "# two\n# lines\n"
        "Shape \"curve\" \"string type\" \"cylinder\" \"float width\" 0.5 \"point3 P\" [ 0 0 0\n"
        "    0 1 0 0 2 0 0 3 0 ]\n"
        "AttributeBegin\n"
        "Shape \"curve\" \"string type\" \"cylinder\" \"float width\" 0.5 \"point3 P\" [ 0 3 0\n"
        "    2 3 0 4 3 0 6 3 0 ]\n"
        "AttributeEnd\n");
    const StrandSet back = readPbrt(writeText(exportPbrt, set).bytes);
    EXPECT_EQ(back.ends, set.ends);
    EXPECT_EQ(back.points, set.points);
    EXPECT_EQ(back.comment, set.comment);
    EXPECT_EQ(back.widths.everywhere, 0.5f);
}

TEST(Pbrt, SaysWhatItDoesNotHold) {
    StrandSet set{.ends = {2, 3}, .points = {{0, 0, 0}, {0, 3, 0}, {6, 3, 0}}};
    set.colors.everywhere = glm::vec3(1);
    EXPECT_THAT(
        writeText(exportPbrt, set).warnings,
        ElementsAre(HasSubstr("colours"), HasSubstr("1 strands of a single point")));
    set.ends = {1};
    EXPECT_EQ(
        errorText([&] { writeText(exportPbrt, set); }), "no strand has the two points of a curve");
}

}  // namespace
}  // namespace hair::groom
