#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"

// The bytes and lines are those that the readers of Mitsuba 0.6 (plug-in `hair`) and Mitsuba 3
// (`linearcurve`) expect.
namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float kStart = std::numeric_limits<float>::infinity();

std::string binaryFile() {
    return Bytes()
        .text("BINARY_HAIR")
        .u32(5)
        .f32(kStart, 0, 0, 0, 0, 1, 0, 0, 2, 0.5)
        .f32(kStart, 4, 0, 0, 4, 1, 0)
        .str();
}

constexpr std::string_view kRadii = "0 0 0 0.25\n0 1 0 0.125\n0 2 0.5 0\n\n4 0 0 1\n4 1 0 1\n";

TEST(MitsubaHair, ReadsTheBinaryForm) {
    const StrandSet set = readText(importMitsubaHair, binaryFile());
    expectTheStrands(set);
    EXPECT_THAT(set.warnings, IsEmpty());
    EXPECT_FALSE(set.widths.known());
    EXPECT_EQ(brokenPromise(set), "");
}

// Mitsuba's reader begins a strand at the first vertex, too, and takes either infinity.
TEST(MitsubaHair, NeedsNoMarkBeforeTheFirstStrand) {
    const std::string bytes = Bytes()
                                  .text("BINARY_HAIR")
                                  .u32(5)
                                  .f32(0, 0, 0, 0, 1, 0, 0, 2, 0.5)
                                  .f32(-kStart, 4, 0, 0, 4, 1, 0)
                                  .str();
    expectTheStrands(readText(importMitsubaHair, bytes));
}

TEST(MitsubaHair, IsWrittenByteForByte) {
    const StrandSet set = readText(importMitsubaHair, binaryFile());
    EXPECT_EQ(writeText(exportMitsubaBinary, set).bytes, binaryFile());
    const StrandSet with_widths = readText(importMitsubaHair, kRadii);
    EXPECT_EQ(writeText(exportMitsubaText, with_widths).bytes, kRadii);
    EXPECT_THAT(
        writeText(exportMitsubaBinary, with_widths).warnings, ElementsAre(HasSubstr("widths")));
    EXPECT_EQ(errorText([] { writeText(exportMitsubaText, {}); }), "there are no strands");
    EXPECT_EQ(errorText([] { writeText(exportMitsubaBinary, {}); }), "there are no strands");
}

TEST(MitsubaHair, ReadsTextWithRadii) {
    const StrandSet set = readText(importMitsubaHair, kRadii);
    expectTheStrands(set);
    EXPECT_THAT(set.widths.values, ElementsAre(0.5f, 0.25f, 0.0f, 2.0f, 2.0f));
    EXPECT_EQ(brokenPromise(set), "");
}

TEST(MitsubaHair, ReadsTextWithoutRadii) {
    const StrandSet set = readText(
        importMitsubaHair, "# root first\n\n 0 0 0\r\n0 1\t0\n0 2 0.5\n#\n\n+4 0 0\n4 1e0 0\n\n\n");
    expectTheStrands(set);
    EXPECT_FALSE(set.widths.known());
}

// Half of the least float is not a float.
TEST(MitsubaHair, KeepsEveryWidth) {
    StrandSet set = hardStrands();
    set.widths.values.front() = 1e-45f;
    const StrandSet read = readText(importMitsubaHair, writeText(exportMitsubaText, set).bytes);
    expectBitEqual(read.points, set.points);
    expectBitEqual(read.widths.values, set.widths.values);
}

TEST(MitsubaHair, LeavesOutStrandsThatAreNotFinite) {
    const StrandSet text =
        readText(importMitsubaHair, "0 0 0\n0 nan 0\n\n0 0 0\n0 1 0\n\n1e39 0 0\n1 1 1\n");
    EXPECT_THAT(text.ends, ElementsAre(2));
    EXPECT_EQ(brokenPromise(text), "");
    EXPECT_THAT(text.warnings, ElementsAre(HasSubstr("2 strands")));
    const std::string bytes = Bytes()
                                  .text("BINARY_HAIR")
                                  .u32(4)
                                  .f32(0, NAN, 0, 0, 0, 0)
                                  .f32(kStart, 1, 2, 3, 4, 5, 6)
                                  .str();
    const StrandSet binary = readText(importMitsubaHair, bytes);
    EXPECT_THAT(binary.points, ElementsAre(glm::vec3(1, 2, 3), glm::vec3(4, 5, 6)));
    EXPECT_THAT(binary.warnings, ElementsAre(leftOutStrand(kNoPosition, 0)));
    EXPECT_THAT(readError(importMitsubaHair, "0 0 inf 1\n"), HasSubstr("no strand can be used"));
}

TEST(MitsubaHair, RefusesOtherText) {
    EXPECT_EQ(
        readError(importMitsubaHair, "0 0 0\nhair\n"),
        "line 2: 'hair' is not a number: expected x y z, or x y z radius");
    EXPECT_EQ(
        readError(importMitsubaHair, "0 0 0\n0 0 0 1\n"),
        "line 2: 4 numbers, expected 3 as in the first line");
    EXPECT_EQ(
        readError(importMitsubaHair, "0 0\n"), "line 1: 2 numbers, expected 3, or 4 with a radius");
    EXPECT_EQ(readError(importMitsubaHair, ""), "line 1: the file has no strands");
    EXPECT_EQ(readError(importMitsubaHair, "# nothing\n\n"), "line 2: the file has no strands");
}

TEST(MitsubaHair, RefusesCountsThatTheFileDoesNotBearOut) {
    for (std::size_t size = 12; size < binaryFile().size(); ++size)
        EXPECT_THAT(
            readError(importMitsubaHair, binaryFile().substr(0, size)),
            testing::MatchesRegex("byte .+: .*truncated.*"))
            << size;
    for (const std::uint32_t wrong : kWrongCounts)
        EXPECT_THAT(
            readError(importMitsubaHair, patched(binaryFile(), 11, wrong)),
            testing::StartsWith("byte "))
            << wrong;
    EXPECT_EQ(
        readError(importMitsubaHair, binaryFile() + '\0'),
        "byte 83: 1 trailing bytes after the last vertex");
    EXPECT_EQ(
        readError(importMitsubaHair, patched(binaryFile(), 11, 0xffffffffu)),
        "byte 83: truncated: 4294967295 vertices are at least 51539607555 bytes");
}

}  // namespace
}  // namespace hair::groom
