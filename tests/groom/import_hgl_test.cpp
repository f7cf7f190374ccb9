#include "hair/groom/import_hgl.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>

#include "hair/groom/export_hgl.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace hair {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Three strands of two vertices and one triangle: 12 + 3 * 2 * 12 + 12 = 96 bytes.
Groom smallGroom() {
    Groom groom;
    groom.strand_count = 3;
    groom.vertices_per_strand = 2;
    groom.points = {{0.0f, 0.0f, 0.0f},     {0.1f, 0.2f, 0.3f}, {1.0f, 0.0f, -0.0f},
                    {1e-42f, 3e38f, -1.0f}, {0.0f, 0.0f, 1.0f}, {0.5f, 0.25f, 0.125f}};
    groom.root_triangles = {{0, 1, 2}};
    return groom;
}

std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string smallFile() {
    const TemporaryFolder folder;
    exportHgl(smallGroom(), folder.file("small.hgl"));
    return bytesOf(folder.file("small.hgl"));
}

template <class Value>
std::string patched(std::string bytes, std::size_t offset, Value value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return bytes;
}

std::string parseError(const std::string& bytes) {
    return errorText([&] { parseHgl(std::as_bytes(std::span(bytes))); });
}

TEST(ExportHgl, WritesTheDocumentedLayout) {
    const std::string bytes = smallFile();
    ASSERT_EQ(bytes.size(), 96u);
    // strands, segments, triangles; then the second point's x = 0.1f = 0x3dcccccd; the triangle at
    // the end.
    EXPECT_EQ(bytes.substr(0, 12), std::string("\3\0\0\0\1\0\0\0\1\0\0\0", 12));
    EXPECT_EQ(bytes.substr(24, 4), "\xcd\xcc\xcc\x3d");
    EXPECT_EQ(bytes.substr(84), std::string("\0\0\0\0\1\0\0\0\2\0\0\0", 12));
}

TEST(ExportHgl, RefusesGroomsThatTheFormatCannotHold) {
    const TemporaryFolder folder;
    const auto path = folder.file("a.hgl");
    EXPECT_THAT(errorText([&] { exportHgl({}, path); }), StartsWith(path.string() + ": "));
    Groom groom = smallGroom();
    groom.vertices_per_strand = 257;
    groom.points.resize(std::size_t{3} * 257);
    EXPECT_THAT(errorText([&] { exportHgl(groom, path); }), HasSubstr("257"));
    const auto nowhere = folder.file("no/such/folder.hgl");
    EXPECT_THAT(
        errorText([&] { exportHgl(smallGroom(), nowhere); }), HasSubstr("can't be written"));
}

TEST(ImportHgl, GivesBackEveryBit) {
    const TemporaryFolder folder;
    const Groom groom = smallGroom();
    exportHgl(groom, folder.file("a.hgl"));
    const Groom read = importHgl(folder.file("a.hgl"));
    EXPECT_EQ(read.strand_count, groom.strand_count);
    EXPECT_EQ(read.vertices_per_strand, groom.vertices_per_strand);
    EXPECT_EQ(read.root_triangles, groom.root_triangles);
    ASSERT_EQ(read.points.size(), groom.points.size());
    EXPECT_EQ(std::memcmp(read.points.data(), groom.points.data(), 72), 0);
    exportHgl(read, folder.file("b.hgl"));
    EXPECT_EQ(bytesOf(folder.file("a.hgl")), bytesOf(folder.file("b.hgl")));
}

TEST(ImportHgl, TakesTheLongestStrandAndNoTriangles) {
    const TemporaryFolder folder;
    Groom groom;
    groom.strand_count = 1;
    groom.vertices_per_strand = 256;
    groom.points.resize(256, glm::vec3(1.0f));
    exportHgl(groom, folder.file("a.hgl"));
    EXPECT_EQ(importHgl(folder.file("a.hgl")).points.size(), 256u);
}

TEST(ImportHgl, NamesFileAndOffset) {
    const TemporaryFolder folder;
    const auto path = folder.write("bad.hgl", smallFile().substr(0, 50));
    EXPECT_THAT(
        errorText([&] { importHgl(path); }), StartsWith(path.string() + ": byte 50: truncated"));
    const auto missing = folder.file("missing.hgl");
    EXPECT_EQ(errorText([&] { importHgl(missing); }), missing.string() + ": no such file");
    EXPECT_THAT(errorText([&] { importHgl(folder.file("")); }), HasSubstr("not a file"));
}

TEST(ImportHgl, RefusesEveryTruncation) {
    const std::string bytes = smallFile();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_THAT(
            parseError(bytes.substr(0, size)),
            StartsWith("byte " + std::to_string(size) + ": truncated"));
    }
}

TEST(ImportHgl, RefusesTrailingBytes) {
    EXPECT_EQ(parseError(smallFile() + "x"), "byte 96: 1 trailing bytes after the last triangle");
}

TEST(ImportHgl, RefusesEveryWrongCount) {
    const std::string bytes = smallFile();
    for (const std::size_t offset : {0u, 4u, 8u}) {
        for (std::size_t bit = 0; bit < 32; ++bit) {
            std::int32_t count = 0;
            std::memcpy(&count, bytes.data() + offset, 4);
            count ^= static_cast<std::int32_t>(1u << bit);
            EXPECT_THAT(parseError(patched(bytes, offset, count)), StartsWith("byte "))
                << "count at " << offset << " is " << count;
        }
    }
    EXPECT_THAT(parseError(patched(bytes, 0, 0)), HasSubstr("byte 0: 0 strands"));
    EXPECT_THAT(parseError(patched(bytes, 0, -1)), HasSubstr("byte 0: -1 strands"));
    EXPECT_THAT(
        parseError(patched(bytes, 4, 0)), HasSubstr("byte 4: 0 segments is outside [1, 255]"));
    EXPECT_THAT(parseError(patched(bytes, 4, 256)), HasSubstr("byte 4: 256 segments"));
    EXPECT_THAT(parseError(patched(bytes, 8, -1)), HasSubstr("byte 8: -1 triangles"));
    EXPECT_THAT(
        parseError(patched(bytes, 0, std::numeric_limits<std::int32_t>::max())),
        HasSubstr("truncated"));
}

TEST(ImportHgl, RefusesPointsThatAreNotFinite) {
    const std::string bytes = smallFile();
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          -HUGE_VALF}) {
        for (std::size_t i = 0; i < 18; ++i) {
            const std::size_t strand = i / 6;
            const std::size_t vertex = i / 3 % 2;
            EXPECT_EQ(
                parseError(patched(bytes, 12 + 4 * i, value)),
                "byte " + std::to_string(12 + 12 * (i / 3)) + ": strand " + std::to_string(strand) +
                    ", vertex " + std::to_string(vertex) + " is not finite");
        }
    }
}

TEST(ImportHgl, RefusesWrongTriangles) {
    const std::string bytes = smallFile();
    for (const std::size_t corner : {84u, 88u, 92u}) {
        EXPECT_EQ(
            parseError(patched(bytes, corner, 3)),
            "byte 84: triangle 0 names strand 3, there are 3");
        EXPECT_EQ(
            parseError(patched(bytes, corner, -1)),
            "byte 84: triangle 0 names strand -1, there are 3");
    }
    EXPECT_EQ(parseError(patched(bytes, 84, 1)), "byte 84: triangle 0 names a strand twice");
    EXPECT_EQ(parseError(patched(bytes, 92, 0)), "byte 84: triangle 0 names a strand twice");
    EXPECT_EQ(parseError(patched(bytes, 92, 1)), "byte 84: triangle 0 names a strand twice");
}

}  // namespace
}  // namespace hair
