#include <cmath>
#include <cstring>
#include <limits>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

template <class Value>
void put(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A triangle in the plane y = 0 that faces +y: 36 bytes of positions, 36 of normals, 6 of 16-bit
// indices, 2 unused.
std::string triangleData() {
    std::string data;
    for (const float value : {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 2.0f, 0.0f, 0.0f})
        put(data, value);
    for (int i = 0; i < 3; ++i) {
        for (const float value : {0.0f, 1.0f, 0.0f}) put(data, value);
    }
    for (const int index : {0, 1, 2, 0}) put(data, static_cast<std::uint16_t>(index));
    return data;
}

// The parts of the document that tests change.
struct Document {
    std::string node = R"("mesh":0)";
    std::string more_nodes = "";
    std::string attributes = R"("POSITION":0,"NORMAL":1)";
    std::string primitive = R"("indices":2,"material":1)";
    std::string position = R"("componentType":5126,"count":3,"type":"VEC3")";
    std::string indices = R"("componentType":5123,"count":3,"type":"SCALAR")";
    std::string more_accessors = "";
    std::string extra = "";
    int view_size = 6;  // of indices, bytes
    std::string data = triangleData();
};

std::string glb(const Document& document) {
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{)" +
        document.node + "}" + document.more_nodes +
        R"(],"meshes":[{"primitives":[{"attributes":{)" + document.attributes + "}," +
        document.primitive +
        R"(}]}],"materials":[{"name":"skin"},{"name":"scalp",)"
        R"("pbrMetallicRoughness":{"baseColorFactor":[1.0,0.5,0.0,1.0]}}],"accessors":[)"
        R"({"bufferView":0,)" +
        document.position +
        R"(},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":2,)" +
        document.indices + "}" + document.more_accessors +
        R"(],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},)"
        R"({"buffer":0,"byteOffset":36,"byteLength":36},{"buffer":0,"byteOffset":72,"byteLength":)" +
        std::to_string(document.view_size) + R"(}],"buffers":[{"byteLength":)" +
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

Mesh import(const Document& document) {
    const TemporaryFolder folder;
    return importMesh(folder.write("a.glb", glb(document)));
}

std::string errorOfBytes(const std::string& bytes) {
    const TemporaryFolder folder;
    const auto path = folder.write("a.glb", bytes);
    const std::string error = errorText([&] { importMesh(path); });
    EXPECT_THAT(error, AllOf(StartsWith(path.string() + ": "), Not(HasSubstr("\n"))));
    return error;
}

std::string importError(const Document& document) { return errorOfBytes(glb(document)); }

// Counter-clockwise, the area vector (0, 1, 0).
glm::vec3 areaVector(const Mesh& mesh) {
    const auto& [a, b, c] = mesh.triangles.at(0);
    const glm::vec3 edge = mesh.positions[b] - mesh.positions[a];
    return 0.5f * glm::cross(edge, mesh.positions[c] - mesh.positions[a]);
}

TEST(ImportGltf, ReadsATriangle) {
    const Mesh mesh = import({});
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(2, 0, 0));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 1, 0));
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(areaVector(mesh), glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.materials.at(mesh.triangle_materials.at(0)).name, "scalp");
}

// sRGB's table: linear 0.5 is 188 of 255.
TEST(ImportGltf, TurnsLinearColourIntoDisplayColour) {
    const Mesh mesh = import({});
    const glm::vec3 color = mesh.materials.at(mesh.triangle_materials.at(0)).base_color;
    EXPECT_FLOAT_EQ(color.r, 1.0f);
    EXPECT_NEAR(color.g, 188.0f / 255.0f, 0.5f / 255.0f);
    EXPECT_EQ(color.b, 0.0f);
}

TEST(ImportGltf, ReadsUnindexedTrianglesWithoutMaterial) {
    const Mesh mesh = import({.primitive = R"("mode":4)"});
    EXPECT_EQ(areaVector(mesh), glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.materials.at(mesh.triangle_materials.at(0)).name, "default");
}

TEST(ImportGltf, ComputesMissingNormals) {
    const Mesh mesh = import({.attributes = R"("POSITION":0)"});
    for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 1, 0));
}

TEST(ImportGltf, AppliesNodeTransforms) {
    // A quarter turn about +x takes +y to +z: (x, y, z) -> (x, -z, y); the parent doubles and
    // moves.
    const Mesh mesh = import(
        {.node = R"("children":[1],"scale":[2,2,2],"translation":[10,0,0])",
         .more_nodes = R"(,{"mesh":0,"rotation":[0.7071067811865476,0,0,0.7071067811865476]})"});
    EXPECT_LT(glm::distance(mesh.positions[1], glm::vec3(10, -2, 0)), 1e-6f);
    EXPECT_LT(glm::distance(mesh.positions[2], glm::vec3(14, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(mesh.normals[0], glm::vec3(0, 0, 1)), 1e-6f);
    EXPECT_LT(glm::distance(areaVector(mesh), glm::vec3(0, 0, 4)), 1e-5f);
}

TEST(ImportGltf, ReadsMatricesByColumns) {
    const Mesh mesh = import({.node = R"("mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,3,0, 5,6,7,1])"});
    EXPECT_EQ(mesh.positions[1], glm::vec3(5, 6, 10));
}

TEST(ImportGltf, KeepsMirroredTrianglesFacingOut) {
    const Mesh mesh = import({.node = R"("mesh":0,"scale":[-1,1,1])"});
    EXPECT_EQ(mesh.positions[2], glm::vec3(-2, 0, 0));
    EXPECT_EQ(areaVector(mesh), glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 1, 0));
}

TEST(ImportGltf, ReadsJsonWithEmbeddedData) {
    const TemporaryFolder folder;
    // Three float positions, (0,0,0) (0,0,1) (2,0,0), in base 64.
    const Mesh mesh = importMesh(folder.write("a.gltf", R"({"asset":{"version":"2.0"},"scene":0,
        "scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAQAAAAAAAAAAA"}]})"));
    EXPECT_EQ(areaVector(mesh), glm::vec3(0, 1, 0));
}

TEST(ImportGltf, ReadsTheHead) {
    const Mesh mesh = importMesh(std::string(HAIRBENCH_SCENES_DIR) + "/assets/head.glb");
    EXPECT_EQ(mesh.materials.size(), 3u);  // glTF's default, skin, scalp
    EXPECT_EQ(mesh.triangle_materials.size(), mesh.triangles.size());
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
}

// The vertices' numbers also serve as texture coordinates (the first two of each three) and as
// weights.
TEST(ImportGltf, ReadsTextureCoordinates) {
    EXPECT_TRUE(import({}).texture_coordinates.empty());
    const Mesh mesh = import(
        {.attributes = R"("POSITION":0,"TEXCOORD_0":3)",
         .more_accessors = R"(,{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"})"});
    EXPECT_THAT(
        mesh.texture_coordinates, ElementsAre(glm::vec2(0, 0), glm::vec2(0, 0), glm::vec2(0, 1)));
    // Indices 0 1, 2 0 as shares of the greatest number.
    const Mesh shares = import(
        {.attributes = R"("POSITION":0,"TEXCOORD_0":3)",
         .more_accessors = R"(,{"bufferView":2,"componentType":5121,"normalized":true,)"
                           R"("count":3,"type":"VEC2"})"});
    EXPECT_THAT(
        shares.texture_coordinates,
        ElementsAre(glm::vec2(0, 0), glm::vec2(1.0f / 255.0f, 0), glm::vec2(2.0f / 255.0f, 0)));
    EXPECT_THAT(
        importError({.attributes = R"("POSITION":0,"TEXCOORD_0":0)"}),
        HasSubstr("accessor 0: is not VEC2 of float"));
}

TEST(ImportGltf, ReadsItsOwnScalarsAsVertexGroups) {
    const Mesh mesh = import(
        {.attributes = R"("POSITION":0,"_SCALP":3,"_BEYOND":4,"_NORMAL":1)",
         .more_accessors = R"(,{"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR"})"
                           R"(,{"bufferView":0,"byteOffset":20,"componentType":5126,"count":3,)"
                           R"("type":"SCALAR"})"});
    ASSERT_EQ(mesh.vertex_groups.size(), 1u);  // the values of the other attributes are not between
                                               // 0 and 1
    EXPECT_EQ(mesh.vertex_groups[0].name, "scalp");
    EXPECT_THAT(mesh.vertex_groups[0].weights, ElementsAre(0, 1, 0));
    EXPECT_THAT(
        importError(
            {.attributes = R"("POSITION":0,"_SCALP":3)",
             .more_accessors =
                 R"(,{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR"})"}),
        HasSubstr("_SCALP and POSITION differ in count"));
}

TEST(ImportGltf, NamesParts) {
    EXPECT_THAT(import({}).parts, ElementsAre(""));
    const Mesh mesh = import(
        {.node = R"("mesh":0,"name":"head","children":[1])",
         .more_nodes = R"(,{"mesh":0,"name":"bust"})"});
    EXPECT_THAT(mesh.parts, ElementsAre("head", "bust"));
    EXPECT_THAT(mesh.triangle_parts, ElementsAre(0, 1));
}

TEST(ImportGltf, ReadsStripsAndFans) {
    // The vertices 0 1 2, and 0 again.
    const std::string four = R"("componentType":5123,"count":4,"type":"SCALAR")";
    Document document{.primitive = R"("mode":5,"indices":2)", .indices = four};
    document.view_size = 8;
    using Corners = std::vector<std::array<std::uint32_t, 3>>;
    EXPECT_EQ(import(document).triangles, (Corners{{0, 1, 2}, {1, 0, 2}}));
    document.primitive = R"("mode":6,"indices":2)";
    EXPECT_EQ(import(document).triangles, (Corners{{1, 2, 0}, {2, 0, 0}}));
}

TEST(ImportGltf, SkipsHairBesideTheHead) {
    const Mesh mesh =
        import({.primitive = R"("indices":2},{"attributes":{"POSITION":0},"mode":3)"});
    EXPECT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(ImportGltf, RefusesWrongIndicesAndPositions) {
    Document document;
    document.data[72] = 3;
    EXPECT_THAT(
        importError(document),
        HasSubstr("mesh 0, primitive 0: index 0 names vertex 3, but there are 3"));
    document = {};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(document.data.data() + 16, &nan, 4);
    EXPECT_THAT(importError(document), HasSubstr("the position of vertex 1 is not finite"));
    EXPECT_THAT(
        importError({.indices = R"("componentType":5123,"count":2,"type":"SCALAR")"}),
        HasSubstr("2 indices are not whole triangles"));
    EXPECT_THAT(
        importError({.indices = R"("componentType":5123,"count":0,"type":"SCALAR")"}),
        HasSubstr("no triangles"));
    EXPECT_THAT(
        importError({.indices = R"("componentType":5126,"count":1,"type":"SCALAR")"}),
        HasSubstr("accessor 2"));
}

TEST(ImportGltf, RefusesAccessorsOutsideTheirBuffer) {
    for (const char* position :
         {R"("componentType":5126,"count":4,"type":"VEC3")",
          R"("componentType":5126,"count":4000000000,"type":"VEC3")",
          R"("byteOffset":4,"componentType":5126,"count":3,"type":"VEC3")",
          R"("byteOffset":4000000,"componentType":5126,"count":3,"type":"VEC3")"}) {
        EXPECT_THAT(importError({.position = position}), HasSubstr("outside its buffer"))
            << position;
    }
    EXPECT_THAT(
        importError({.data = triangleData().substr(0, 72)}), HasSubstr("outside its buffer"));
}

TEST(ImportGltf, RefusesWhatItDoesNotRead) {
    EXPECT_THAT(importError({.primitive = R"("mode":1)"}), HasSubstr("the mesh has no triangles"));
    EXPECT_THAT(importError({.attributes = R"("NORMAL":1)"}), HasSubstr("no POSITION"));
    EXPECT_THAT(
        importError({.position = R"("componentType":5126,"count":3,"type":"VEC2")"}),
        HasSubstr("is not VEC3 of float"));
    EXPECT_THAT(
        importError(
            {.extra = R"(,"extensionsUsed":["EXT_mesh_of_tomorrow"],)"
                      R"("extensionsRequired":["EXT_mesh_of_tomorrow"])"}),
        HasSubstr("needs EXT_mesh_of_tomorrow, which is not supported"));
}

// KHR_node_visibility: a node without `visible: true` of its own is hidden by one above it.
TEST(ImportGltf, LeavesOutHiddenNodes) {
    const std::string hidden = R"("extensions":{"KHR_node_visibility":{"visible":false}})";
    const std::string shown = R"("extensions":{"KHR_node_visibility":{"visible":true}})";
    const std::string child = R"(,{"mesh":0,"translation":[5,0,0]})";
    const Mesh both = import({.node = R"("mesh":0,"children":[1],)" + shown, .more_nodes = child});
    EXPECT_EQ(both.triangles.size(), 2u);
    const Mesh one = import(
        {.node = R"("mesh":0,"children":[1])",
         .more_nodes = R"(,{"mesh":0,"translation":[5,0,0],)" + hidden + "}"});
    ASSERT_EQ(one.triangles.size(), 1u);
    EXPECT_EQ(one.positions.at(2), glm::vec3(2, 0, 0));
    EXPECT_THAT(both.warnings, ElementsAre());
    EXPECT_THAT(one.warnings, ElementsAre("1 hidden mesh is left out"));
    EXPECT_TRUE(one.is_placed);
    EXPECT_THAT(
        importError({.node = R"("mesh":0,"children":[1],)" + hidden, .more_nodes = child}),
        HasSubstr("the file has only hidden meshes: show them, then export"));
}

// KHR_mesh_quantization: whole numbers of 16 bits, which the node's scale makes metres, and
// normals of normalized bytes, 127 for 1. (Files have them at multiples of 4 bytes.)
TEST(ImportGltf, ReadsQuantizedVectors) {
    std::string data;
    for (const int value : {0, 0, 0, 0, 0, 1024, 2048, 0, 0})
        put(data, static_cast<std::int16_t>(value));
    data.resize(36, '\0');
    for (int i = 0; i < 3; ++i)
        for (const int value : {0, 127, 0}) put(data, static_cast<std::int8_t>(value));
    data.resize(72, '\0');
    for (const int index : {0, 1, 2, 0}) put(data, static_cast<std::uint16_t>(index));
    Document document{
        .node = R"("mesh":0,"scale":[0.0009765625,0.0009765625,0.0009765625])",
        .attributes = R"("POSITION":0,"NORMAL":3)",
        .position = R"("componentType":5122,"count":3,"type":"VEC3")",
        .more_accessors =
            R"(,{"bufferView":1,"componentType":5120,"normalized":true,"count":3,"type":"VEC3"})",
        .data = data};
    EXPECT_THAT(importError(document), HasSubstr("is not VEC3 of float"));
    document.extra = R"(,"extensionsUsed":["KHR_mesh_quantization"],)"
                     R"("extensionsRequired":["KHR_mesh_quantization"])";
    const Mesh mesh = import(document);
    EXPECT_THAT(mesh.positions, ElementsAre(glm::vec3(0), glm::vec3(0, 0, 1), glm::vec3(2, 0, 0)));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 1, 0));
}

TEST(ImportGltf, RefusesWrongReferences) {
    EXPECT_THAT(importError({.node = R"("mesh":7)"}), HasSubstr("mesh 7"));
    EXPECT_THAT(importError({.attributes = R"("POSITION":9)"}), HasSubstr("accessor 9"));
    EXPECT_THAT(importError({.primitive = R"("indices":2,"material":5)"}), HasSubstr("material 5"));
    EXPECT_THAT(importError({.node = R"("children":[4])"}), HasSubstr("node 4"));
    EXPECT_THAT(
        importError({.node = R"("children":[1])", .more_nodes = R"(,{"children":[0]})"}),
        HasSubstr("node 0: is reached twice"));
}

TEST(ImportGltf, RefusesEveryTruncation) {
    const std::string bytes = glb({});
    for (std::size_t size = 0; size < bytes.size(); ++size) errorOfBytes(bytes.substr(0, size));
    errorOfBytes("");
    errorOfBytes("glTF");
    errorOfBytes(std::string(1000, 'x'));
}

}  // namespace
}  // namespace hair::groom
