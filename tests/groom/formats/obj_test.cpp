#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "tests/groom/formats/strand_files.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string kVertices = "v 0 0 0\nv 0 1 0\nv 0 2 .5\nv 4 0 0\nv +4 1e0 -0\n";

StrandSet readObj(const std::string& text) { return readText(importObj, text); }
std::string errorOfObj(const std::string& text) { return readError(importObj, text); }

TEST(ImportObj, ReadsLines) {
    const StrandSet strands = readObj(kVertices + "l 1 2 3\nl 4 5\n");
    expectTheStrands(strands);
    EXPECT_THAT(strands.warnings, IsEmpty());
}

TEST(ImportObj, ReadsWhatEditorsWrite) {
    expectTheStrands(
        readObj("# by hand\r\n#of strands\r\nmtllib a.mtl\r\no hair\r\nv 0 0 0 # root\r\n\r\n"
                "\tv  0 1\t0 \r\nv 0 \\\r\n2 \\\r\n.5\r\nusemtl brown\r\nl -3 -2 -1\r\n"
                "v 4 0 0 1.0\r\nv 4 1 0\r\ns off\r\nl -2 -1"));
    EXPECT_EQ(
        readObj("# by hand\n#of strands\nv 0 0 0\nv 1 0 0\n# inside\nl 1 2").comment,
        "by hand\nof strands");
}

TEST(ImportObj, JoinsSegmentsThatContinueEachOther) {
    expectTheStrands(readObj(kVertices + "l 1 2\nl 2 3\nl 4 5\n"));
    // Lines with more points are not joined, nor are lines on both sides of a group's beginning.
    EXPECT_THAT(readObj(kVertices + "l 1 2 3\nl 3 4\n").ends, ElementsAre(3, 5));
    EXPECT_THAT(readObj(kVertices + "l 1 2\ng other\nl 2 3\n").ends, ElementsAre(2, 4));
    EXPECT_THAT(readObj(kVertices + "l 1 2\nl 3 2\n").ends, ElementsAre(2, 4));
}

TEST(ImportObj, ReadsVerticesThatFollow) {
    expectTheStrands(readObj("l 1 2 3\nl 4 5\n" + kVertices));
}

TEST(ImportObj, ReadsColours) {
    const StrandSet strands = readObj("v 0 0 0 1 .5 .25\nv 1 0 0 0 0 1\nv 2 0 0\nl 1 2 3\n");
    EXPECT_THAT(
        strands.colors.values,
        ElementsAre(glm::vec3(1, 0.5f, 0.25f), glm::vec3(0, 0, 1), glm::vec3(1)));
    EXPECT_THAT(strands.warnings, ElementsAre("1 vertices have no colour and become white"));
}

TEST(ImportObj, LeavesOutWhatIsNoStrand) {
    const StrandSet strands =
        readObj(kVertices + "vt 0 0\nvn 0 0 1\np 1\nf 1 2 3\nf 1/1 2/1 3/1\nl 1/1 2/1\n");
    EXPECT_THAT(strands.ends, ElementsAre(2));
    EXPECT_THAT(
        strands.warnings, ElementsAre(
                              "2 faces are left out", "1 point elements are left out",
                              "the texture coordinates of lines are left out",
                              "3 of 5 points belong to no strand and are left out"));
}

TEST(ImportObj, ReadsNumbersAtTheEndOfFloat) {
    const StrandSet strands = readObj("v 1e-50 3.4028235e38 1e-45\nv 1 1 1\nl 1 2\n");
    EXPECT_EQ(strands.points[0], glm::vec3(0.0f, 3.4028235e38f, 1e-45f));
}

TEST(ImportObj, NamesTheLineOfWhatIsWrong) {
    EXPECT_THAT(
        errorOfObj(""), StartsWith("line 1: the file has no strands: expected line elements"));
    EXPECT_THAT(errorOfObj(kVertices), StartsWith("line 5: the file has no strands"));
    EXPECT_THAT(errorOfObj("v 0 0\n"), StartsWith("line 1: a vertex of 2 numbers, expected x y z"));
    EXPECT_THAT(errorOfObj("v 0 0 0 0 0\n"), StartsWith("line 1: a vertex of 5 numbers"));
    EXPECT_THAT(errorOfObj("v 0 0 zero\n"), StartsWith("line 1: 'zero' is not a number"));
    EXPECT_THAT(errorOfObj("v 0 0 +-1\n"), StartsWith("line 1: '+-1' is not a number"));
    EXPECT_THAT(errorOfObj(kVertices + "l\n"), StartsWith("line 6: a line of no vertices"));
    EXPECT_THAT(
        errorOfObj(kVertices + "l 1 x\n"), StartsWith("line 6: 'x' is not the index of a vertex"));
    EXPECT_THAT(errorOfObj(kVertices + "l 0 1\n"), StartsWith("line 6: vertex 0 is named"));
    EXPECT_THAT(
        errorOfObj(kVertices + "l -6 1\n"),
        StartsWith("line 6: vertex -6 is named, but there are 5"));
    EXPECT_THAT(
        errorOfObj(kVertices + "l 1 2\nl 1 6\nl 3 4\n"),
        StartsWith("line 7: vertex 6 is named, but there are 5"));
    EXPECT_THAT(
        errorOfObj(kVertices + "l 1 4294967297\n"),
        StartsWith("line 6: vertex 4294967297 is named"));
    EXPECT_THAT(
        errorOfObj(kVertices + "l 1 99999999999999999999\n"),
        StartsWith("line 6: '99999999999999999999'"));
    EXPECT_THAT(errorOfObj("v 0 0 \\\n\\\nx\n"), StartsWith("line 1: 'x' is not a number"));
}

TEST(ImportObj, LeavesOutStrandsThatCantBeUsed) {
    for (const std::string wrong : {"nan", "-inf", "1e39"}) {
        const StrandSet set =
            readObj("v 0 0 0\nv 0 1 0\nv 0 " + wrong + " 0\nv 1 1 1\nl 1 2\nl 3 4\nl 2\n");
        EXPECT_THAT(set.ends, ElementsAre(2)) << wrong;
        EXPECT_THAT(
            set.warnings,
            ElementsAre(leftOutStrand(kNoPosition, 1), leftOutStrand("of a single point", 2)));
    }
}

TEST(ExportObj, ReadsBackBitEqual) {
    StrandSet strands = hardStrands();
    strands.comment = "first line\n\n  third line \\";
    const Written written = writeText(exportObj, strands);
    EXPECT_THAT(written.warnings, ElementsAre(HasSubstr("widths"), HasSubstr("transparencies")));
    const StrandSet back = readObj(written.bytes);
    EXPECT_EQ(back.ends, strands.ends);
    expectBitEqual(back.points, strands.points);
    expectBitEqual(back.colors.values, strands.colors.values);
    EXPECT_EQ(back.comment, strands.comment);
    EXPECT_THAT(back.warnings, IsEmpty());
}

TEST(ExportObj, KeepsStrandsOfTwoPointsApart) {
    StrandSet strands;
    strands.ends = {2, 4};
    strands.points = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_THAT(readObj(writeText(exportObj, strands).bytes).ends, ElementsAre(2, 4));
}

TEST(ExportObj, LeavesOutSinglePoints) {
    StrandSet strands;
    strands.ends = {1, 3};
    strands.points.resize(3);
    const Written written = writeText(exportObj, strands);
    EXPECT_THAT(written.warnings, ElementsAre(HasSubstr("1 strands of a single point")));
    EXPECT_THAT(readObj(written.bytes).ends, ElementsAre(2));
    EXPECT_THAT(
        errorText([] { writeText(exportObj, {}); }), HasSubstr("no strand has the two points"));
}

}  // namespace
}  // namespace hair::groom
