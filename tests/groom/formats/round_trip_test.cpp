#include <gmock/gmock.h>

#include "tests/groom/formats/strand_files.h"
#include "tests/python.h"
#include "tests/required.h"

// Strands go from format to format through files. The strands, their order, points and widths come
// back to the last bit if the formats on the way hold them.
namespace hair::groom {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// Writes and reads each format in turn, starting with strands that a file held.
StrandSet through(const TemporaryFolder& folder, StrandSet strands, std::string_view formats) {
    for (std::size_t at = 0; at < formats.size();) {
        const std::size_t end = std::min(formats.find(' ', at), formats.size());
        const auto path = folder.file("strands" + std::string(formats.substr(at, end - at)));
        exportStrands(strands, path);
        strands = importStrands(path);
        at = end + 1;
    }
    return strands;
}

void expectCameBack(const StrandSet& read, const StrandSet& expected) {
    EXPECT_EQ(read.ends, expected.ends);
    expectBitEqual(read.points, expected.points);
    EXPECT_EQ(read.widths.everywhere, expected.widths.everywhere);
    EXPECT_EQ(read.widths.values.size(), expected.widths.values.size());
    if (!expected.widths.values.empty()) expectBitEqual(read.widths.values, expected.widths.values);
}

// Three strands of four points with difficult floats. Each strand has one width.
StrandSet uniformStrands() {
    StrandSet strands = hardStrands();
    strands.ends = {4, 8};
    strands.points.resize(8);
    strands.widths.values = {0.1f, 0.1f, 0.1f, 0.1f, 1e-5f, 1e-5f, 1e-5f, 1e-5f};
    strands.transparencies = {};
    strands.colors = {};
    return strands;
}

TEST(RoundTrip, KeepsUniformStrandsThroughEveryBinaryFormat) {
    const TemporaryFolder folder;
    const StrandSet strands = uniformStrands();
    expectCameBack(through(folder, strands, ".hair .tfx .hair"), strands);
    expectCameBack(through(folder, strands, ".tfx .hair .tfx"), strands);
    StrandSet without_widths = strands;
    without_widths.widths = {};
    expectCameBack(through(folder, strands, ".hair .hgl .hair"), without_widths);
    expectCameBack(through(folder, strands, ".hgl .tfx .hgl .hair .hgl"), without_widths);
    StrandSet one_width = strands;
    one_width.widths = {.everywhere = 0.3f};
    expectCameBack(through(folder, one_width, ".hair .tfx .hair"), one_width);
}

TEST(RoundTrip, GivesTheSameBytes) {
    const TemporaryFolder folder;
    for (const std::string format :
         {".hair", ".tfx", ".hgl", ".abc", ".mitshair", ".txt", ".pbrt"}) {
        const auto first = folder.file("first" + format);
        const auto second = folder.file("second" + format);
        exportStrands(uniformStrands(), first);
        exportStrands(importStrands(first), second);
        EXPECT_EQ(textOf(first), textOf(second)) << format;
    }
}

TEST(RoundTrip, KeepsRaggedStrandsWhereTheFormatDoes) {
    const TemporaryFolder folder;
    const StrandSet strands = hardStrands();
    for (const char* formats :
         {".hair", ".hair .ply .hair", ".hair .glb .hair", ".ply .gltf .hair", ".abc .hair .abc"}) {
        SCOPED_TRACE(formats);
        const StrandSet back = through(folder, strands, formats);
        expectCameBack(back, strands);
        expectBitEqual(back.colors.values, strands.colors.values);
    }
    StrandSet points_only = strands;
    points_only.widths = {};
    expectCameBack(through(folder, strands, ".obj .hair .obj"), points_only);
    expectCameBack(through(folder, strands, ".mitshair .hair .mitshair"), points_only);
    expectCameBack(through(folder, strands, ".txt .hair .txt"), strands);
    expectCameBack(through(folder, strands, ".pbrt .hair .pbrt .txt .pbrt"), strands);
}

TEST(RoundTrip, KeepsRootTrianglesInHgl) {
    const TemporaryFolder folder;
    StrandSet strands = uniformStrands();
    strands.root_triangles = {{0, 1, 1}, {1, 0, 0}};
    EXPECT_EQ(through(folder, strands, ".hgl .hgl").root_triangles, strands.root_triangles);
}

TEST(RoundTrip, KeepsPointsThroughListsAndArrays) {
    const TemporaryFolder folder;
    StrandSet ragged = hardStrands();
    ragged.widths = {};
    expectCameBack(through(folder, hardStrands(), ".data .hair .data .ply .data"), ragged);
    StrandSet uniform = uniformStrands();
    expectCameBack(through(folder, uniform, ".npz .hair .npz .tfx .npz"), uniform);
    uniform.widths = {};
    expectCameBack(through(folder, uniformStrands(), ".npy .data .npz .npy"), uniform);
}

TEST(RoundTrip, KeepsGroupsGuidesAndRootUvs) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    const TemporaryFolder folder;
    StrandSet strands = uniformStrands();
    strands.root_uvs = {{0.1f, 0.2f}, {1.0f / 3.0f, -0.0f}};
    strands.groups = {-7, 8};
    strands.guides = {0, 1};
    const StrandSet back = through(folder, strands, ".npz .usda .abc .usda .npz .abc");
    expectCameBack(back, strands);
    expectBitEqual(back.root_uvs, strands.root_uvs);
    EXPECT_EQ(back.groups, strands.groups);
    EXPECT_EQ(back.guides, strands.guides);
}

}  // namespace
}  // namespace hair::groom
