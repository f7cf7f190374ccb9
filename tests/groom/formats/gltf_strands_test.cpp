#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "tests/groom/formats/strand_files.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

template <class Value>
void put(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Two strands of three and two points, typed from the specification: 60 bytes of positions, 20 of
// widths, 20 of colours (VEC4 of normalized bytes), 12 of 16-bit indices.
std::string lineData() {
    std::string data;
    for (const float x :
         {0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 2.0f, 0.5f, 4.0f, 0.0f, 0.0f, 4.0f, 1.0f, 0.0f})
        put(data, x);
    for (const float width : {0.5f, 0.25f, 0.125f, 1.0f, 2.0f}) put(data, width);
    for (int i = 0; i < 5; ++i)
        for (const int share : {255, 51, 0, 204}) put(data, static_cast<std::uint8_t>(share));
    for (const int index : {0, 1, 1, 2, 3, 4}) put(data, static_cast<std::uint16_t>(index));
    return data;
}

// The parts of the document that tests change.
struct Document {
    std::string node = R"("mesh":0)";
    std::string attributes = R"("POSITION":0)";
    std::string primitive = R"("mode":1,"indices":3)";
    std::string more_primitives = "";
    std::string widths = R"("componentType":5126,"count":5,"type":"SCALAR")";
    std::string colors = R"("componentType":5121,"normalized":true,"count":5,"type":"VEC4")";
    std::string indices = R"("componentType":5123,"count":6,"type":"SCALAR")";
    std::string extra = "";
    std::string data = lineData();
};

std::string glb(const Document& document) {
    std::string json =
        R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{)" + document.node +
        R"(}],"meshes":[{"primitives":[{"attributes":{)" + document.attributes + "}," +
        document.primitive + "}" + document.more_primitives +
        R"(]}],"accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"},)"
        R"({"bufferView":1,)" +
        document.widths + R"(},{"bufferView":2,)" + document.colors + R"(},{"bufferView":3,)" +
        document.indices +
        R"(}],"bufferViews":[{"buffer":0,"byteLength":60},)"
        R"({"buffer":0,"byteOffset":60,"byteLength":20},)"
        R"({"buffer":0,"byteOffset":80,"byteLength":20},)"
        R"({"buffer":0,"byteOffset":100,"byteLength":12}],"buffers":[{"byteLength":)" +
        std::to_string(document.data.size()) + "}]" + document.extra + "}";
    while (json.size() % 4 != 0) json += ' ';
    std::string bytes = "glTF";
    put(bytes, 2u);
    put(bytes, static_cast<std::uint32_t>(28 + json.size() + document.data.size()));
    put(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    put(bytes, static_cast<std::uint32_t>(document.data.size()));
    return bytes + std::string("BIN\0", 4) + document.data;
}

StrandSet read(const Document& document) { return readText(importGltfStrands, glb(document)); }
std::string error(const Document& document) { return readError(importGltfStrands, glb(document)); }

TEST(ImportGltfStrands, ReadsLines) {
    const StrandSet strands = read({});
    EXPECT_THAT(strands.ends, ElementsAre(3, 5));
    EXPECT_THAT(
        strands.points, ElementsAre(
                            glm::vec3(0, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 2, 0.5f),
                            glm::vec3(4, 0, 0), glm::vec3(4, 1, 0)));
    EXPECT_EQ(strands.metres_per_unit, 1.0);
    EXPECT_FALSE(strands.widths.known() || strands.colors.known());
    EXPECT_THAT(strands.warnings, IsEmpty());
}

TEST(ImportGltfStrands, ReadsStrips) {
    EXPECT_THAT(read({.primitive = R"("mode":3)"}).ends, ElementsAre(5));
    const StrandSet strands = read(
        {.primitive = R"("mode":3,"indices":3)",
         .indices = R"("componentType":5123,"byteOffset":4,"count":2,"type":"SCALAR")"});
    EXPECT_THAT(strands.points, ElementsAre(glm::vec3(0, 1, 0), glm::vec3(0, 2, 0.5f)));
    EXPECT_THAT(strands.warnings, ElementsAre(HasSubstr("3 of 5 points belong to no strand")));
}

TEST(ImportGltfStrands, JoinsLinesWithoutIndicesWhereTheyTouch) {
    Document document{.primitive = R"("mode":1)"};
    // Keeps four of the five points, as the lines a b and b c.
    document.data.replace(24, 12, document.data.substr(12, 12));
    std::string bytes = glb(document);
    const std::size_t at = bytes.find(R"("count":5)");
    bytes.replace(at, 9, R"("count":4)");
    const StrandSet strands = readText(importGltfStrands, bytes);
    EXPECT_THAT(strands.ends, ElementsAre(3));
    EXPECT_THAT(
        strands.points, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(0, 1, 0), glm::vec3(4, 0, 0)));
    EXPECT_THAT(strands.warnings, IsEmpty());
}

TEST(ImportGltfStrands, ReadsWidthsAndColours) {
    const StrandSet strands = read({.attributes = R"("POSITION":0,"_WIDTH":1,"COLOR_0":2)"});
    EXPECT_THAT(strands.widths.values, ElementsAre(0.5f, 0.25f, 0.125f, 1, 2));
    EXPECT_EQ(strands.colors.at(4), glm::vec3(1.0f, 0.2f, 0.0f));
    EXPECT_EQ(strands.transparencies.at(4), 1.0f - 0.8f);
}

// A scale by 2, 2 and 16 changes volumes by 64 and so lengths, on average, by 4.
TEST(ImportGltfStrands, PlacesStrandsAsTheNodeSays) {
    const StrandSet strands = read(
        {.node = R"("mesh":0,"scale":[2,2,16],"translation":[10,0,0])",
         .attributes = R"("POSITION":0,"_WIDTH":1)"});
    EXPECT_EQ(strands.points[2], glm::vec3(10, 4, 8));
    EXPECT_FLOAT_EQ(strands.widths.at(0), 2.0f);
}

TEST(ImportGltfStrands, LeavesOutWhatIsNoLine) {
    const StrandSet strands = read(
        {.more_primitives = R"(,{"attributes":{"POSITION":0},"mode":0})"
                            R"(,{"attributes":{"POSITION":0,"_WIDTH":1},"mode":3})"});
    EXPECT_THAT(strands.ends, ElementsAre(3, 5, 10));
    // The mean of the five widths of the last strand.
    EXPECT_THAT(
        strands.widths.values,
        ElementsAre(0.775f, 0.775f, 0.775f, 0.775f, 0.775f, 0.5f, 0.25f, 0.125f, 1, 2));
    EXPECT_THAT(
        strands.warnings, ElementsAre(
                              "1 primitives that are not lines are left out",
                              "5 of 10 points have no width and get the mean width of the others"));
}

TEST(ImportGltfStrands, RefusesWhatIsNoStrand) {
    const std::string place = "mesh 0, primitive 0: ";
    EXPECT_THAT(error({.primitive = R"("mode":0)"}), StartsWith("the file has no strands"));
    EXPECT_THAT(error({.primitive = R"("mode":2)"}), StartsWith(place + "mode 2 is a closed loop"));
    EXPECT_THAT(
        error({.primitive = R"("mode":1)"}), StartsWith(place + "5 indices are not whole lines"));
    EXPECT_THAT(error({.attributes = R"("COLOR_0":2)"}), StartsWith(place + "no POSITION"));
    EXPECT_THAT(
        error(
            {.primitive = R"("mode":3,"indices":3)",
             .indices = R"("componentType":5123,"count":1,"type":"SCALAR")"}),
        StartsWith("no strand can be used; the file has only 1 strand of a single point"));
    Document document;
    document.data[104] = 0;  // lines 0 1, 1 2 become 0 1, 0 2 with the root at vertex 1
    EXPECT_EQ(read(document).points[0], glm::vec3(0, 1, 0));
    document.data[106] = 0;
    EXPECT_THAT(error(document), StartsWith(place + "line 1: the edge joins vertex 0 to itself"));
    document.data[106] = 5;
    EXPECT_THAT(error(document), StartsWith(place + "index 3 names vertex 5, but there are 5"));
}

TEST(ImportGltfStrands, RefusesWrongAttributes) {
    const std::string place = "mesh 0, primitive 0: ";
    const std::string widths = R"("POSITION":0,"_WIDTH":1)";
    const std::string colors = R"("POSITION":0,"COLOR_0":2)";
    EXPECT_THAT(
        error({.attributes = R"("POSITION":0,"_WIDTH":0)"}),
        StartsWith(place + "accessor 0: is not SCALAR of float"));
    EXPECT_THAT(
        error(
            {.attributes = widths, .widths = R"("componentType":5126,"count":4,"type":"SCALAR")"}),
        StartsWith(place + "_WIDTH and POSITION differ in count"));
    EXPECT_THAT(
        error({.attributes = colors, .colors = R"("componentType":5121,"count":5,"type":"VEC4")"}),
        StartsWith(place + "accessor 2: is not VEC4 of float"));
    EXPECT_THAT(
        error(
            {.attributes = widths,
             .widths = R"("componentType":5126,"count":4000000000,"type":"SCALAR")"}),
        StartsWith(place + "accessor 1: lies outside its buffer"));
}

// Node 1 is hidden, node 2 has Blender's custom properties, node 3 has none.
TEST(ImportGltfStrands, ReadsExtrasAndLeavesOutHiddenNodes) {
    const StrandSet strands = read(
        {.node = R"("children":[1,2,3]},)"
                 R"({"mesh":0,"extensions":{"KHR_node_visibility":{"visible":false}}},)"
                 R"({"mesh":0,"extras":{"groom_group_id":4,"groom_guide":true,"note":"x"}},)"
                 R"({"mesh":0)"});
    EXPECT_THAT(strands.ends, ElementsAre(3, 5, 8, 10));
    EXPECT_THAT(strands.groups, ElementsAre(4, 4, 5, 5));
    EXPECT_THAT(strands.guides, ElementsAre(1, 1, 0, 0));
    EXPECT_THAT(
        strands.warnings, ElementsAre(
                              "2 strands of hidden nodes are left out",
                              "2 of 4 strands have no group and become group 5"));
    EXPECT_THAT(
        error(
            {.node = R"("children":[1],"extensions":{"KHR_node_visibility":{"visible":false}}},)"
                     R"({"mesh":0)"}),
        StartsWith("the file has only hidden strands"));
    EXPECT_THAT(
        error({.node = R"("mesh":0,"extras":{"groom_group_id":0.5})"}),
        HasSubstr("'groom_group_id' in extras is not an int32"));
}

// The first strand has three points, the second two.
TEST(ImportGltfStrands, LeavesOutStrandsThatAreNotFinite) {
    Document document{.attributes = R"("POSITION":0,"_WIDTH":1)"};
    document.data.replace(62, 2, "\xc0\x7f");
    EXPECT_THAT(
        read(document).warnings, ElementsAre(leftOutStrand("with a width that is not finite", 0)));
    document.data.replace(14, 2, "\x80\xff");
    EXPECT_THAT(read(document).warnings, ElementsAre(leftOutStrand(kNoPosition, 0)));
    EXPECT_THAT(read(document).ends, ElementsAre(2));
}

TEST(ImportGltfStrands, NamesTheByteOfWhatIsNoGltf) {
    const auto errorOf = [](const std::string& text) { return readError(importGltfStrands, text); };
    EXPECT_THAT(errorOf(""), StartsWith("byte 0: is not JSON"));
    EXPECT_THAT(errorOf("{\"asset\":1e999}"), HasSubstr("number overflow"));
    EXPECT_THAT(errorOf("{\"asset\":}"), StartsWith("byte 9: is not JSON"));
    std::string bytes = glb({});
    bytes[4] = 1;
    EXPECT_THAT(errorOf(bytes), StartsWith("byte 4: version 1 of glTF"));
    bytes = glb({}) + "more";
    EXPECT_THAT(errorOf(bytes), StartsWith("byte 8: the header says"));
    bytes = glb({});
    bytes[20] = '[';
    EXPECT_THAT(errorOf(bytes), StartsWith("byte 28: is not JSON"));
    bytes = glb({});
    bytes[15] = '\x7f';
    EXPECT_THAT(errorOf(bytes), StartsWith("byte 12: truncated: the chunk has"));
}

// Tests JSON so deep that a recursive reader overflows the stack, and images outside their buffers.
TEST(ImportGltfStrands, SurvivesWhatItDoesNotRead) {
    const std::string deep = std::string(200000, '[') + std::string(200000, ']');
    EXPECT_THAT(error({.extra = R"(,"extras":)" + deep}), HasSubstr("more than 64 levels"));
    EXPECT_THAT(
        read({.extra = R"(,"images":[{"bufferView":2,"mimeType":"image/png"},)"
                       R"({"uri":"/etc/hostname"}],"textures":[{"source":0}],"cameras":[3])"})
            .ends,
        ElementsAre(3, 5));
}

// 20,000 nodes share 16,000 bytes of positions, and 1,500 nodes share 1,500 primitives.
TEST(ImportGltfStrands, HoldsWhatNodesShareAgainstTheFile) {
    const auto file = [](int nodes, int primitives, int count) {
        std::string scene = "0", all = R"({"mesh":0})", mesh;
        for (int i = 1; i < nodes; ++i) {
            scene += ',' + std::to_string(i);
            all += R"(,{"mesh":0})";
        }
        for (int i = 0; i < primitives; ++i)
            mesh += std::string(i > 0 ? "," : "") + R"({"attributes":{"POSITION":0},"mode":3})";
        const std::string bytes = std::to_string(12 * count);
        return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[)" + scene + R"(]}],"nodes":[)" +
               all + R"(],"meshes":[{"primitives":[)" + mesh +
               R"(]}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
               std::to_string(count) +
               R"(,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":)" + bytes +
               R"(}],"buffers":[{"byteLength":)" + bytes +
               R"(,"uri":"data:application/octet-stream;base64,)" +
               std::string(static_cast<std::size_t>(16 * count), 'A') + R"("}]})";
    };
    for (const std::string& text : {file(20000, 1, 1000), file(1500, 1500, 3)})
        EXPECT_THAT(
            readError(importGltfStrands, text), HasSubstr(" nodes with 1 meshes expand to"));
    EXPECT_EQ(readText(importGltfStrands, file(100, 1, 1000)).ends.size(), 100u);
}

TEST(ImportGltfStrands, OpensOtherFilesOnlyBesideItsOwn) {
    const TemporaryFolder folder;
    folder.write("data.bin", lineData());
    std::string json = glb({});
    json = json.substr(20, json.find("BIN") - 24);
    json.insert(json.find(R"("byteLength":112)"), R"("uri":"data.bin",)");
    const auto path = folder.write("lines.gltf", json);
    EXPECT_THAT(readFile(importGltfStrands, path).ends, ElementsAre(3, 5));
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const std::string message = readError(importGltfStrands, json);
    std::filesystem::current_path(before);
    EXPECT_THAT(message, StartsWith("File not found : data.bin"));
    // Without a check, the file's own folder is the limit.
    const auto below = folder.write("below/lines.gltf", json);
    std::filesystem::create_symlink("../data.bin", folder.file("below/data.bin"));
    EXPECT_THAT(
        errorText([&] { importStrands(below); }),
        HasSubstr("the folder of the file that names it"));
}

void expectSame(const StrandSet& read, const StrandSet& strands) {
    EXPECT_EQ(read.ends, strands.ends);
    expectBitEqual(read.points, strands.points);
    expectBitEqual(read.widths.values, strands.widths.values);
    expectBitEqual(read.transparencies.values, strands.transparencies.values);
    expectBitEqual(read.colors.values, strands.colors.values);
    EXPECT_EQ(read.metres_per_unit, 1.0);
    EXPECT_THAT(read.warnings, IsEmpty());
}

TEST(ExportGltf, ReadsBackBitEqual) {
    StrandSet strands = hardStrands();
    strands.metres_per_unit = 1.0;
    for (const WriteStrands write : {exportGltf, exportGlb}) {
        const Written written = writeText(write, strands);
        EXPECT_THAT(written.warnings, IsEmpty());
        EXPECT_EQ(written.bytes.starts_with("glTF"), write == &exportGlb);
        expectSame(readText(importGltfStrands, written.bytes), strands);
    }
}

TEST(ExportGltf, ScalesToMetresByItsNode) {
    StrandSet strands;
    strands.ends = {2};
    strands.points = {{0, 0, 0}, {0, 100, 0}};
    strands.widths.everywhere = 0.0078125f;
    strands.metres_per_unit = 0.25;
    const StrandSet read = readText(importGltfStrands, writeText(exportGlb, strands).bytes);
    EXPECT_EQ(read.points[1], glm::vec3(0, 25, 0));
    // The cube root of the cube is off by an ulp or two.
    EXPECT_FLOAT_EQ(read.widths.at(1), 0.0078125f / 4.0f);
}

TEST(ExportGltf, SaysWhatItLeavesOut) {
    StrandSet strands = hardStrands();
    strands.comment = "by hand";
    strands.root_uvs.resize(3);
    EXPECT_THAT(
        writeText(exportGlb, strands).warnings,
        ElementsAre(
            HasSubstr("texture coordinates"), HasSubstr("comment"),
            HasSubstr("the unit of length is not known")));
}

}  // namespace
}  // namespace hair::groom
