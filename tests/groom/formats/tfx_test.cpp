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

// Offsets of the arrays in a file of three strands of four vertices: in the header's order, each
// directly after the one before it, as a plain writer puts them.
constexpr std::uint32_t kPositions = 160;
constexpr std::uint32_t kStrandUvs = kPositions + 12 * 16;
constexpr std::uint32_t kVertexUvs = kStrandUvs + 3 * 8;
constexpr std::uint32_t kTfxThickness = kVertexUvs + 12 * 8;
constexpr std::uint32_t kTfxColors = kTfxThickness + 3 * 4;
constexpr std::uint32_t kEnd = kTfxColors + 12 * 16;

std::string fullFile() {
    Bytes bytes;
    bytes.f32(4.0).u32(3).u32(4);
    bytes.u32(kPositions)
        .u32(kStrandUvs)
        .u32(kVertexUvs)
        .u32(kTfxThickness)
        .u32(kTfxColors)
        .zeros(128);
    for (int i = 0; i < 12; ++i) bytes.f32(i, 0.1 * i, -i, i % 4 < 2 ? 0 : 1);
    for (int i = 0; i < 3; ++i) bytes.f32(0.3 * i, 1 - 0.3 * i);
    for (int i = 0; i < 12; ++i) bytes.f32(0.05 * i, 0.5);
    for (int i = 0; i < 3; ++i) bytes.f32(0.001 * (i + 1));
    for (int i = 0; i < 12; ++i) bytes.f32(0.05 * i, 0.5, 0.25, 1 - 0.0625 * i);
    return bytes.str();
}

// As AMD's exporters write it: positions only.
std::string plainFile() {
    std::string bytes = fullFile().substr(0, kStrandUvs);
    for (std::size_t offset = 16; offset < 32; offset += 4) bytes = patched(bytes, offset, 0);
    return bytes;
}

StrandSet readTfx(const std::string& bytes) { return readText(importTfx, bytes); }
std::string errorOfTfx(const std::string& bytes) { return readError(importTfx, bytes); }

TEST(ImportTfx, ReadsPositions) {
    const StrandSet strands = readTfx(plainFile());
    EXPECT_THAT(strands.ends, ElementsAre(4, 8, 12));
    ASSERT_EQ(strands.points.size(), 12u);
    for (int i = 0; i < 12; ++i)
        EXPECT_EQ(strands.points[i], glm::vec3(i, static_cast<float>(0.1 * i), -i));
    EXPECT_FALSE(strands.widths.known());
    EXPECT_FALSE(strands.transparencies.known());
    EXPECT_FALSE(strands.colors.known());
    EXPECT_THAT(strands.root_uvs, IsEmpty());
    EXPECT_FALSE(strands.metres_per_unit);
    EXPECT_THAT(strands.warnings, IsEmpty());
}

TEST(ImportTfx, ReadsEveryArray) {
    const std::string bytes = fullFile();
    ASSERT_EQ(bytes.size(), kEnd);
    const StrandSet strands = readTfx(bytes);
    EXPECT_THAT(
        strands.root_uvs,
        ElementsAre(glm::vec2(0, 1), glm::vec2(0.3f, 0.7f), glm::vec2(0.6f, 0.4f)));
    EXPECT_THAT(
        strands.widths.values, ElementsAre(
                                   0.001f, 0.001f, 0.001f, 0.001f, 0.002f, 0.002f, 0.002f, 0.002f,
                                   0.003f, 0.003f, 0.003f, 0.003f));
    ASSERT_EQ(strands.colors.values.size(), 12u);
    EXPECT_EQ(strands.colors.values[4], glm::vec3(0.2f, 0.5f, 0.25f));
    ASSERT_EQ(strands.transparencies.values.size(), 12u);
    EXPECT_EQ(strands.transparencies.values[4], 0.25f);  // 1 - alpha
    EXPECT_THAT(strands.warnings, ElementsAre(HasSubstr("texture coordinates of vertices")));
}

TEST(ImportTfx, ReadsArraysInAnyOrderWithGaps) {
    Bytes bytes;
    bytes.f32(4.0).u32(1).u32(2).u32(200).u32(0).u32(0).u32(164).u32(0).zeros(128);
    bytes.zeros(4).f32(0.5).zeros(200 - 168);
    bytes.f32(1, 2, 3, 0, 4, 5, 6, 1).zeros(5);
    const StrandSet strands = readTfx(bytes.str());
    EXPECT_THAT(strands.points, ElementsAre(glm::vec3(1, 2, 3), glm::vec3(4, 5, 6)));
    EXPECT_EQ(strands.widths.everywhere, 0.5f);
}

TEST(ImportTfx, TellsOfFixedVerticesBeyondTheSecond) {
    EXPECT_THAT(
        readTfx(patched(plainFile(), kPositions + 3 * 16 + 12, 0.0f)).warnings,
        ElementsAre(StartsWith("1 vertices beyond the first two")));
}

TEST(ImportTfx, RefusesEveryTruncation) {
    for (const std::string& bytes : {plainFile(), fullFile()}) {
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            EXPECT_THAT(
                errorOfTfx(bytes.substr(0, size)),
                AllOf(StartsWith("byte "), HasSubstr("truncated")))
                << size;
        }
    }
    EXPECT_EQ(errorOfTfx(""), "byte 0: truncated: the header alone is 160 bytes");
    EXPECT_EQ(
        errorOfTfx(fullFile().substr(0, 500)),
        "byte 500: vertex colours at byte 484: truncated: they end at byte 676, but the file ends "
        "at byte 500");
}

TEST(ImportTfx, RefusesWrongHeaders) {
    const std::string bytes = fullFile();
    for (const float version : {0.0f, 2.5f, 4.5f, -4.0f, kNotFinite[0]})
        EXPECT_THAT(errorOfTfx(patched(bytes, 0, version)), StartsWith("byte 0: version "))
            << version;
    for (const std::size_t count : {4u, 8u}) {
        for (const std::uint32_t wrong : kWrongCounts) {
            if (wrong == 1) continue;  // fits, with gaps
            EXPECT_THAT(errorOfTfx(patched(bytes, count, wrong)), StartsWith("byte ")) << wrong;
        }
    }
    EXPECT_EQ(errorOfTfx(patched(bytes, 4, 0)), "byte 4: 0 strands; at least 1 is needed");
    EXPECT_EQ(
        errorOfTfx(patched(bytes, 8, 0)), "byte 8: 0 vertices per strand; at least 2 are needed");
    EXPECT_THAT(
        errorOfTfx(patched(bytes, 8, 1)),
        StartsWith("no strand can be used; the file has only 3 strands of a single point"));
    EXPECT_EQ(errorOfTfx(patched(bytes, 12, 0)), "byte 12: there are no positions");
    EXPECT_THAT(
        errorOfTfx(patched(patched(bytes, 4, -1), 8, -1)),
        StartsWith("byte 4: 18446744065119617025 vertices"));
}

TEST(ImportTfx, RefusesArraysThatDoNotFit) {
    const std::string bytes = fullFile();
    for (const std::size_t offset : {12u, 16u, 20u, 24u, 28u}) {
        const std::string at = "byte " + std::to_string(offset) + ": ";
        EXPECT_THAT(errorOfTfx(patched(bytes, offset, 156)), StartsWith(at)) << "in the header";
        EXPECT_THAT(errorOfTfx(patched(bytes, offset, 1)), StartsWith(at)) << "in the header";
        for (const std::uint32_t wrong : {0x7fffffffu, 0x80000000u, 0xffffffffu, 0xfffffffcu})
            EXPECT_THAT(errorOfTfx(patched(bytes, offset, wrong)), StartsWith("byte ")) << wrong;
    }
    EXPECT_EQ(
        errorOfTfx(patched(bytes, 16, kPositions + 16)),
        "byte 16: strand UVs at byte 176 overlap the positions, which end at byte 352");
    EXPECT_EQ(
        errorOfTfx(patched(bytes, 16, kPositions)),
        "byte 16: strand UVs at byte 160 overlap the positions, which end at byte 352");
    EXPECT_EQ(
        errorOfTfx(patched(bytes, 28, kTfxColors + 2)),
        "byte 28: vertex colours at byte 486: not a multiple of 4");
}

// Each number of the arrays belongs to one strand, except w of positions, which only says whether a
// vertex is fixed.
TEST(ImportTfx, LeavesOutStrandsWithNumbersThatAreNotFinite) {
    const std::string bytes = fullFile();
    const std::uint32_t all = readTfx(bytes).strandCount();
    for (const float wrong : kNotFinite) {
        for (std::size_t at = kPositions; at < bytes.size(); at += 4) {
            const bool is_w = at < kStrandUvs && (at - kPositions) % 16 == 12;
            const bool unread = is_w || (at >= kVertexUvs && at < kTfxThickness);
            EXPECT_EQ(readTfx(patched(bytes, at, wrong)).strandCount(), unread ? all : all - 1)
                << at;
        }
    }
    EXPECT_THAT(
        readTfx(patched(bytes, kPositions + 2 * 16 + 8, kNotFinite[0])).warnings,
        testing::Contains(HasSubstr("1 strand " + kNoPosition)));
}

TEST(ExportTfx, WritesTheDescribedBytes) {
    EXPECT_EQ(writeText(exportTfx, readTfx(plainFile())).bytes, plainFile());
    StrandSet strands = readTfx(fullFile());
    const auto [bytes, warnings] = writeText(exportTfx, strands);
    EXPECT_THAT(warnings, IsEmpty());
    // Without UVs of vertices; colours move to the next multiple of 8.
    const std::string full = fullFile();
    Bytes expected;
    expected.text(full.substr(0, 20)).u32(0).u32(376).u32(392).zeros(128);
    expected.text(full.substr(kPositions, kVertexUvs - kPositions));
    expected.text(full.substr(kTfxThickness, 12)).zeros(4).text(full.substr(kTfxColors));
    EXPECT_EQ(bytes, expected.str());
}

TEST(ExportTfx, ResamplesWhatIsNotUniform) {
    StrandSet strands{
        .ends = {2, 7},
        .points = {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {4, 1, 0}}};
    const auto [bytes, warnings] = writeText(exportTfx, strands);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("resampled to 8")));
    const StrandSet back = readTfx(bytes);
    EXPECT_THAT(back.ends, ElementsAre(8, 16));
    EXPECT_EQ(back.points[7], strands.points[1]);
    EXPECT_EQ(back.points[15], strands.points[6]);
}

TEST(ExportTfx, SaysWhatItLeavesOut) {
    StrandSet strands{.ends = {3}, .points = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}};
    strands.widths.values = {0.2f, 0.1f, 0.0f};
    strands.transparencies.values = {0.0f, 0.1f, 0.75f};  // 1 - (1 - 0.1f) is not 0.1f
    strands.root_triangles = {{0, 0, 0}};
    strands.metres_per_unit = 1.0;
    strands.comment = "a";
    const auto [bytes, warnings] = writeText(exportTfx, strands);
    EXPECT_THAT(
        warnings,
        ElementsAre(
            HasSubstr("root triangles"), HasSubstr("unit"), HasSubstr("comment"),
            HasSubstr("3 vertices per strand"), HasSubstr("varies along 1 strands"),
            HasSubstr("colours are not known"), HasSubstr("1 transparencies are rounded")));
    const StrandSet back = readTfx(bytes);
    EXPECT_EQ(back.widths.everywhere, 0.2f);
    EXPECT_EQ(back.colors.everywhere, glm::vec3(1.0f));
    EXPECT_EQ(back.transparencies.values.back(), 0.75f);
    EXPECT_EQ(errorText([] { writeText(exportTfx, {}); }), "there are no strands");
}

// ---- Version 3 ----------------------------------------------------------------------------------

// Two strands of three vertices, byte by byte as AMD's header of TressFX 3.1 has it; arrays in the
// header's order from byte 296 on.
std::string tfx3File() {
    Bytes bytes;
    bytes.f32(3.0).u32(2).u32(3).u32(0).u32(0).zeros(31 * 4);
    bytes.u32(296).u32(368).u32(376).u32(392).u32(0).u32(0).zeros(32 * 4);
    for (int i = 0; i < 6; ++i) bytes.f32(i, 0.1 * i, -i);
    bytes.f32(0.001, 0.002);
    bytes.f32(0, 1, 0.3, 0.7);
    for (int i = 0; i < 6; ++i) bytes.f32(0.125 * i, 0.5, 0.25, 1);
    return bytes.str();
}

TEST(ImportTfx3, ReadsEveryArray) {
    ASSERT_EQ(tfx3File().size(), 488u);
    const StrandSet strands = readTfx(tfx3File());
    EXPECT_THAT(strands.ends, ElementsAre(3, 6));
    for (int i = 0; i < 6; ++i)
        EXPECT_EQ(strands.points[i], glm::vec3(i, static_cast<float>(0.1 * i), -i));
    EXPECT_THAT(strands.widths.values, ElementsAre(0.001f, 0.001f, 0.001f, 0.002f, 0.002f, 0.002f));
    EXPECT_THAT(strands.root_uvs, ElementsAre(glm::vec2(0, 1), glm::vec2(0.3f, 0.7f)));
    ASSERT_EQ(strands.colors.values.size(), 6u);
    EXPECT_EQ(strands.colors.values[5], glm::vec3(0.625f, 0.5f, 0.25f));
    EXPECT_EQ(strands.transparencies.everywhere, 0.0f);
    EXPECT_THAT(strands.warnings, IsEmpty());
}

// AMD's exporter writes a flag of one byte and three undefined bytes after it.
TEST(ImportTfx3, WarnsOfFollowersFixedEndsAndGuides) {
    std::string bytes = patched(patched(tfx3File(), 12, 4u), 16, 0xcccccc01u);
    bytes = patched(bytes, 160, static_cast<std::uint32_t>(bytes.size())) + std::string(8, '\0');
    EXPECT_THAT(
        readTfx(bytes).warnings,
        ElementsAre(
            HasSubstr("the 4 followers"), HasSubstr("both ends"), HasSubstr("strands' guides")));
    EXPECT_THAT(readTfx(patched(tfx3File(), 16, 0xcccccc00u)).warnings, IsEmpty());
}

TEST(ImportTfx3, RefusesWrongCountsAndOffsetsAndTruncation) {
    const std::string whole = tfx3File();
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THAT(
            errorOfTfx(whole.substr(0, size)), testing::MatchesRegex("byte .+: .*truncated.*"))
            << size;
    for (const std::size_t at : {4u, 8u, 144u, 148u, 152u, 156u, 160u, 164u}) {
        for (const std::uint32_t wrong : {5u, 295u, 300u, 0x7fffffffu, 0xfffffffcu})
            EXPECT_THAT(errorOfTfx(patched(whole, at, wrong)), StartsWith("byte "))
                << at << ' ' << wrong;
    }
    EXPECT_EQ(errorOfTfx(patched(whole, 144, 0u)), "byte 144: there are no positions");
    EXPECT_EQ(errorOfTfx(patched(whole, 4, 0u)), "byte 4: 0 strands; at least 1 is needed");
    for (const float wrong : kNotFinite)
        EXPECT_THAT(
            readTfx(patched(whole, 308, wrong)).warnings,
            testing::Contains(leftOutStrand(kNoPosition, 0)));
}

// ---- Version 2 ----------------------------------------------------------------------------------

// The lines of the files that came with TressFX 2.
const std::string kTfx2Header =
    "version 2.0\nscale 1.0\nrotation 0 0 0\ntranslation 0 0 0\nbothEndsImmovable 0\n"
    "maxNumVerticesInStrand 16\nnumFollowHairsPerGuideHair 4\nmaxRadiusAroundGuideHair 0.5\n"
    "numStrands 2\nis sorted 1\n";
const std::string kTfx2Strands =
    "strand 0 numVerts 3 texcoord 0.000000 000000\n0 0 0\n0 1 0\n0 2 5e-1\n"
    "strand 1 numVerts 2 texcoord 0.5 0.25\n4 0 0\n4 1 0\n";

TEST(ImportTfx2, ReadsText) {
    const StrandSet strands = readTfx(kTfx2Header + kTfx2Strands);
    expectTheStrands(strands);
    EXPECT_THAT(strands.root_uvs, ElementsAre(glm::vec2(0, 0), glm::vec2(0.5f, 0.25f)));
    EXPECT_THAT(strands.warnings, ElementsAre(HasSubstr("--followers 4")));
    // With Windows line ends, and without the optional lines.
    std::string windows =
        "version 2.0\r\nnumStrands 1\r\nstrand 0 numVerts 2\r\n1 2 3\r\n4 5 6\r\n\r\n";
    EXPECT_THAT(readTfx(windows).points, ElementsAre(glm::vec3(1, 2, 3), glm::vec3(4, 5, 6)));
}

TEST(ImportTfx2, IsKnownByItsFirstBytes) {
    const TemporaryFolder folder;
    expectTheStrands(importStrands(folder.write("strands.txt", kTfx2Header + kTfx2Strands)));
    EXPECT_EQ(strandImporterOf(folder.file("strands.txt")).name, "TressFX version 2");
    folder.write("strands.tfx", tfx3File());
    EXPECT_EQ(strandImporterOf(folder.file("strands.tfx")).name, "TressFX version 3");
}

TEST(ImportTfx2, NamesTheLineOfWhatIsWrong) {
    const auto error = [](std::string from, std::string to) {
        std::string text = kTfx2Header + kTfx2Strands;
        text.replace(text.find(from), from.size(), to);
        return errorOfTfx(text);
    };
    EXPECT_EQ(error("2.0", "1.0"), "line 1: version '1.0'; only 2.0 is read as text");
    EXPECT_THAT(error("scale 1.0", "scale 2"), StartsWith("line 2: a scale, which is not read"));
    EXPECT_THAT(error("rotation 0", "rotation 90"), StartsWith("line 3: a rotation"));
    EXPECT_THAT(error("bothEnds", "someEnds"), StartsWith("line 5: unknown keyword"));
    EXPECT_THAT(error("16", "2"), StartsWith("line 11: more vertices than"));
    EXPECT_THAT(error("numStrands 2", "numStrands 0"), StartsWith("line 9: '0' is not a number"));
    EXPECT_THAT(
        error("numStrands 2", "numStrands 4000000000"),
        "line 9: truncated: 4000000000 strands are expected");
    EXPECT_EQ(error("strand 1 ", "strand 2 "), "line 15: strand 1 is expected here");
    EXPECT_THAT(error("numVerts 3", "numVerts 4"), StartsWith("line 15: 'strand' is not a number"));
    EXPECT_THAT(error("numVerts 3", "numVerts 2"), StartsWith("line 14: '0', expected 'strand'"));
    EXPECT_THAT(error(" texcoord 0.5 0.25", ""), StartsWith("line 15: all strands"));
    EXPECT_THAT(error("5e-1", "half"), "line 14: 'half' is not a number");
    EXPECT_THAT(error("0 1 0\n", "0 1\n"), StartsWith("line 13: '' is not a number"));
    EXPECT_THAT(error("0 1 0\n", "0 1 0 0\n"), "line 13: '0' is one value too many");
    EXPECT_THAT(error("4 1 0\n", "4 1 0\nmore"), "line 18: 'more' after the last strand");
}

TEST(ImportTfx2, IsRefusedWhereverItEnds) {
    const std::string whole = kTfx2Header + kTfx2Strands;
    // A file is complete even without the end of its last line, and even with its last number cut.
    for (std::size_t size = 7; size + 2 < whole.size(); ++size)
        EXPECT_THAT(errorOfTfx(whole.substr(0, size)), StartsWith("line ")) << size;
}

}  // namespace
}  // namespace hair::groom
