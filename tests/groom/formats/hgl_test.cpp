#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// Three strands of two vertices and one triangle: 12 + 3 * 2 * 12 + 12 = 96 bytes.
std::string smallFile() {
    Bytes bytes;
    bytes.u32(3).u32(1).u32(1);
    bytes.f32(0, 0, 0).f32(0.1, 0.2, 0.3).f32(1, 0, -0.0).f32(1e-42, 3e38, -1);
    bytes.f32(0, 0, 1).f32(0.5, 0.25, 0.125);
    bytes.u32(0).u32(1).u32(2);
    return bytes.str();
}

StrandSet readHgl(const std::string& bytes) { return readText(importHgl, bytes); }
std::string errorOfHgl(const std::string& bytes) { return readError(importHgl, bytes); }

StrandSet strandsOf(std::uint32_t count, std::uint32_t vertices) {
    StrandSet strands;
    for (std::uint32_t i = 1; i <= count; ++i) strands.ends.push_back(i * vertices);
    strands.points.resize(std::size_t{count} * vertices);
    for (std::size_t i = 0; i < strands.points.size(); ++i)
        strands.points[i] = glm::vec3(i, 0.5f, -1.0f);
    return strands;
}

TEST(ImportHgl, ReadsTheDocumentedLayout) {
    const StrandSet strands = readHgl(smallFile());
    EXPECT_THAT(strands.ends, ElementsAre(2, 4, 6));
    ASSERT_EQ(strands.points.size(), 6u);
    EXPECT_EQ(strands.points[1], glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_THAT(strands.root_triangles, ElementsAre(std::array{0u, 1u, 2u}));
    EXPECT_EQ(strands.metres_per_unit, 1.0);
    EXPECT_FALSE(strands.widths.known());
}

TEST(ImportHgl, TakesTheLongestStrandAndNoTriangles) {
    Bytes bytes;
    bytes.u32(1).u32(255).u32(0);
    for (int i = 0; i < 256; ++i) bytes.f32(i, 0, 0);
    EXPECT_THAT(readHgl(bytes.str()).ends, ElementsAre(256));
}

TEST(ImportHgl, TakesTrianglesOfFewGuides) {
    for (const std::size_t corner : {84u, 88u, 92u})
        EXPECT_EQ(errorOfHgl(patched(smallFile(), corner, 1)), "no error");
}

TEST(ImportHgl, RefusesEveryTruncationAndMoreBytes) {
    const std::string bytes = smallFile();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_THAT(
            errorOfHgl(bytes.substr(0, size)),
            StartsWith("byte " + std::to_string(size) + ": truncated"));
    }
    EXPECT_EQ(errorOfHgl(bytes + "x"), "byte 96: 1 trailing bytes after the last triangle");
}

TEST(ImportHgl, RefusesEveryWrongCount) {
    const std::string bytes = smallFile();
    for (const std::size_t offset : {0u, 4u, 8u}) {
        for (std::size_t bit = 0; bit < 32; ++bit) {
            std::uint32_t count = 0;
            std::memcpy(&count, bytes.data() + offset, 4);
            count ^= 1u << bit;
            EXPECT_THAT(errorOfHgl(patched(bytes, offset, count)), StartsWith("byte "))
                << "count at " << offset << " is " << count;
        }
    }
    EXPECT_THAT(errorOfHgl(patched(bytes, 0, 0)), HasSubstr("byte 0: 0 strands"));
    EXPECT_THAT(errorOfHgl(patched(bytes, 0, -1)), HasSubstr("byte 0: -1 strands"));
    EXPECT_THAT(
        errorOfHgl(patched(bytes, 4, 0)), HasSubstr("byte 4: 0 segments is outside [1, 255]"));
    EXPECT_THAT(errorOfHgl(patched(bytes, 4, 256)), HasSubstr("byte 4: 256 segments"));
    EXPECT_THAT(errorOfHgl(patched(bytes, 8, -1)), HasSubstr("byte 8: -1 triangles"));
    EXPECT_THAT(errorOfHgl(patched(bytes, 0, 0x7fffffff)), HasSubstr("truncated"));
}

// Three strands of two points, which the triangle joins.
TEST(ImportHgl, LeavesOutStrandsThatAreNotFiniteAndTheirTriangles) {
    const std::string bytes = smallFile();
    for (const float wrong : kNotFinite) {
        for (std::size_t i = 0; i < 18; ++i) {
            const StrandSet set = readHgl(patched(bytes, 12 + 4 * i, wrong));
            EXPECT_EQ(set.strandCount(), 2u);
            EXPECT_TRUE(set.root_triangles.empty());
            EXPECT_THAT(
                set.warnings, testing::ElementsAre(
                                  leftOutStrand(kNoPosition, static_cast<std::uint32_t>(i / 6))));
        }
    }
}

TEST(ImportHgl, RefusesTrianglesOfGuidesThatAreNotThere) {
    for (const std::size_t corner : {84u, 88u, 92u}) {
        const std::string at = "byte " + std::to_string(corner) + ": triangle 0 names strand ";
        EXPECT_EQ(errorOfHgl(patched(smallFile(), corner, 3)), at + "3, but there are 3");
        EXPECT_EQ(errorOfHgl(patched(smallFile(), corner, -1)), at + "-1, but there are 3");
    }
}

TEST(ExportHgl, WritesTheDocumentedLayout) {
    const auto [bytes, warnings] = writeText(exportHgl, readHgl(smallFile()));
    EXPECT_EQ(bytes, smallFile());
    EXPECT_THAT(warnings, IsEmpty());
}

TEST(ExportHgl, ResamplesWhatTheFormatCannotHold) {
    const auto [bytes, warnings] = writeText(exportHgl, strandsOf(2, 257));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("257 points and are resampled to 256")));
    EXPECT_THAT(readHgl(bytes).ends, ElementsAre(256, 512));
    StrandSet ragged = strandsOf(2, 3);
    ragged.ends = {2, 6};
    const Written written = writeText(exportHgl, ragged);
    EXPECT_THAT(written.warnings, ElementsAre(HasSubstr("resampled to 4")));
    const StrandSet back = readHgl(written.bytes);
    EXPECT_THAT(back.ends, ElementsAre(4, 8));
    EXPECT_EQ(back.points[3], ragged.points[1]);
    EXPECT_EQ(readHgl(writeText(exportHgl, strandsOf(3, 1)).bytes).points.size(), 6u);
    EXPECT_EQ(errorText([] { writeText(exportHgl, {}); }), "there are no strands");
}

TEST(ExportHgl, SaysWhatItLeavesOut) {
    StrandSet strands = strandsOf(1, 2);
    strands.widths.everywhere = 0.1f;
    strands.transparencies.everywhere = 0.5f;
    strands.colors.everywhere = glm::vec3(1.0f);
    strands.root_uvs = {{0, 0}};
    strands.comment = "a";
    strands.metres_per_unit = 0.01;
    EXPECT_THAT(
        writeText(exportHgl, strands).warnings,
        ElementsAre(
            HasSubstr("widths"), HasSubstr("transparencies"), HasSubstr("colours"),
            HasSubstr("texture coordinates"), HasSubstr("comment"), HasSubstr("0.01")));
}

}  // namespace
}  // namespace hair::groom
