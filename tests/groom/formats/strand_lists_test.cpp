#include <cmath>

#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"

// The bytes are written as the public readers of the two formats read them.
namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// Two strands, of three points and of two: 4 + 4 + 36 + 4 + 24 bytes.
std::string dataFile() {
    return Bytes()
        .u32(2)
        .u32(3)
        .f32(0, 0, 0, 0, 1, 0, 0, 2, 0.5)
        .u32(2)
        .f32(4, 0, 0, 4, 1, 0)
        .str();
}

// A strand of `points` points (k, 0, 0) with the vector `beside` and a label.
Bytes& addCt2Strand(Bytes& bytes, std::uint32_t points, float beside = 0.0f) {
    bytes.u32(points);
    for (std::uint32_t k = 0; k < points; ++k) bytes.f32(k, 0, 0, beside, beside, beside, 0);
    return bytes;
}

std::string ct2File() {
    Bytes bytes;
    bytes.u32(2);
    addCt2Strand(bytes, 5);
    return addCt2Strand(bytes, 6).str();
}

TEST(HairData, ReadsStrandsOfAnyLength) {
    const StrandSet set = readText(importHairData, dataFile());
    expectTheStrands(set);
    EXPECT_THAT(set.warnings, IsEmpty());
    EXPECT_EQ(brokenPromise(set), "");
}

TEST(HairData, IsWrittenByteForByteAsTheFormatHasIt) {
    const StrandSet set = readText(importHairData, dataFile());
    const Written written = writeText(exportHairData, set);
    EXPECT_EQ(written.bytes, dataFile());
    EXPECT_THAT(written.warnings, IsEmpty());
}

TEST(HairData, ReadsBackHardFloatsAndWarnsOfTheRest) {
    StrandSet strands = hardStrands();
    strands.root_uvs.resize(3);
    strands.groups = {1, 2, 3};
    const Written written = writeText(exportHairData, strands);
    EXPECT_THAT(
        written.warnings, ElementsAre(
                              HasSubstr("widths"), HasSubstr("transparencies"),
                              HasSubstr("colours"), HasSubstr("texture"), HasSubstr("groups")));
    const StrandSet read = readText(importHairData, written.bytes);
    EXPECT_EQ(read.ends, strands.ends);
    expectBitEqual(read.points, strands.points);
    EXPECT_EQ(errorText([] { writeText(exportHairData, {}); }), "there are no strands");
}

TEST(HairData, LeavesOutStrandsWithoutPoints) {
    const std::string bytes = Bytes().u32(3).u32(0).u32(2).f32(1, 2, 3).f32(4, 5, 6).u32(0).str();
    const StrandSet set = readText(importHairData, bytes);
    EXPECT_THAT(set.ends, ElementsAre(2));
    EXPECT_THAT(set.points, ElementsAre(glm::vec3(1, 2, 3), glm::vec3(4, 5, 6)));
    EXPECT_THAT(
        set.warnings,
        ElementsAre(
            "2 strands without points (the first is strand 0, counted from 0) are left out"));
    EXPECT_EQ(
        readError(importHairData, Bytes().u32(1).u32(0).str()),
        "no strand can be used; the file has only 1 strand without points (strand 0, counted from "
        "0)");
}

// Each wrong count stands for more or fewer bytes than the file has; the error names its place.
TEST(HairData, RefusesCountsThatTheFileDoesNotBearOut) {
    for (const std::uint32_t wrong : kWrongCounts) {
        for (const std::size_t at : {0u, 4u, 44u}) {
            const std::string error = readError(importHairData, patched(dataFile(), at, wrong));
            EXPECT_THAT(error, testing::StartsWith("byte ")) << at << ' ' << wrong;
        }
    }
    EXPECT_EQ(
        readError(importHairData, patched(dataFile(), 0, 0u)),
        "byte 0: 0 strands; at least 1 is needed");
    EXPECT_EQ(
        readError(importHairData, patched(dataFile(), 4, 0x80000000u)),
        "byte 4: the number of points of strand 0 is negative: -2147483648");
    EXPECT_EQ(
        readError(importHairData, patched(dataFile(), 44, 3u)),
        "byte 44: truncated: strand 1 of 3 points ends at byte 84, but the file ends at byte 72");
    EXPECT_EQ(
        readError(importHairData, patched(dataFile(), 44, 1u)),
        "byte 60: 12 trailing bytes after the last strand");
    EXPECT_EQ(
        readError(importHairData, patched(dataFile(), 0, 0x7fffffffu)),
        "byte 0: truncated: 2147483647 strands are more than 72 bytes can hold");
}

TEST(HairData, LeavesOutStrandsThatAreNotFinite) {
    for (const float wrong : kNotFinite) {
        const StrandSet set = readText(importHairData, patched(dataFile(), 52, wrong));
        EXPECT_THAT(set.ends, ElementsAre(3));
        EXPECT_THAT(set.warnings, ElementsAre(leftOutStrand(kNoPosition, 1)));
    }
}

TEST(Ct2Hair, ReadsPositions) {
    const StrandSet set = readText(importCt2Hair, ct2File());
    EXPECT_THAT(set.ends, ElementsAre(5, 11));
    EXPECT_EQ(set.points[4], glm::vec3(4, 0, 0));
    EXPECT_EQ(set.points[5], glm::vec3(0, 0, 0));
    EXPECT_THAT(set.warnings, IsEmpty());
}

TEST(Ct2Hair, LeavesOutShortStrandsAndThoseThatAreNoNumbers) {
    Bytes bytes;
    bytes.u32(4);
    addCt2Strand(bytes, 4);
    addCt2Strand(bytes, 5, 0.5f);
    addCt2Strand(bytes, 0);
    addCt2Strand(bytes, 6);
    // Place of the last strand's second position: after 4 + 116 + 144 + 4 + 4 + 28 bytes.
    const std::string damaged = patched(bytes.str(), 300, std::numeric_limits<float>::quiet_NaN());
    const StrandSet set = readText(importCt2Hair, damaged);
    EXPECT_THAT(set.ends, ElementsAre(5));
    EXPECT_THAT(
        set.warnings, ElementsAre(
                          "the points' tangents, or colours, are left out",
                          "2 strands of fewer than 5 points (the first is strand 0, counted from "
                          "0) are left out",
                          leftOutStrand(kNoPosition, 3)));
    EXPECT_EQ(brokenPromise(set), "");
    const StrandSet infinite =
        readText(importCt2Hair, patched(bytes.str(), 304, std::numeric_limits<float>::infinity()));
    EXPECT_THAT(infinite.ends, ElementsAre(5));
}

TEST(Ct2Hair, RefusesWhatHasNoStrandLeft) {
    Bytes bytes;
    bytes.u32(1);
    addCt2Strand(bytes, 4);
    EXPECT_THAT(readError(importCt2Hair, bytes.str()), HasSubstr("fewer than 5 points"));
}

// MonoHair's reader: two counts, the points of each strand in 16 bits, and all points.
std::string countedFile() {
    return Bytes()
        .u32(2)
        .u32(5)
        .u16(3)
        .u16(2)
        .f32(0, 0, 0, 0, 1, 0, 0, 2, 0.5)
        .f32(4, 0, 0, 4, 1, 0)
        .str();
}

TEST(CountedHair, ReadsStrandsOfAnyLength) {
    const StrandSet set = readText(importCountedHair, countedFile());
    expectTheStrands(set);
    EXPECT_THAT(set.warnings, IsEmpty());
    EXPECT_EQ(brokenPromise(set), "");
}

TEST(CountedHair, LeavesOutWhatIsNoStrand) {
    const std::string bytes = Bytes()
                                  .u32(4)
                                  .u32(8)
                                  .u16(2)
                                  .u16(0)
                                  .u16(2)
                                  .u16(2)
                                  .f32(0, 0, 0, 0, 1, 0)
                                  .f32(0, NAN, 0, 0, 0, 0)
                                  .f32(1, 0, 0, 1, 1, 0)
                                  .str();
    const StrandSet set = readText(importCountedHair, bytes);
    EXPECT_THAT(set.ends, ElementsAre(2, 4));
    EXPECT_THAT(
        set.points,
        ElementsAre(
            glm::vec3(0, 0, 0), glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0)));
    EXPECT_THAT(
        set.warnings, UnorderedElementsAre(
                          "the file states 8 points, but its strands have 6",
                          "1 strand without points (strand 1, counted from 0) is left out",
                          leftOutStrand(kNoPosition, 2)));
    EXPECT_EQ(brokenPromise(set), "");
    EXPECT_THAT(
        readError(importCountedHair, Bytes().u32(1).u32(0).u16(0).str()),
        HasSubstr("no strand can be used"));
}

TEST(CountedHair, RefusesSizesThatTheFileDoesNotBearOut) {
    for (const std::uint32_t wrong : kWrongCounts)
        EXPECT_THAT(
            readError(importCountedHair, patched(countedFile(), 0, wrong)),
            testing::StartsWith("byte "))
            << wrong;
    EXPECT_EQ(
        readError(importCountedHair, patched(countedFile(), 0, 0xffffffffu)),
        "byte 0: truncated: 4294967295 strands are more than 72 bytes can hold");
    EXPECT_EQ(
        readError(importCountedHair, patched(countedFile(), 8, std::uint16_t{4})),
        "byte 72: truncated: 2 strands of 6 points without a header are 84 bytes");
    EXPECT_EQ(
        readError(importCountedHair, countedFile() + '\0'),
        "byte 72: 1 trailing bytes after the last point: 2 strands of 5 points without a header "
        "are 72 bytes");
    for (std::size_t size = 0; size < countedFile().size(); ++size)
        EXPECT_THAT(
            readError(importCountedHair, countedFile().substr(0, size)),
            testing::MatchesRegex("byte .+: .*truncated.*"))
            << size;
}

// The two formats have different sizes: 12 and 28 bytes a point.
TEST(StrandLists, AreRefusedWhereverTheyEnd) {
    for (const auto& [read, whole] :
         {std::pair{&importHairData, dataFile()}, std::pair{&importCt2Hair, ct2File()}}) {
        for (std::size_t size = 0; size < whole.size(); ++size) {
            EXPECT_THAT(
                readError(read, whole.substr(0, size)),
                testing::MatchesRegex("byte .+: .*truncated.*"))
                << size;
        }
        EXPECT_THAT(readError(read, whole + '\0'), HasSubstr("1 trailing bytes"));
    }
    EXPECT_THAT(readError(importCt2Hair, dataFile()), HasSubstr("truncated"));
    EXPECT_THAT(readError(importHairData, ct2File()), testing::StartsWith("byte "));
}

}  // namespace
}  // namespace hair::groom
