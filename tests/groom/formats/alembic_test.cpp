#include <bit>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <sstream>

#include <gmock/gmock.h>

#include "hair/groom/formats/alembic_values.h"
#include "hair/groom/formats/formats.h"
#include "tests/error_text.h"
#include "tests/groom/formats/alembic_files.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/strand_files.h"
#include "tests/python.h"

namespace hair::groom {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::vector<float> kFivePoints{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0};

// Two linear curves, of 2 and 3 vertices.
std::vector<MadeProperty> twoCurves() {
    return {madeFloats("P", 3, kFivePoints), madeIntegers("nVertices", {2, 3}), madeKind(1, 0, 0)};
}

std::vector<MadeProperty> twoCurvesAnd(std::vector<MadeProperty> more) {
    std::vector<MadeProperty> all = twoCurves();
    for (MadeProperty& property : more) all.push_back(std::move(property));
    return all;
}

// Two curves with parameters in .arbGeomParams.
MadeObject twoCurvesWith(std::vector<MadeProperty> parameters) {
    return madeCurves(
        "strands", twoCurvesAnd({madeCompound(".arbGeomParams", std::move(parameters))}));
}

StrandSet readMade(std::vector<MadeObject> objects) {
    const StrandSet set = readText(importAlembic, madeArchive(std::move(objects)));
    EXPECT_EQ(brokenPromise(set), "");
    return set;
}

std::string madeError(std::vector<MadeObject> objects) {
    return readError(importAlembic, madeArchive(std::move(objects)));
}

// ---- Linear curves ------------------------------------------------------------------------------

TEST(Alembic, ReadsLinearCurvesWithWidths) {
    const StrandSet set =
        readMade({madeCurves("strands", twoCurvesAnd({madeFloats("width", 1, {1, 2, 3, 4, 5})}))});
    EXPECT_THAT(set.ends, ElementsAre(2, 5));
    EXPECT_EQ(set.points[1], glm::vec3(0, 1, 0));
    EXPECT_EQ(set.points[4], glm::vec3(1, 2, 0));
    EXPECT_THAT(set.widths.values, ElementsAre(1, 2, 3, 4, 5));
    EXPECT_FALSE(set.metres_per_unit);
    EXPECT_THAT(set.warnings, IsEmpty());
}

TEST(Alembic, ReadsCurvesThatSayNoKindAsLinear) {
    std::vector<MadeProperty> geometry = twoCurves();
    geometry.pop_back();
    EXPECT_THAT(readMade({madeCurves("a", geometry)}).ends, ElementsAre(2, 5));
}

TEST(Alembic, ReadsUnrealsParameters) {
    const StrandSet set = readMade({twoCurvesWith(
        {madeIntegers("groom_group_id", {7, -2}),
         {.name = "groom_guide", .type = kInt16, .samples = {Bytes().u16(0).u16(1).str()}},
         madeFloats("groom_root_uv", 2, {0.25f, 0.5f, 0.75f, 1}),
         madeFloats("groom_width", 1, {3}),
         madeFloats("groom_color", 3, {1, 0, 0, 0, 1, 0}),
         madeIntegers("groom_version_major", {1}),
         madeIntegers("groom_id", {8, 9})})});
    EXPECT_THAT(set.groups, ElementsAre(7, -2));
    EXPECT_THAT(set.guides, ElementsAre(0, 1));
    EXPECT_THAT(set.root_uvs, ElementsAre(glm::vec2(0.25f, 0.5f), glm::vec2(0.75f, 1)));
    EXPECT_EQ(set.widths.everywhere, 3.0f);
    // One colour for each curve, at its two or three points.
    EXPECT_THAT(
        set.colors.values, ElementsAre(
                               glm::vec3(1, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                               glm::vec3(0, 1, 0), glm::vec3(0, 1, 0)));
    EXPECT_THAT(set.warnings, ElementsAre("'groom_id': left out"));
}

TEST(Alembic, NumbersGroupsByTheirNamesWhereNothingElseDoes) {
    const auto named = [](std::string names) {
        return MadeProperty{.name = "groom_group_name", .type = kText, .samples = {names}};
    };
    MadeProperty values = named(std::string("fringe\0back\0", 12));
    values.name = ".vals";
    const MadeProperty indices{
        .name = ".indices", .type = kUint32, .samples = {Bytes().u32(1).u32(0).str()}};
    const StrandSet set = readMade(
        {twoCurvesWith({named(std::string("top\0back\0", 9))}),
         twoCurvesWith({named(std::string("back\0", 5))}),
         twoCurvesWith({madeCompound("groom_group_name", {values, indices})})});
    EXPECT_THAT(set.groups, ElementsAre(0, 1, 1, 1, 1, 2));
    EXPECT_THAT(set.warnings, IsEmpty());
    const StrandSet numbered = readMade(
        {twoCurvesWith({named(std::string("a\0b\0", 4)), madeIntegers("groom_group_id", {8, 9})})});
    EXPECT_THAT(numbered.groups, ElementsAre(8, 9));
    EXPECT_THAT(numbered.warnings, ElementsAre("'groom_group_name': left out"));
    EXPECT_THAT(madeError({twoCurvesWith({named("top")})}), HasSubstr("has no end"));
    EXPECT_THAT(
        madeError({twoCurvesWith({named(std::string("a\0b\0c\0", 6))})}),
        HasSubstr("one is expected, or one for each curve"));
}

TEST(Alembic, ReadsOneValueForAllCurvesAndScalars) {
    const StrandSet set = readMade({twoCurvesWith(
        {{.name = "groom_group_id", .kind = 1, .type = kInt32, .samples = {Bytes().u32(5).str()}},
         madeFloats("groom_root_uv", 2, {0.5f, 0.25f}),
         madeIntegers("groom_guide", {3})})});
    EXPECT_THAT(set.groups, ElementsAre(5, 5));
    EXPECT_THAT(set.guides, ElementsAre(1, 1));
    EXPECT_THAT(set.root_uvs, Each(glm::vec2(0.5f, 0.25f)));
}

TEST(Alembic, ReadsValuesByIndices) {
    const MadeProperty indices{
        .name = ".indices",
        .type = kUint32,
        .samples = {Bytes().u32(1).u32(0).u32(1).u32(1).u32(0).str()}};
    const auto width = [&](const MadeProperty& index) {
        return twoCurvesAnd(
            {madeCompound("width", {madeFloats(".vals", 1, {0.5f, 0.25f}), index})});
    };
    EXPECT_THAT(
        readMade({madeCurves("a", width(indices))}).widths.values,
        ElementsAre(0.25f, 0.5f, 0.25f, 0.25f, 0.5f));
    MadeProperty wrong = indices;
    wrong.samples = {Bytes().u32(1).u32(0).u32(2).u32(1).u32(0).str()};
    EXPECT_THAT(
        madeError({madeCurves("a", width(wrong))}),
        AllOf(StartsWith("byte "), HasSubstr("/a/.geom/width/.vals: index 2 of 2 values")));
}

TEST(Alembic, TakesRootUvsFromUvsOfCurvesAlone) {
    const auto uv = [](std::vector<float> values) {
        return madeCurves("a", twoCurvesAnd({madeFloats("uv", 2, std::move(values))}));
    };
    EXPECT_THAT(
        readMade({uv({0, 1, 2, 3})}).root_uvs, ElementsAre(glm::vec2(0, 1), glm::vec2(2, 3)));
    const StrandSet of_vertices = readMade({uv({0, 1, 2, 3, 4, 5, 6, 7, 8, 9})});
    EXPECT_THAT(of_vertices.root_uvs, IsEmpty());
    EXPECT_THAT(of_vertices.warnings, ElementsAre("'uv': left out"));
}

TEST(Alembic, ReadsTheFirstSampleOfWhatMoves) {
    std::vector<MadeProperty> geometry = twoCurves();
    std::string moved = geometry[0].samples[0];
    moved[3] = '\x40';
    geometry[0].samples.push_back(moved);
    geometry[0].samples.push_back(geometry[0].samples[0]);
    const StrandSet set = readMade({madeCurves("a", geometry), madeCurves("b", geometry)});
    EXPECT_EQ(set.points[0], glm::vec3(0));
    EXPECT_THAT(set.warnings, ElementsAre("/a and of 1 more: the first sample of 3 is read"));
}

// ---- Several objects ----------------------------------------------------------------------------

TEST(Alembic, JoinsObjectsAndWhatAllOfThemHave) {
    const StrandSet set = readMade(
        {madeCurves(
             "a", twoCurvesAnd(
                      {madeFloats("width", 1, {2}),
                       madeCompound(
                           ".arbGeomParams", {madeIntegers("groom_guide", {1}),
                                              madeIntegers("groom_group_id", {4})})})),
         madeCurves("b", twoCurvesAnd({madeFloats("width", 1, {1, 2, 3, 4, 5})}))});
    EXPECT_THAT(set.ends, ElementsAre(2, 5, 7, 10));
    EXPECT_EQ(set.points[9], glm::vec3(1, 2, 0));
    EXPECT_THAT(set.widths.values, ElementsAre(2, 2, 2, 2, 2, 1, 2, 3, 4, 5));
    EXPECT_THAT(set.guides, ElementsAre(1, 1, 0, 0));
    EXPECT_THAT(set.groups, ElementsAre(4, 4, 5, 5));
    EXPECT_THAT(set.warnings, ElementsAre("2 of 4 strands have no group and become group 5"));
}

// A quarter turn about z takes x to y. The order is scale, turn, translation; the last in the list
// comes first.
TEST(Alembic, PlacesCurvesByTheTransformsAboveThem) {
    const std::string operations = "\x10\x60\x01";  // translation, turn about z, scale
    const StrandSet set = readMade({madeTransform(
        "up", "\x10", {0, 0, 10},
        {madeTransform(
            "hair", operations, {1, 2, 3, 90, 2, 2, 2},
            {madeCurves("a", twoCurvesAnd({madeFloats("width", 1, {0.25f})}))})})});
    // (1, 2, 0) to (2, 4, 0) to (-4, 2, 0) to (-3, 4, 3) to (-3, 4, 13)
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(set.points[4][axis], glm::vec3(-3, 4, 13)[axis], 1e-6f) << axis;
    EXPECT_FLOAT_EQ(*set.widths.everywhere, 0.5f);
}

// The same turn of 120 degrees about (1, 1, 1), which takes x to y, y to z and z to x.
TEST(Alembic, TurnsAboutAnAxisAsByAMatrix) {
    const StrandSet turned = readMade(
        {madeTransform("a", "\x20", {1, 1, 1, 120}, {madeCurves("strands", twoCurves())})});
    const StrandSet by_matrix = readMade({madeTransform(
        "a", "\x30", {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1},
        {madeCurves("strands", twoCurves())})});
    EXPECT_EQ(by_matrix.points[4], glm::vec3(0, 1, 2));
    for (std::size_t i = 0; i < 5; ++i)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(turned.points[i][axis], by_matrix.points[i][axis], 1e-6f) << i;
}

TEST(Alembic, LeavesOutTransformsThatAreNotInherited) {
    const MadeProperty alone{
        .name = ".inherits", .kind = 1, .type = kBool, .samples = {Bytes().u8(0).str()}};
    const StrandSet set = readMade({madeTransform(
        "far", "\x10", {0, 0, 100},
        {madeTransform("hair", "\x10", {1, 0, 0}, {madeCurves("a", twoCurves())}, {alone})})});
    EXPECT_EQ(set.points[4], glm::vec3(2, 2, 0));
}

TEST(Alembic, InheritsGroomParametersOfTransforms) {
    const MadeProperty parameters = madeCompound(
        ".arbGeomParams",
        {madeIntegers("groom_group_id", {3}), madeIntegers("groom_guide", {1}),
         madeFloats("groom_width", 1, {0.5f}), madeIntegers("groom_version_major", {2})});
    const StrandSet set = readMade({madeTransform(
        "hair", "\x10", {0, 0, 0},
        {twoCurvesWith({}), twoCurvesWith({madeIntegers("groom_group_id", {8, 9})})},
        {parameters})});
    EXPECT_THAT(set.groups, ElementsAre(3, 3, 8, 9));
    EXPECT_THAT(set.guides, Each(1));
    EXPECT_EQ(set.widths.everywhere, 0.5f);
    EXPECT_THAT(set.warnings, ElementsAre(HasSubstr("version 2 of Unreal's groom schema")));
}

TEST(Alembic, NamesWhatItLeavesOut) {
    const MadeObject mesh{
        .name = "head",
        .metadata = "schema=AbcGeom_PolyMesh_v1",
        .children = {madeCurves("hair", twoCurvesAnd({madeFloats("N", 3, kFivePoints)}))}};
    EXPECT_THAT(readMade({mesh}).warnings, ElementsAre("'AbcGeom_PolyMesh_v1', 'N': left out"));
    EXPECT_THAT(
        madeError({{.name = "head", .metadata = "schema=AbcGeom_PolyMesh_v1"}}),
        "byte 0: the archive has no curves; it has 'AbcGeom_PolyMesh_v1'");
}

// ---- Cubic curves -------------------------------------------------------------------------------

StrandSet readCubic(std::uint32_t basis, std::vector<float> points, std::vector<int> sizes) {
    return readMade({madeCurves(
        "a", {madeFloats("P", 3, std::move(points)),
              madeIntegers("nVertices", {sizes.begin(), sizes.end()}), madeKind(0, 0, basis)})});
}

// The curve of (0, 0), (0, 1), (1, 1), (1, 0) is (3 t^2 - 2 t^3, 3 t - 3 t^2).
TEST(AlembicCubic, BezierCurvesAreTheirPolynomial) {
    const StrandSet set = readCubic(1, {0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0}, {4});
    ASSERT_THAT(set.ends, ElementsAre(4));
    for (int k = 0; k < 4; ++k) {
        const double t = k / 3.0;
        const auto point = set.points[static_cast<std::size_t>(k)];
        EXPECT_FLOAT_EQ(point.x, static_cast<float>(t * t * (3 - 2 * t))) << k;
        EXPECT_FLOAT_EQ(point.y, static_cast<float>(3 * t * (1 - t))) << k;
    }
}

// A uniform B-spline keeps lines, and begins at (p0 + 4 p1 + p2) / 6.
TEST(AlembicCubic, BsplinesBeginBetweenVerticesAndKeepLines) {
    const StrandSet line = readCubic(2, {0, 0, 0, 1, 2, 0, 2, 4, 0, 3, 6, 0, 4, 8, 0}, {5});
    ASSERT_THAT(line.ends, ElementsAre(5));
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_FLOAT_EQ(line.points[k].x, 1.0f + 0.5f * static_cast<float>(k));
        EXPECT_FLOAT_EQ(line.points[k].y, 2.0f * line.points[k].x);
    }
    const StrandSet bent = readCubic(2, {0, 0, 0, 1, 0, 0, 1, 6, 0, 0, 0, 12}, {4});
    EXPECT_FLOAT_EQ(bent.points.front().x, 5.0f / 6);
    EXPECT_FLOAT_EQ(bent.points.front().y, 1.0f);
    EXPECT_FLOAT_EQ(bent.points.back().y, 4.0f);
    EXPECT_FLOAT_EQ(bent.points.back().z, 2.0f);
}

TEST(AlembicCubic, CatmullRomCurvesRunThroughTheirVertices) {
    const std::vector<float> points{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0};
    const StrandSet set = readCubic(3, points, {2, 3});
    EXPECT_THAT(set.ends, ElementsAre(2, 5));
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_EQ(set.points[i], glm::vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]));
}

// With double vertices at each end, the whole curve of the inner vertices is drawn: five vertices
// make two segments fewer.
TEST(AlembicCubic, CatmullRomCurvesWithDoubledEndsAreDrawnBetweenThem) {
    const StrandSet set = readCubic(3, {0, 0, 0, 0, 0, 0, 2, 0, 0, 2, 2, 0, 2, 2, 0}, {5});
    ASSERT_THAT(set.ends, ElementsAre(5));
    EXPECT_EQ(set.points[0], glm::vec3(0));
    EXPECT_EQ(set.points[2], glm::vec3(2, 0, 0));
    EXPECT_EQ(set.points[4], glm::vec3(2, 2, 0));
    // At t = 1/2 the weights are (-1, 9, 9, -1) / 16.
    EXPECT_EQ(set.points[1], glm::vec3(1, -0.125f, 0));
}

TEST(AlembicCubic, WidthsFollowTheCurveOrItsSegments) {
    const auto widths = [](std::vector<float> values) {
        return readMade({madeCurves(
                            "a", {madeFloats("P", 3, {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}),
                                  madeIntegers("nVertices", {4}), madeKind(0, 0, 1),
                                  madeFloats("width", 1, std::move(values))})})
            .widths;
    };
    // 8 (1 - t)^3 at thirds, and linear from end to end.
    const auto of_vertices = widths({8, 0, 0, 0}).values;
    ASSERT_EQ(of_vertices.size(), 4u);
    EXPECT_FLOAT_EQ(of_vertices[1], 64.0f / 27);
    EXPECT_FLOAT_EQ(of_vertices[2], 8.0f / 27);
    const auto of_ends = widths({9, 3}).values;
    ASSERT_EQ(of_ends.size(), 4u);
    EXPECT_FLOAT_EQ(of_ends[1], 7.0f);
    EXPECT_FLOAT_EQ(of_ends[3], 3.0f);
}

// Knots and orders of curves, which are of type 2 (of variable order).
std::vector<MadeProperty> withKnots(
    std::vector<float> points, std::vector<std::int32_t> sizes, std::vector<float> knots,
    const std::string& orders) {
    return {
        madeFloats("P", 3, std::move(points)),
        madeIntegers("nVertices", std::move(sizes)),
        madeKind(2, 0, 2),
        madeFloats(".knots", 1, std::move(knots)),
        {.name = ".orders", .type = kUint8, .samples = {orders}}};
}

// Knots of 4 at either end make the Bezier curve, those at even distances the uniform B-spline.
TEST(AlembicNurbs, AreBezierCurvesAndBsplinesWithTheirKnots) {
    const std::vector<float> points{0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0};
    for (const auto& [knots, basis] :
         {std::pair{std::vector<float>{0, 0, 0, 0, 1, 1, 1, 1}, 1u},
          std::pair{std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7}, 2u}}) {
        const StrandSet by_knots = readMade({madeCurves("a", withKnots(points, {4}, knots, "\4"))});
        const StrandSet by_basis = readCubic(basis, points, {4});
        ASSERT_EQ(by_knots.ends, by_basis.ends);
        for (std::size_t i = 0; i < 4; ++i)
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(by_knots.points[i][axis], by_basis.points[i][axis], 1e-7f) << i;
    }
}

// With vertices at the means of order - 1 knots (Greville's abscissae) a curve is its parameter.
TEST(AlembicNurbs, KeepTheirParameterWithVerticesAtMeansOfKnots) {
    const std::vector<float> cubic{0, 0, 0, 0, 1, 1.5f, 1.5f, 4, 4, 4, 4};
    const std::vector<float> quadratic{-1, 0, 2, 3, 7, 9};
    std::vector<float> points;
    for (std::size_t i = 0; i < 7; ++i) {
        const float mean = (cubic[i + 1] + cubic[i + 2] + cubic[i + 3]) / 3;
        points.insert(points.end(), {mean, 2 * mean, 1});
    }
    for (std::size_t i = 0; i < 3; ++i)
        points.insert(points.end(), {(quadratic[i + 1] + quadratic[i + 2]) / 2, 0, 0});
    points.insert(points.end(), {5, 6, 7, 8, 9, 10});  // a line
    std::vector<float> knots = cubic;
    knots.insert(knots.end(), quadratic.begin(), quadratic.end());
    knots.insert(knots.end(), {0, 0, 1, 1});
    const StrandSet set =
        readMade({madeCurves("a", withKnots(points, {7, 3, 2}, knots, "\4\3\2"))});
    // The cubic curve has segments from 0 to 1, 1.5 and 4, each in 2 pieces like those of the
    // others.
    ASSERT_THAT(set.ends, ElementsAre(7, 10, 13));
    const float cubic_expected[] = {0, 0.5f, 1, 1.25f, 1.5f, 2.75f, 4};
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_NEAR(set.points[i].x, cubic_expected[i], 1e-6f) << i;
        EXPECT_NEAR(set.points[i].y, 2 * cubic_expected[i], 1e-6f) << i;
        EXPECT_NEAR(set.points[i].z, 1, 1e-6f) << i;
    }
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(set.points[7 + i].x, 2 + 0.5f * static_cast<float>(i), 1e-6f) << i;
    EXPECT_EQ(set.points[10], glm::vec3(5, 6, 7));
    EXPECT_EQ(set.points[12], glm::vec3(8, 9, 10));
}

TEST(AlembicNurbs, WithOtherKnotsAreRefused) {
    const std::vector<float> points{0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0};
    const auto error = [&](std::vector<float> knots, const std::string& orders) {
        return madeError({madeCurves("a", withKnots(points, {4}, std::move(knots), orders))});
    };
    EXPECT_EQ(error({0, 0, 0, 0, 1, 1, 1, 1}, "\4"), "no error");
    EXPECT_THAT(
        error({0, 0, 0, 0, 1, 1, 1}, "\4"),
        AllOf(HasSubstr("/a/.geom/.knots"), HasSubstr("curve 0 has too few knots")));
    EXPECT_THAT(
        error({0, 0, 0, 0, 1, 1, 1, 1, 1}, "\4"), HasSubstr("9 knots, but the curves have 8"));
    EXPECT_THAT(error({0, 0, 0, 1, 0, 1, 1, 1}, "\4"), HasSubstr("knots that decrease"));
    EXPECT_THAT(error({1, 1, 1, 1, 1, 1, 1, 1}, "\4"), HasSubstr("knots that are all equal"));
    EXPECT_THAT(error({0, 0, 0, 0, 0, 1, 1, 1, 1}, "\5"), HasSubstr("too few for order 5"));
    EXPECT_THAT(error({0, 0, 0, 0, 1}, "\1"), HasSubstr("has the order 1"));
    EXPECT_THAT(error({0, 0, 0, 0, 1, 1, 1, 1}, "\4\4"), HasSubstr("2 orders of 1 curves"));
}

TEST(AlembicCubic, OthersAreRefusedWithWhatToDo) {
    const auto error = [](std::uint32_t type, std::uint32_t wrap, std::uint32_t basis,
                          std::vector<MadeProperty> more = {}) {
        std::vector<MadeProperty> geometry{
            madeFloats("P", 3, kFivePoints), madeIntegers("nVertices", {5}),
            madeKind(type, wrap, basis)};
        for (MadeProperty& property : more) geometry.push_back(property);
        return madeError({madeCurves("a", geometry)});
    };
    EXPECT_THAT(error(1, 1, 0), HasSubstr("closed (periodic)"));
    EXPECT_THAT(error(2, 0, 2), AllOf(HasSubstr("without knots"), HasSubstr("as linear curves")));
    EXPECT_THAT(error(7, 0, 2), HasSubstr("the unknown type 7"));
    EXPECT_THAT(error(0, 0, 0), HasSubstr("no basis: export them as linear"));
    EXPECT_THAT(error(0, 0, 4), HasSubstr("Hermite"));
    EXPECT_THAT(error(0, 0, 5), HasSubstr("power"));
    EXPECT_THAT(error(0, 0, 9), HasSubstr("the basis 9"));
    EXPECT_THAT(error(0, 0, 1), HasSubstr("curve 0 has 5 vertices, which do not make a cubic B"));
    EXPECT_THAT(error(0, 0, 2, {madeFloats("w", 1, {1, 2, 1, 1, 1})}), HasSubstr("rational"));
    EXPECT_EQ(error(0, 0, 2, {madeFloats("w", 1, {1, 1, 1, 1, 1})}), "no error");
}

// ---- What is refused ----------------------------------------------------------------------------

TEST(Alembic, RefusesValuesThatDoNotFit) {
    const auto with = [](std::vector<MadeProperty> more) {
        return madeError({madeCurves("a", twoCurvesAnd(std::move(more)))});
    };
    const auto parameter = [](MadeProperty property) {
        return madeError({twoCurvesWith({std::move(property)})});
    };
    EXPECT_THAT(
        with({madeFloats("width", 1, {1, 2, 3})}),
        AllOf(
            HasSubstr("/a/.geom/width: 3 values, expected 1, one for each of 2 curves"),
            HasSubstr("or of 5 vertices")));
    EXPECT_THAT(with({madeFloats("width", 3, {1, 2, 3})}), HasSubstr("expected 1 \xc3\x97 float"));
    EXPECT_THAT(with({madeIntegers("width", {1})}), HasSubstr("int32"));
    EXPECT_THAT(with({madeKind(1, 0, 0)}), HasSubstr("'curveBasisAndType' appears twice"));
    EXPECT_THAT(
        parameter(madeIntegers("groom_group_id", {1, 2, 3, 4, 5})),
        HasSubstr("one for each curve"));
    EXPECT_THAT(parameter(madeFloats("groom_guide", 1, {1})), HasSubstr("expected integers"));
    EXPECT_THAT(
        parameter({.name = "groom_guide", .type = kUint32, .samples = {Bytes().u32(~0u).str()}}),
        HasSubstr("4294967295 is not an int32"));
    EXPECT_THAT(
        parameter(madeFloats("groom_root_uv", 2, {0, 0, 0, 0, 0, 0})),
        HasSubstr("one is expected for each curve"));
    EXPECT_THAT(
        parameter(madeFloats("groom_color", 2, {1, 2})), HasSubstr("expected 3 \xc3\x97 float"));

    const auto curves = [](std::vector<float> points, std::vector<std::int32_t> sizes) {
        return madeError({madeCurves(
            "a", {madeFloats("P", 3, std::move(points)), madeIntegers("nVertices", sizes)})});
    };
    EXPECT_THAT(curves(kFivePoints, {2, 2}), HasSubstr("5 positions, but nVertices are 4"));
    EXPECT_THAT(curves(kFivePoints, {6, -1}), HasSubstr("curve 1 has -1 vertices"));
    EXPECT_THAT(
        madeError({madeCurves("a", {madeFloats("P", 3, kFivePoints)})}),
        HasSubstr("positions without nVertices"));
    EXPECT_THAT(
        madeError({{.name = "a", .metadata = "schema=AbcGeom_Curve_v1"}}),
        HasSubstr("expected AbcGeom_Curve_v2"));
    EXPECT_THAT(
        madeError({{.name = "a", .metadata = "schema=AbcGeom_Curve_v2"}}),
        HasSubstr("there is no '.geom'"));
}

TEST(Alembic, LeavesOutStrandsThatCantBeUsed) {
    const auto curves = [](std::vector<float> points, std::vector<std::int32_t> sizes) {
        return readMade({madeCurves(
            "a", {madeFloats("P", 3, std::move(points)), madeIntegers("nVertices", sizes)})});
    };
    for (const float wrong : kNotFinite) {
        std::vector<float> points = kFivePoints;
        points[7] = wrong;
        const StrandSet set = curves(points, {2, 3});
        EXPECT_THAT(set.ends, ElementsAre(2));
        EXPECT_THAT(
            set.warnings,
            ElementsAre(warningOf(
                {.reason = "with a position that is not finite", .count = 1, .first = 1})));
    }
    const StrandSet set = curves(kFivePoints, {4, 0, 1});
    EXPECT_THAT(set.ends, ElementsAre(4));
    EXPECT_THAT(
        set.warnings, ElementsAre(
                          warningOf({.reason = "without points", .count = 1, .first = 1}),
                          warningOf({.reason = "of a single point", .count = 1, .first = 2})));
}

// A curve of one vertex among cubic ones.
TEST(AlembicCubic, LeavesOutCurvesOfOneVertex) {
    const StrandSet set = readCubic(2, {9, 9, 9, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0}, {1, 4});
    EXPECT_THAT(set.ends, ElementsAre(4));
    EXPECT_FLOAT_EQ(set.points.front().y, 1.0f);  // a B-spline along a line of even vertices
    EXPECT_FLOAT_EQ(set.points.back().y, 2.0f);
    EXPECT_THAT(
        set.warnings,
        ElementsAre(warningOf({.reason = "of a single point", .count = 1, .first = 0})));
}

// Alembic's ObjectVisibility is a scalar int8 beside the schema's properties.
TEST(Alembic, LeavesOutCurvesThatAreHidden) {
    const auto visibility = [](std::int8_t code) {
        return MadeProperty{
            .name = "visible", .kind = 1, .type = 2, .samples = {std::string(1, char(code))}};
    };
    const auto with = [](MadeObject object, MadeProperty more) {
        object.properties.push_back(std::move(more));
        return object;
    };
    const MadeObject curves = madeCurves("a", twoCurves());
    MadeObject shown_below = madeTransform(
        "t", "\x10", {1, 2, 3}, {madeCurves("a", twoCurves()), with(curves, visibility(1))});
    shown_below.children.back().name = "b";
    const StrandSet set =
        readMade({with(shown_below, visibility(0)), madeCurves("c", twoCurves())});
    EXPECT_EQ(set.strandCount(), 4u);  // of b, which overrides the transform, and of c
    EXPECT_EQ(set.points[0], glm::vec3(1, 2, 3));
    EXPECT_THAT(set.warnings, ElementsAre("2 strands of hidden objects are left out"));
    EXPECT_EQ(readMade({with(curves, visibility(-1))}).strandCount(), 2u);
    EXPECT_THAT(
        madeError({with(curves, visibility(0))}), HasSubstr("the archive has only hidden curves"));
}

// Blender writes an object's custom properties as arrays of one value in .userProperties.
TEST(Alembic, ReadsGroupsOfUserProperties) {
    const auto own = [](std::int32_t group) {
        return twoCurvesAnd({madeCompound(
            ".userProperties",
            {madeIntegers("groom_group_id", {group}), madeIntegers("cycles_samples", {3})})});
    };
    const StrandSet set = readMade({madeCurves("a", own(4)), madeCurves("b", own(6))});
    EXPECT_THAT(set.groups, ElementsAre(4, 4, 6, 6));
    EXPECT_THAT(set.warnings, ElementsAre("'userProperties:cycles_samples': left out"));
}

TEST(Alembic, RefusesTransformsThatAreNone) {
    const auto error = [](const std::string& operations, std::vector<double> numbers) {
        return madeError({madeTransform("t", operations, numbers, {madeCurves("a", twoCurves())})});
    };
    EXPECT_THAT(error("\x10", {1, 2}), HasSubstr("2 numbers of double, expected 3 doubles"));
    EXPECT_THAT(error("\x70", {1}), HasSubstr("the unknown operation 7"));
    EXPECT_THAT(error("\x20", {0, 0, 0, 5}), HasSubstr("about no axis"));
    EXPECT_THAT(
        error("\x30", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 1}), HasSubstr("projection"));
    EXPECT_THAT(
        error("\x10", {1, std::numeric_limits<double>::infinity(), 0}),
        HasSubstr("/t/.xform/.vals: number 1 is not finite"));
    EXPECT_THAT(
        error(std::string("\0", 1), {1e39, 1e39, 1e39}), HasSubstr("no strand can be used"));
}

// ---- Archives -----------------------------------------------------------------------------------

TEST(Ogawa, RefusesOtherHeaders) {
    const std::string whole = madeArchive({madeCurves("a", twoCurves())});
    EXPECT_THAT(readError(importAlembic, patched(whole, 5, '\0')), HasSubstr("was not finished"));
    EXPECT_THAT(readError(importAlembic, patched(whole, 7, '\2')), HasSubstr("version"));
    EXPECT_THAT(
        readError(importAlembic, patched(whole, 8, std::uint64_t{0})), HasSubstr("no root group"));
    EXPECT_THAT(
        readError(importAlembic, patched(whole, 8, std::uint64_t{8})), HasSubstr("overlaps"));
    EXPECT_THAT(
        readError(importAlembic, patched(whole, 8, std::uint64_t{whole.size()})),
        HasSubstr("truncated"));
    EXPECT_THAT(readError(importAlembic, "HDF5"), HasSubstr("begins with \"Ogawa\""));
}

TEST(Ogawa, RefusesGroupsThatHoldThemselvesOrAreShared) {
    const auto archiveOf = [](const auto& make) {
        MadeArchive archive;
        return archive.finish(make(archive));
    };
    const std::string headers =
        Bytes().u32(1).text("a").u8(0).u32(1).text("b").u8(0).zeros(32).str();
    const std::string twice = archiveOf([&](MadeArchive& archive) {
        const std::uint64_t child = archive.object({});
        const std::uint64_t data = archive.data(headers);
        return archive.group({0, child, child, data});
    });
    EXPECT_THAT(readError(importAlembic, twice), HasSubstr("part of two, or of itself"));

    const std::string one = Bytes().u32(1).text("a").u8(0).zeros(32).str();
    const std::string itself = archiveOf([&](MadeArchive& archive) {
        const std::uint64_t data = archive.data(one);
        const std::uint64_t own = (data & ~MadeArchive::kData) + 8 + one.size();
        EXPECT_EQ(archive.group({0, own, data}), own);
        return own;
    });
    EXPECT_THAT(readError(importAlembic, itself), HasSubstr("part of two, or of itself"));
}

TEST(Ogawa, RefusesMoreThan64Levels) {
    const auto nested = [](int levels) {
        MadeObject inner = madeCurves("a", twoCurves());
        for (int i = 1; i < levels; ++i) inner = {.name = "a", .children = {inner}};
        return readError(importAlembic, madeArchive({inner}));
    };
    EXPECT_EQ(nested(64), "no error");
    EXPECT_THAT(nested(65), HasSubstr("more than 64 levels"));
}

// Counts of headers, of samples and of elements.
TEST(Ogawa, RefusesCountsThatTheFileDoesNotBearOut) {
    MadeArchive archive;
    const std::uint64_t data = archive.data(Bytes().u32(4).text("abcd").u8(0).zeros(32).str());
    EXPECT_THAT(
        readError(importAlembic, archive.finish(archive.group({0, data}))),
        HasSubstr("more headers than the 0 objects"));

    MadeProperty half = madeFloats("P", 3, kFivePoints);
    half.samples[0].pop_back();
    EXPECT_THAT(
        madeError({madeCurves("a", {half, madeIntegers("nVertices", {2, 3})})}),
        HasSubstr("which is not a multiple of 12"));
    MadeProperty scalar = madeFloats("P", 3, kFivePoints);
    scalar.kind = 1;
    EXPECT_THAT(
        madeError({madeCurves("a", {scalar, madeIntegers("nVertices", {2, 3})})}),
        HasSubstr("a scalar of 5"));
}

// Equal objects may share their samples, but a small file may not make millions of objects.
TEST(Ogawa, ReadsSharedSamplesWithinBounds) {
    const auto shared = [](std::uint32_t objects, std::uint32_t points) {
        MadeArchive archive;
        const std::uint64_t positions =
            archive.data(std::string(16, 'k') + std::string(std::size_t{12} * points, '\0'));
        const std::uint64_t sizes = archive.data(std::string(16, 'k') + Bytes().u32(points).str());
        const std::string headers = Bytes()
                                        .u32(2 | 10 << 4 | 0x800 | 3 << 12)
                                        .u8(1)
                                        .u8(1)
                                        .text("P")
                                        .u32(2 | 6 << 4 | 0x800 | 1 << 12)
                                        .u8(1)
                                        .u8(9)
                                        .text("nVertices")
                                        .str();
        Bytes names;
        std::vector<std::uint64_t> children{0};
        const std::string schema = "schema=AbcGeom_Curve_v2";
        for (std::uint32_t i = 0; i < objects; ++i) {
            const std::uint64_t geometry = archive.group(
                {archive.group({positions, MadeArchive::kData}),
                 archive.group({sizes, MadeArchive::kData}), archive.data(headers)});
            const std::uint64_t own =
                archive.group({geometry, archive.data(Bytes().u32(0).u8(5).text(".geom").str())});
            children.push_back(archive.group({own, archive.data(std::string(32, '\0'))}));
            names.u32(1).text("a").u8(0xff).u32(static_cast<std::uint32_t>(schema.size()));
            names.text(schema);
        }
        children.push_back(archive.data(names.zeros(32).str()));
        return archive.finish(archive.group(children));
    };
    EXPECT_EQ(readText(importAlembic, shared(10, 1000)).points.size(), 10'000u);
    EXPECT_THAT(readError(importAlembic, shared(100, 1000)), HasSubstr("more than 16 times over"));
}

// ---- Damage -------------------------------------------------------------------------------------

std::vector<std::string> wholeArchives() {
    StrandSet strands = hardStrands();
    strands.transparencies = {};
    strands.groups = {1, 2, 3};
    strands.guides = {0, 1, 0};
    strands.root_uvs.resize(3);
    strands.comment = "a comment";
    strands.metres_per_unit = 0.01;
    strands.root_triangles = {{0, 1, 2}};
    return {
        writeText(exportAlembic, strands).bytes,
        madeArchive({madeTransform(
            "t", "\x10\x20", {1, 2, 3, 0, 0, 1, 30},
            {madeCurves(
                "a", twoCurvesAnd(
                         {madeFloats("width", 1, {1, 2, 3, 4, 5}),
                          madeCompound(
                              ".arbGeomParams", {madeIntegers("groom_group_id", {1, 2})})}))})}),
        textOf(corpus("abc/alembic_groom.abc")), textOf(corpus("abc/blender_catmull_rom.abc"))};
}

// The root group is the last of an archive, so a cut archive lacks a part of it.
TEST(AlembicDamage, IsRefusedWhereverItEnds) {
    for (const std::string& whole : wholeArchives())
        for (std::size_t size = 0; size < whole.size(); ++size)
            ASSERT_THAT(readError(importAlembic, whole.substr(0, size)), StartsWith("byte "))
                << size << " of " << whole.size();
}

const testing::Matcher<const char*> kRefusal =
    testing::AnyOf(StartsWith("byte "), StartsWith("no strand can be used; "));

TEST(AlembicDamage, IsRefusedOrReadWithAnyByteChanged) {
    for (const std::string& whole : wholeArchives()) {
        for (std::size_t i = 0; i < whole.size(); ++i) {
            for (const int change : {0x01, 0x10, 0x80, 0xff}) {
                std::string damaged = whole;
                damaged[i] = static_cast<char>(damaged[i] ^ change);
                try {
                    ASSERT_EQ(brokenPromise(readText(importAlembic, damaged)), "") << i;
                } catch (const engine::Error& error) {
                    ASSERT_THAT(error.what(), kRefusal) << i;
                }
            }
        }
    }
}

TEST(AlembicDamage, OffsetsAndCountsOfAnySizeAreRefusedOrRead) {
    constexpr std::uint64_t kWrong[] = {
        0, 1, 8, 16, 0x7fffffffffffffff, 0x8000000000000000, 0x8000000000000001, ~0ull, 1ull << 61};
    for (const std::string& whole : wholeArchives())
        for (std::size_t i = 0; i + 8 <= whole.size(); ++i)
            for (const std::uint64_t wrong : kWrong) {
                try {
                    const StrandSet set = readText(importAlembic, patched(whole, i, wrong));
                    ASSERT_EQ(brokenPromise(set), "") << i;
                } catch (const engine::Error& error) {
                    ASSERT_THAT(error.what(), kRefusal) << i;
                }
            }
}

// ---- Writing ------------------------------------------------------------------------------------

TEST(AlembicExport, ReadsBackEqualToTheLastBit) {
    StrandSet strands = hardStrands();
    strands.groups = {-5, 1, 2};
    strands.guides = {0, 1, 0};
    strands.root_uvs = {{0.1f, -0.0f}, {1.0f / 3.0f, 1e-45f}, {1, 2}};
    strands.root_triangles = {{0, 1, 2}, {2, 1, 0}};
    strands.metres_per_unit = 0.0254;
    strands.comment = "two\nlines; of=\xc3\xa9 text";
    const Written written = writeText(exportAlembic, strands);
    EXPECT_THAT(written.warnings, ElementsAre(HasSubstr("transparencies")));
    const StrandSet read = readText(importAlembic, written.bytes);
    EXPECT_EQ(read.ends, strands.ends);
    expectBitEqual(read.points, strands.points);
    expectBitEqual(read.widths.values, strands.widths.values);
    expectBitEqual(read.colors.values, strands.colors.values);
    expectBitEqual(read.root_uvs, strands.root_uvs);
    EXPECT_EQ(read.groups, strands.groups);
    EXPECT_EQ(read.guides, strands.guides);
    EXPECT_EQ(read.root_triangles, strands.root_triangles);
    EXPECT_EQ(read.metres_per_unit, strands.metres_per_unit);
    EXPECT_EQ(read.comment, strands.comment);
    EXPECT_THAT(read.warnings, IsEmpty());
    EXPECT_EQ(writeText(exportAlembic, read).bytes, written.bytes);
}

TEST(AlembicExport, HasOneValueWhereAllAreOne) {
    StrandSet strands{
        .ends = {2, 4},
        .points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
        .widths = {.everywhere = 0.5f},
        .colors = {.everywhere = glm::vec3(0.25f, 0.5f, 1)}};
    const StrandSet read = readText(importAlembic, writeText(exportAlembic, strands).bytes);
    EXPECT_EQ(read.widths.everywhere, 0.5f);
    EXPECT_EQ(read.colors.everywhere, glm::vec3(0.25f, 0.5f, 1));
    EXPECT_THAT(read.ends, ElementsAre(2, 4));
    EXPECT_EQ(errorText([] { writeText(exportAlembic, {}); }), "there are no strands");
}

// Each of our samples has the hash that Alembic's own library wrote for the same numbers.
TEST(AlembicExport, HasTheHashesOfAlembicsLibrary) {
    const std::string library = textOf(corpus("abc/alembic_groom.abc"));
    const StrandSet strands = readText(importAlembic, library);
    const std::string ours = writeText(exportAlembic, strands).bytes;
    const auto expectSame = [&](std::string_view numbers) {
        const std::size_t there = library.find(numbers);
        const std::size_t here = ours.find(numbers);
        ASSERT_NE(there, std::string::npos);
        ASSERT_NE(here, std::string::npos);
        EXPECT_EQ(ours.substr(here - 16, 16), library.substr(there - 16, 16));
    };
    const auto textIn = [](const auto& elements) {
        const auto bytes = std::as_bytes(std::span(elements));
        return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    expectSame(textIn(strands.points));
    expectSame(textIn(strands.widths.values));
    expectSame(textIn(strands.colors.values));
    expectSame(textIn(strands.groups));
    expectSame(textIn(strands.root_uvs));
}

// Epic's groom_id: the strands' numbers, as an array parameter of one int32 for each curve.
TEST(AlembicExport, WritesIds) {
    StrandSet strands;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 2; ++k) strands.points.emplace_back(i, k, 0);
        strands.ends.push_back(static_cast<std::uint32_t>(strands.points.size()));
    }
    std::ostringstream out;
    exportAlembicWith(strands, {.ids = true}, out);
    const std::string file = out.str();
    AlembicValues values(std::as_bytes(std::span(file)));
    std::vector<std::pair<AlembicObject, std::string>> objects{{values.archive().top(), ""}};
    std::vector<std::int32_t> ids;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto [object, path] = objects[i];
        const AlembicContents contents = values.archive().contentsOf(object, path);
        for (const AlembicObject& child : contents.children)
            objects.emplace_back(child, path + '/' + std::string(child.name));
        if (std::ranges::find(contents.properties, ".geom", &AlembicProperty::name) ==
            contents.properties.end())
            continue;
        const AlembicCompound geometry = values.compoundOf(contents.properties, ".geom", path);
        const AlembicCompound parameters = values.compoundIn(geometry, ".arbGeomParams");
        if (const auto found = values.parameterOf(parameters, "groom_id"))
            ids = values.integersOf(*found);
    }
    EXPECT_THAT(ids, ElementsAre(0, 1, 2));
}

// Three frames of the same strands, each of them elsewhere.
std::vector<std::vector<glm::vec3>> threeFrames(const StrandSet& strands) {
    std::vector<std::vector<glm::vec3>> frames(3, strands.points);
    for (glm::vec3& point : frames[1]) point += glm::vec3(0.25f, -1.0f, 3.0f);
    frames[2].front() = {-7.0f, 1e-20f, 1e20f};
    return frames;
}

std::string animationOf(
    const StrandSet& strands, const std::vector<std::vector<glm::vec3>>& frames,
    double frame_time) {
    std::ostringstream file;
    AlembicAnimation animation(
        file, strands, {static_cast<std::uint32_t>(frames.size()), frame_time});
    for (const std::vector<glm::vec3>& points : frames) animation.frame(points);
    animation.finish();
    return file.str();
}

TEST(AlembicAnimation, IsReadFrameByFrame) {
    const StrandSet strands = hardStrands();
    const auto frames = threeFrames(strands);
    const std::string file = animationOf(strands, frames, 0.125);
    const StrandSamples samples = importAlembicCache({std::as_bytes(std::span(file)), "a.abc"});
    EXPECT_EQ(samples.ends, strands.ends);
    EXPECT_THAT(samples.times, ElementsAre(0.0, 0.125, 0.25));
    ASSERT_EQ(samples.points.size(), 3 * strands.points.size());
    for (std::size_t i = 0; i < samples.points.size(); ++i)
        EXPECT_EQ(samples.points[i], frames[i / strands.points.size()][i % strands.points.size()])
            << i;
    // A reader of hair that stands still gets the first frame with all else.
    const StrandSet first = importAlembic({std::as_bytes(std::span(file)), "a.abc"});
    EXPECT_EQ(first.points, strands.points);
    EXPECT_EQ(first.widths.values, strands.widths.values);
    EXPECT_EQ(first.ends, strands.ends);
}

TEST(AlembicAnimation, MayHaveOneFrame) {
    const StrandSet strands = hardStrands();
    const std::string file = animationOf(strands, {strands.points}, 0.125);
    const StrandSet read = importAlembic({std::as_bytes(std::span(file)), "a.abc"});
    EXPECT_EQ(read.points, strands.points);
    EXPECT_EQ(
        errorText([&] { animationOf(strands, {strands.points}, 0.0); }),
        "/run/frame_time: is 0, but samples of .abc need times that ascend");
}

TEST(AlembicAnimation, IsReadByAlembicsLibrary) {
    const std::string python = HAIRBENCH_SOURCE_DIR "/.deps/alembic/bin/python";
    if (!std::filesystem::exists(python))
        GTEST_SKIP() << "no Python environment for Alembic: run scripts/setup --alembic";
    StrandSet strands = hardStrands();
    strands.points = {{1, 2, 3}, {4, 5, 6}, {0, 0, 0}, {0, 0, 1}, {-1, 0, 0}};
    strands.ends = {2, 5};
    strands.widths = {};
    strands.metres_per_unit = 1.0;
    strands.comment = "moves";
    const std::vector<std::vector<glm::vec3>> frames{
        strands.points, {{1, 2, 3}, {4, 5, 6}, {0, 0, 0}, {0, 0, 2}, {-8, 0, 0}}};
    const TemporaryFolder folder;
    folder.write("a.abc", animationOf(strands, frames, 0.5));
    const Outcome loaded = runInShell(
        "'" + python + "' -B '" HAIRBENCH_SOURCE_DIR "/tests/groom/formats/load_alembic.py' '" +
        folder.file("a.abc").string() + "' 2>&1");
    ASSERT_EQ(loaded.status, 0) << loaded.output;
    const auto words = [](std::initializer_list<int> numbers) {
        std::string text;
        for (const int number : numbers) {
            char word[16];
            std::snprintf(
                word, sizeof word, " %08x",
                std::bit_cast<std::uint32_t>(static_cast<float>(number)));
            text += word;
        }
        return text + '\n';
    };
    EXPECT_THAT(
        loaded.output, HasSubstr(
                           "P" + words({1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 1, -1, 0, 0}) +
                           "nVertices 2 3\nbounds" + words({-1, 0, 0, 4, 5, 6}) + "at 0.5\nP" +
                           words({1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 2, -8, 0, 0}) +
                           "nVertices 2 3\nbounds" + words({-8, 0, 0, 4, 5, 6})));
}

// Alembic's own library reads our archives exactly, to the last bit.
TEST(AlembicExport, IsReadByAlembicsLibrary) {
    const std::string python = interpreterOf("alembic");
    if (!std::filesystem::exists(python))
        GTEST_SKIP() << "no Python environment for Alembic: run scripts/setup --alembic";
    StrandSet strands = hardStrands();
    strands.points[2].x = 1e30f;  // decides a corner of the bounds
    strands.points[9].z = -2.0f;
    strands.groups = {-5, 1, 2};
    strands.guides = {0, 1, 0};
    strands.root_uvs = {{0.1f, -0.0f}, {1.0f / 3.0f, 1e-45f}, {1, 2}};
    strands.metres_per_unit = 0.0254;
    strands.comment = "of hairbench";
    const TemporaryFolder folder;
    exportStrands(strands, folder.file("a.abc"));
    const Outcome loaded = runInShell(
        "'" + python + "' -B '" HAIRBENCH_SOURCE_DIR "/tests/groom/formats/load_alembic.py' '" +
        folder.file("a.abc").string() + "' 2>&1");
    ASSERT_EQ(loaded.status, 0) << loaded.output;
    const auto words = [](const auto& elements) {
        std::string text;
        const auto* const first = reinterpret_cast<const std::uint32_t*>(elements.data());
        for (std::size_t i = 0; i < elements.size() * sizeof(elements[0]) / 4; ++i) {
            char word[16];
            std::snprintf(word, sizeof word, " %08x", first[i]);
            text += word;
        }
        return text + '\n';
    };
    const std::string expected =
        "transform /hair M44d((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))\n"
        "groom_version_major int16_t con 1\n"
        "groom_version_minor int16_t con 5\n"
        "curves /hair/strands kLinear kNonPeriodic kNoBasis\n"
        "P" +
        words(strands.points) +
        "nVertices 5 2 3\n"
        "bounds" +
        words(std::vector{-1.0f, -1.17549435e-38f, -2.0f, 1e30f, 9.999999e9f, 16777217.0f}) +
        "width kVertexScope" + words(strands.widths.values) +
        "groom_group_id int32_t uni -5 1 2\n"
        "groom_guide int16_t uni 0 1 0\n"
        "groom_root_uv float32_t[2] uni" +
        words(strands.root_uvs) + "groom_color float32_t[3] vtx" + words(strands.colors.values) +
        "hairbench:metersPerUnit 0.0254\nhairbench:comment of hairbench\n";
    EXPECT_EQ(loaded.output, expected);
}

}  // namespace
}  // namespace hair::groom
