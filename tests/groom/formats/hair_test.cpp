#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"

namespace hair::groom {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::uint32_t kSegments = 1, kPoints = 2, kThickness = 4, kTransparency = 8, kColors = 16;

// Two strands, of 3 and 2 points. The header's values for absent arrays differ from those of the
// arrays, and no value is one of our defaults.
std::string fileWith(std::uint32_t arrays) {
    Bytes bytes;
    bytes.text("HAIR").u32(2).u32(arrays & kSegments ? 5 : 6).u32(arrays);
    bytes.u32(2).f32(0.25, 0.125).f32(0.5, 0.75, 1.0);
    bytes.text("two strands").zeros(88 - 11);
    if (arrays & kSegments) bytes.u16(2).u16(1);
    const int points = arrays & kSegments ? 5 : 6;
    for (int i = 0; i < points; ++i)
        if (arrays & kPoints) bytes.f32(i, 0.1 * i, -i);
    for (int i = 0; i < points; ++i)
        if (arrays & kThickness) bytes.f32(0.01 * i);
    for (int i = 0; i < points; ++i)
        if (arrays & kTransparency) bytes.f32(0.1 * i);
    for (int i = 0; i < points; ++i)
        if (arrays & kColors) bytes.f32(0.1 * i, 0.2, 1 - 0.1 * i);
    return bytes.str();
}

StrandSet readHair(const std::string& bytes) { return readText(importHair, bytes); }
std::string errorOfHair(const std::string& bytes) { return readError(importHair, bytes); }

TEST(ImportHair, ReadsEveryArray) {
    const std::string bytes = fileWith(31);
    ASSERT_EQ(bytes.size(), 128u + 2 * 2 + 5 * (12 + 4 + 4 + 12));
    const StrandSet strands = readHair(bytes);
    EXPECT_THAT(strands.ends, ElementsAre(3, 5));
    EXPECT_THAT(
        strands.points, ElementsAre(
                            glm::vec3(0, 0, 0), glm::vec3(1, 0.1f, -1), glm::vec3(2, 0.2f, -2),
                            glm::vec3(3, 0.3f, -3), glm::vec3(4, 0.4f, -4)));
    EXPECT_THAT(strands.widths.values, ElementsAre(0.0f, 0.01f, 0.02f, 0.03f, 0.04f));
    EXPECT_THAT(strands.transparencies.values, ElementsAre(0.0f, 0.1f, 0.2f, 0.3f, 0.4f));
    ASSERT_EQ(strands.colors.values.size(), 5u);
    EXPECT_EQ(strands.colors.values[4], glm::vec3(0.4f, 0.2f, 0.6f));
    EXPECT_EQ(strands.comment, "two strands");
    EXPECT_FALSE(strands.metres_per_unit);
    EXPECT_THAT(strands.warnings, IsEmpty());
}

TEST(ImportHair, TakesTheHeadersValueWhereAnArrayIsAbsent) {
    for (std::uint32_t arrays = 0; arrays < 32; ++arrays) {
        SCOPED_TRACE(arrays);
        if ((arrays & kPoints) == 0) {
            EXPECT_THAT(
                errorOfHair(fileWith(arrays)), AllOf(StartsWith("byte 12: "), HasSubstr("bit 1")));
            continue;
        }
        const StrandSet strands = readHair(fileWith(arrays));
        EXPECT_EQ(strands.ends, arrays & kSegments ? std::vector({3u, 5u}) : std::vector({3u, 6u}));
        const std::size_t points = strands.ends.back();
        EXPECT_EQ(strands.points.size(), points);
        EXPECT_EQ(strands.widths.values.size(), arrays & kThickness ? points : 0);
        EXPECT_EQ(strands.transparencies.values.size(), arrays & kTransparency ? points : 0);
        EXPECT_EQ(strands.colors.values.size(), arrays & kColors ? points : 0);
        const auto absent = [&](std::uint32_t array) { return (arrays & array) == 0; };
        EXPECT_EQ(strands.widths.everywhere == 0.25f, absent(kThickness));
        EXPECT_EQ(strands.transparencies.everywhere == 0.125f, absent(kTransparency));
        EXPECT_EQ(strands.colors.everywhere == glm::vec3(0.5f, 0.75f, 1.0f), absent(kColors));
    }
}

TEST(ImportHair, RefusesStrandsOfOnePointAlone) {
    std::string bytes = patched(fileWith(kPoints), 4, 6);  // six strands
    EXPECT_THAT(errorOfHair(bytes), HasSubstr("6 strands of 2 segments have 18"));
    EXPECT_THAT(
        errorOfHair(patched(bytes, 16, 0)),
        StartsWith("no strand can be used; the file has only 6 strands of a single point"));
}

TEST(ImportHair, ReadsInfoWithoutAnEnd) {
    std::string bytes = fileWith(kPoints);
    bytes.replace(40, 88, std::string(88, 'x'));
    EXPECT_EQ(readHair(bytes).comment, std::string(88, 'x'));
}

TEST(ImportHair, KnowsNoWidthsWhereTheDefaultIsZero) {
    EXPECT_FALSE(readHair(patched(fileWith(kPoints), 20, 0.0f)).widths.known());
    const StrandSet negative = readHair(patched(fileWith(kPoints), 20, -1.0f));
    EXPECT_FALSE(negative.widths.known());
    EXPECT_THAT(
        negative.warnings,
        testing::ElementsAre("the width of all strands is negative and is left out"));
}

TEST(ImportHair, RefusesEveryTruncationAndMoreBytes) {
    for (const std::uint32_t arrays : {kPoints, kPoints | kColors, 31u}) {
        const std::string bytes = fileWith(arrays);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            EXPECT_THAT(
                errorOfHair(bytes.substr(0, size)),
                StartsWith("byte " + std::to_string(size) + ": truncated"));
        }
        EXPECT_EQ(
            errorOfHair(bytes + "xyz"),
            "byte " + std::to_string(bytes.size()) + ": 3 trailing bytes after the last array");
    }
}

TEST(ImportHair, RefusesWrongHeaders) {
    const std::string bytes = fileWith(31);
    EXPECT_THAT(errorOfHair(patched(bytes, 3, 'r')), StartsWith("byte 0: "));
    for (const std::size_t count : {4u, 8u}) {
        for (const std::uint32_t wrong : kWrongCounts)
            EXPECT_THAT(errorOfHair(patched(bytes, count, wrong)), StartsWith("byte "));
        for (int bit = 0; bit < 32; ++bit) {
            const std::uint32_t right = count == 4 ? 2 : 5;
            EXPECT_THAT(errorOfHair(patched(bytes, count, right ^ 1u << bit)), StartsWith("byte "));
        }
    }
    EXPECT_EQ(errorOfHair(patched(bytes, 4, 0)), "byte 4: 0 strands; at least 1 is needed");
    EXPECT_EQ(
        errorOfHair(patched(bytes, 4, -1)),
        "byte 292: truncated: 4294967295 strands and 5 points with arrays 31 are 8589934878 bytes");
    for (const std::uint32_t wrong : {0u, 1u, 30u, 32u, 63u, 0x80000002u, 0xffffffffu})
        EXPECT_THAT(errorOfHair(patched(bytes, 12, wrong)), StartsWith("byte ")) << wrong;
    EXPECT_EQ(
        errorOfHair(patched(bytes, 12, 63)), "byte 12: arrays 63: only the bits 0 to 4 are known");
    // The header's default is used only without an array of segments.
    EXPECT_EQ(errorOfHair(patched(bytes, 16, -1)), "no error");
    EXPECT_EQ(
        errorOfHair(patched(fileWith(kPoints), 16, -1)),
        "byte 8: 6 points, but 2 strands of 4294967295 segments have 8589934592");
}

TEST(ImportHair, RefusesSegmentsThatAreNotThePoints) {
    const std::string bytes = fileWith(31);
    EXPECT_EQ(
        errorOfHair(patched<std::uint16_t>(bytes, 128, 1)),
        "byte 8: 5 points, but the strands' segments make 4");
    EXPECT_EQ(
        errorOfHair(patched<std::uint16_t>(bytes, 128, 65535)),
        "byte 128: strand 0 ends after point 65536, but there are 5");
    EXPECT_EQ(
        errorOfHair(patched<std::uint16_t>(bytes, 130, 2)),
        "byte 130: strand 1 ends after point 6, but there are 5");
}

// Two strands of 3 and 2 points; a number of any array belongs to one of them.
TEST(ImportHair, LeavesOutStrandsWithNumbersThatAreNotFinite) {
    const std::string bytes = fileWith(31);
    constexpr std::size_t kStart = 128 + 4;
    for (const float wrong : kNotFinite) {
        for (std::size_t at = kStart; at < bytes.size(); at += 4) {
            const StrandSet set = readHair(patched(bytes, at, wrong));
            EXPECT_EQ(set.strandCount(), 1u) << at;
            EXPECT_THAT(set.warnings, testing::ElementsAre(HasSubstr("not finite")));
        }
        for (std::size_t at = 20; at < 40; at += 4) {
            EXPECT_EQ(readHair(patched(bytes, at, wrong)).strandCount(), 2u);  // it is not used
            const StrandSet set = readHair(patched(fileWith(kPoints), at, wrong));
            EXPECT_EQ(set.strandCount(), 2u);
            EXPECT_THAT(set.warnings, testing::ElementsAre(HasSubstr("of all strands is not")));
        }
    }
    const StrandSet set = readHair(patched(bytes, kStart + 4, kNotFinite[0]));
    EXPECT_THAT(set.warnings, testing::ElementsAre(leftOutStrand(kNoPosition, 0)));
}

TEST(ExportHair, WritesTheDescribedBytes) {
    for (const std::uint32_t arrays : {2u, 3u, 6u, 10u, 18u, 31u}) {
        // Strands of one size need no array of segments.
        const std::string bytes = fileWith(arrays);
        const auto [written, warnings] = writeText(exportHair, readHair(bytes));
        std::string expected = bytes;
        // The writer sets our own defaults for arrays that are present: unknown, opaque, white.
        if (arrays & kSegments) expected = patched(expected, 16, 0);
        if (arrays & kThickness) expected = patched(expected, 20, 0.0f);
        if (arrays & kTransparency) expected = patched(expected, 24, 0.0f);
        if (arrays & kColors)
            for (const std::size_t at : {28, 32, 36}) expected = patched(expected, at, 1.0f);
        EXPECT_EQ(written, expected) << arrays;
        EXPECT_THAT(warnings, IsEmpty());
    }
}

TEST(ExportHair, SaysWhatItLeavesOut) {
    StrandSet strands = readHair(fileWith(31));
    strands.root_uvs = {{0, 0}, {1, 1}};
    strands.root_triangles = {{0, 1, 1}};
    strands.metres_per_unit = 0.01;
    strands.comment = std::string(100, 'x');
    const auto [bytes, warnings] = writeText(exportHair, strands);
    EXPECT_THAT(
        warnings, ElementsAre(
                      HasSubstr("texture coordinates"), HasSubstr("root triangles"),
                      HasSubstr("unit"), HasSubstr("cut to 87")));
    EXPECT_EQ(readHair(bytes).comment, std::string(87, 'x'));
}

TEST(ExportHair, RefusesWhatTheFormatCannotHold) {
    EXPECT_EQ(errorText([] { writeText(exportHair, {}); }), "there are no strands");
    StrandSet strands{.ends = {65536, 65538}};
    strands.points.resize(65538);
    EXPECT_EQ(readHair(writeText(exportHair, strands).bytes).ends, strands.ends);
    strands.ends = {65537, 65538};
    EXPECT_THAT(errorText([&] { writeText(exportHair, strands); }), HasSubstr("65537"));
    strands.ends = {65538};  // one number of points for all strands
    EXPECT_EQ(readHair(writeText(exportHair, strands).bytes).ends, strands.ends);
}

}  // namespace
}  // namespace hair::groom
