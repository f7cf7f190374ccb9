#include <gmock/gmock.h>

#include "hair/groom/formats/ply.h"
#include "tests/groom/formats/strand_files.h"

namespace hair::groom {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// Typed from the format's description, two strands of three and two points.
const std::string kVertexRows = "0 0 0\n0 1 0\n0 2 0.5\n4 0 0\n4 1 0\n";

std::string ascii(const std::string& elements, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

std::string vertexElement(const std::string& more = "") {
    return "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n" + more;
}

const std::string kEdges = "element edge 3\nproperty int vertex1\nproperty int vertex2\n";
const std::string kLists = "element polyline 2\nproperty list uchar int vertex_indices\n";

template <class Value>
void put(std::string& bytes, Value value, bool swapped) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    bytes += swapped ? std::string(raw.rbegin(), raw.rend()) : raw;
}

// The same strands, binary: coordinates of double, lists of short.
std::string binary(bool big_endian) {
    std::string bytes =
        std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
        "_endian 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
        "property double z\nproperty uchar flag\nelement strand 2\n"
        "property float length\nproperty list uint short vertex_index\nend_header\n";
    for (const glm::dvec3 point :
         {glm::dvec3(0, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 2, 0.5), glm::dvec3(4, 0, 0),
          glm::dvec3(4, 1, 0)}) {
        for (int axis = 0; axis < 3; ++axis) put(bytes, point[axis], big_endian);
        put(bytes, std::uint8_t{9}, big_endian);
    }
    for (const auto& list : {std::vector<std::int16_t>{0, 1, 2}, {3, 4}}) {
        put(bytes, 2.5f, big_endian);
        put(bytes, static_cast<std::uint32_t>(list.size()), big_endian);
        for (const std::int16_t index : list) put(bytes, index, big_endian);
    }
    return bytes;
}

std::string errorOfPly(const std::string& text) { return readError(importPly, text); }

TEST(ImportPly, ReadsEdges) {
    expectTheStrands(
        readText(importPly, ascii(vertexElement() + kEdges, kVertexRows + "1 2\n0 1\n3 4\n")));
}

TEST(ImportPly, ReadsListsWithWindowsLineEnds) {
    std::string text = ascii(vertexElement() + kLists, kVertexRows + "3 0 1 2\n2 3 4\n");
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.insert(at, "\r");
    expectTheStrands(readText(importPly, text));
}

TEST(ImportPly, ReadsElementsInAnyOrder) {
    expectTheStrands(
        readText(importPly, ascii(kEdges + vertexElement(), "1 2\n0 1\n3 4\n" + kVertexRows)));
}

TEST(ImportPly, ReadsBothByteOrders) {
    for (const bool big_endian : {false, true}) {
        const StrandSet strands = readText(importPly, binary(big_endian));
        expectTheStrands(strands);
        EXPECT_THAT(
            strands.warnings,
            ElementsAre(HasSubstr("'flag' are left out"), HasSubstr("rounded to floats")));
    }
}

TEST(ImportPly, ReadsNegativeIntegers) {
    for (const bool big_endian : {false, true}) {
        std::string bytes = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                            "_endian 1.0\nelement vertex 2\nproperty char x\nproperty short y\n"
                            "property int z\nelement edge 1\nproperty uchar vertex1\n"
                            "property uchar vertex2\nend_header\n";
        for (const int sign : {1, -1}) {
            put(bytes, static_cast<std::int8_t>(sign * 5), big_endian);
            put(bytes, static_cast<std::int16_t>(sign * 300), big_endian);
            put(bytes, static_cast<std::int32_t>(sign * 70000), big_endian);
        }
        bytes += std::string("\0\1", 2);
        EXPECT_THAT(
            readText(importPly, bytes).points,
            ElementsAre(glm::vec3(5, 300, 70000), glm::vec3(-5, -300, -70000)));
    }
}

TEST(ImportPly, ReadsWidthsAndColours) {
    const std::string vertices =
        "0 0 0 0.25 255 0 51 0.75\n0 1 0 0.5 0 0 0 1\n0 2 0.5 1 0 0 0 1\n4 0 0 1 0 0 0 1\n"
        "4 1 0 1 0 0 0 0\n";
    const StrandSet strands = readText(
        importPly,
        ascii(
            vertexElement("property float radius\nproperty uchar red\nproperty uchar green\n"
                          "property uchar blue\nproperty float alpha\n") +
                kLists,
            vertices + "3 0 1 2\n2 3 4\n"));
    EXPECT_THAT(strands.widths.values, ElementsAre(0.5f, 1, 2, 2, 2));
    EXPECT_EQ(strands.colors.at(0), glm::vec3(1.0f, 0.0f, 0.2f));
    EXPECT_THAT(strands.transparencies.values, ElementsAre(0.25f, 0, 0, 0, 1));
}

TEST(ImportPly, LeavesOutWhatStrandsDontUse) {
    const StrandSet strands = readText(
        importPly, ascii(
                       "comment two lines\ncomment of comment\n" +
                           vertexElement("property float nx\nproperty list uchar int tags\n") +
                           "element face 1\nproperty list uchar int vertex_indices\n" + kEdges,
                       "0 0 0 1 0\n0 1 0 1 2 7 7\n0 2 0.5 1 0\n9 9 9 1 1 7\n4 1 0 1 0\n3 0 1 2\n"
                       "0 1\n1 2\n2 4\n"));
    EXPECT_THAT(strands.ends, ElementsAre(4));
    EXPECT_THAT(
        strands.warnings,
        ElementsAre(
            "the vertices' 'nx', 'tags' are left out", "1 of element 'face' are left out",
            "1 of 5 points belong to no strand and are left out"));
    EXPECT_EQ(strands.comment, "two lines\nof comment");
}

TEST(ImportPly, RefusesFilesWithoutStrands) {
    const std::string expected = "expected an element 'edge' with integers vertex1 and vertex2";
    EXPECT_THAT(
        errorOfPly(ascii(vertexElement(), kVertexRows)),
        AllOf(StartsWith("line 7: "), HasSubstr(expected)));
    EXPECT_THAT(
        errorOfPly(ascii(
            vertexElement() + "element face 1\nproperty list uchar int vertex_indices\n",
            kVertexRows + "3 0 1 2\n")),
        HasSubstr(expected));
    EXPECT_THAT(
        errorOfPly(ascii(
            vertexElement() + "element edge 0\nproperty int vertex1\nproperty int vertex2\n",
            kVertexRows)),
        HasSubstr(expected));
    EXPECT_THAT(errorOfPly(ascii(kEdges, "")), HasSubstr("no element 'vertex'"));
}

TEST(ImportPly, RefusesWrongHeaders) {
    EXPECT_THAT(errorOfPly(""), StartsWith("line 1: the file ends here"));
    EXPECT_THAT(errorOfPly("plx\n"), StartsWith("line 1: not a PLY file"));
    EXPECT_THAT(
        errorOfPly("ply\nend_header\n"), StartsWith("line 2: the header has no line 'format'"));
    EXPECT_THAT(
        errorOfPly("ply\nformat ebcdic 1.0\n"), StartsWith("line 2: unknown format 'ebcdic'"));
    EXPECT_THAT(
        errorOfPly(ascii("property float x\n", "")), StartsWith("line 3: a property before"));
    EXPECT_THAT(
        errorOfPly(ascii("element vertex -1\n", "")), StartsWith("line 3: '-1' is not a count"));
    EXPECT_THAT(errorOfPly(ascii("element vertex\n", "")), StartsWith("line 3: '' is not a count"));
    EXPECT_THAT(
        errorOfPly(ascii("element vertex 1\n", "")), StartsWith("line 4: element 'vertex' has"));
    EXPECT_THAT(
        errorOfPly(ascii("element vertex 1\nproperty half x\n", "")),
        StartsWith("line 4: unknown type 'half'"));
    EXPECT_THAT(
        errorOfPly(ascii("element vertex 1\nproperty list float int x\n", "")),
        StartsWith("line 4: a list's length"));
    EXPECT_THAT(
        errorOfPly(ascii(vertexElement() + vertexElement(), "")),
        HasSubstr("'vertex' appears twice"));
}

// The reader allocates nothing for counts that the file can't hold: these would take 48 GB and
// more.
TEST(ImportPly, RefusesCountsThatTheFileCantHold) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const std::string begin = std::string("ply\nformat ") + format + " 1.0\nelement vertex ";
        const std::string rest = "\nproperty float x\nproperty float y\nproperty float z\n" +
                                 kEdges + "end_header\n" + std::string(200, ' ');
        EXPECT_THAT(errorOfPly(begin + "4000000000" + rest), HasSubstr("truncated: 4000000000 of"));
        EXPECT_THAT(
            errorOfPly(begin + "9000000000000000000" + rest), HasSubstr("at most 2^32 - 1"));
        EXPECT_THAT(errorOfPly(begin + "99999999999999999999" + rest), HasSubstr("is not a count"));
    }
    std::string list = binary(false);
    list.replace(list.size() - 8, 4, std::string(4, '\xff'));
    EXPECT_THAT(errorOfPly(list), HasSubstr("a list of 4294967295 values is expected"));
}

TEST(ImportPly, LeavesOutStrandsThatAreNotFinite) {
    const std::string edges = vertexElement() + kEdges;
    for (const std::string wrong : {"nan", "1e39"}) {
        const StrandSet set = readText(
            importPly,
            ascii(edges, "0 0 0\n0 " + wrong + " 0\n0 0 0\n0 0 0\n0 0 0\n0 1\n1 2\n3 4\n"));
        EXPECT_THAT(set.ends, testing::ElementsAre(2)) << wrong;
        EXPECT_THAT(set.warnings, testing::ElementsAre(leftOutStrand(kNoPosition, 0)));
    }
}

TEST(ImportPly, RefusesWrongValues) {
    const std::string edges = vertexElement() + kEdges;
    EXPECT_THAT(
        errorOfPly(ascii(edges, kVertexRows + "0 1\n1 5\n3 4\n")),
        StartsWith("line 17: vertex 5 is named, but there are 5"));
    EXPECT_THAT(
        errorOfPly(ascii(edges, kVertexRows + "0 1\n1 -1\n3 4\n")),
        StartsWith("line 17: vertex -1 is named, but there are 5"));
    EXPECT_THAT(
        errorOfPly(ascii(edges, kVertexRows + "0 1\n1 2\n4 1\n")),
        StartsWith("line 18: this is a third edge at vertex 1"));
    EXPECT_THAT(
        errorOfPly(ascii(edges, kVertexRows + "0 1\n1 2\n3  \n")), StartsWith("line 18: the line"));
    EXPECT_THAT(
        errorOfPly(ascii(edges, kVertexRows + "0 1\n1 2\n3 4 5\n")),
        StartsWith("line 18: '5' is one value more"));
    EXPECT_THAT(
        errorOfPly(ascii(edges, kVertexRows + "0 1\n1 2.5\n3 4\n")),
        StartsWith("line 17: '2.5' is not an integer"));
    EXPECT_THAT(
        errorOfPly(ascii(edges, kVertexRows + "0 1\n1 2\n3 4\nmore\n")),
        StartsWith("line 19: 'more' after the last element"));
    EXPECT_THAT(
        readText(importPly, ascii(vertexElement() + kLists, kVertexRows + "3 0 1 2\n0\n")).warnings,
        testing::Contains(leftOutStrand("without points", 1)));
}

TEST(ImportPly, NamesTheByteInBinaryFiles) {
    std::string bytes = binary(false);
    const std::size_t last = bytes.size() - 2;
    bytes[last] = 5;
    EXPECT_EQ(
        errorOfPly(bytes), "byte " + std::to_string(last) + ": vertex 5 is named, but there are 5");
    bytes = binary(false) + "x";
    EXPECT_EQ(
        errorOfPly(bytes),
        "byte " + std::to_string(bytes.size() - 1) + ": 1 trailing bytes after the last element");
}

TEST(ExportPly, ReadsBackBitEqual) {
    StrandSet strands = hardStrands();
    strands.comment = "first line\n\n  third line";
    const Written written = writeText(exportPly, strands);
    EXPECT_TRUE(written.warnings.empty());
    const StrandSet read = readText(importPly, written.bytes);
    EXPECT_EQ(read.ends, strands.ends);
    expectBitEqual(read.points, strands.points);
    expectBitEqual(read.widths.values, strands.widths.values);
    expectBitEqual(read.transparencies.values, strands.transparencies.values);
    expectBitEqual(read.colors.values, strands.colors.values);
    EXPECT_EQ(read.comment, strands.comment);
    EXPECT_TRUE(read.warnings.empty());
}

TEST(ExportPly, WritesWhatIsTheSameEverywhere) {
    StrandSet strands = hardStrands();
    strands.widths = {.everywhere = 0.1f};
    strands.colors = {};
    const StrandSet read = readText(importPly, writeText(exportPly, strands).bytes);
    expectBitEqual(read.widths.values, std::vector(strands.points.size(), 0.1f));
    EXPECT_FALSE(read.colors.known());
}

TEST(ExportPly, SaysWhatItLeavesOut) {
    StrandSet strands = hardStrands();
    strands.root_uvs.resize(3);
    strands.root_triangles = {{0, 1, 2}};
    strands.metres_per_unit = 0.01;
    EXPECT_THAT(
        writeText(exportPly, strands).warnings,
        ElementsAre(
            HasSubstr("texture coordinates"), HasSubstr("root triangles"), HasSubstr("unit")));
}

StrandSet readPlyOf(std::uint32_t points_per_strand, const std::string& text) {
    return importPly(
        {.bytes = std::as_bytes(std::span(text)), .points_per_strand = points_per_strand});
}

std::string errorOfPlyOf(std::uint32_t points_per_strand, const std::string& text) {
    return errorText([&] { readPlyOf(points_per_strand, text); });
}

// Reconstructions from pictures write points alone, strand after strand.
TEST(ImportPly, MakesStrandsOfSoManyPointsEach) {
    const std::string points_alone = ascii(vertexElement(), kVertexRows);
    const StrandSet strand = readPlyOf(5, points_alone);
    EXPECT_THAT(strand.ends, ElementsAre(5));
    EXPECT_EQ(strand.points[4], glm::vec3(4, 1, 0));
    EXPECT_THAT(readPlyOf(1, points_alone).ends, ElementsAre(1, 2, 3, 4, 5));
    EXPECT_EQ(
        errorOfPlyOf(2, points_alone), "line 7: 5 vertices do not divide into strands of 2 points");
    EXPECT_THAT(
        errorOfPly(points_alone),
        AllOf(StartsWith("line 7: the file has no strands"), HasSubstr("--points-per-strand")));
    EXPECT_THAT(
        errorOfPlyOf(
            5, ascii(
                   "element vertex 0\nproperty float x\nproperty float y\n"
                   "property float z\n",
                   "")),
        HasSubstr("do not divide into strands"));
}

// The file's own strands take precedence. A mesh beside the points gives no strands.
TEST(ImportPly, TakesTheNumberOfPointsWhereTheFileHasNoStrandsAlone) {
    expectTheStrands(
        readPlyOf(5, ascii(vertexElement() + kEdges, kVertexRows + "1 2\n0 1\n3 4\n")));
    const StrandSet beside_faces = readPlyOf(
        5, ascii(
               vertexElement() + "element edge 0\nproperty int vertex1\nproperty int vertex2\n"
                                 "element face 1\nproperty list uchar int vertex_indices\n",
               kVertexRows + "3 0 1 2\n"));
    EXPECT_THAT(beside_faces.ends, ElementsAre(5));
    EXPECT_THAT(beside_faces.warnings, ElementsAre("1 of element 'face' are left out"));
}

}  // namespace
}  // namespace hair::groom
