#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include "hair/groom/files.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/groom/test_meshes.h"
#include "tests/temporary_folder.h"

// Files are compressed by the libraries' own encoders and compared with the data before.
namespace hair::groom {
namespace {

using testing::HasSubstr;

template <class Value>
void put(std::string& bytes, const Value& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Values>
std::string bytesOf(const Values& values) {
    return {
        reinterpret_cast<const char*>(std::data(values)), std::size(values) * sizeof(values[0])};
}

std::string glb(std::string json, std::string data) {
    while (json.size() % 4 != 0) json += ' ';
    data.resize((data.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    put(bytes, 2u);
    put(bytes, static_cast<std::uint32_t>(28 + json.size() + data.size()));
    put(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    put(bytes, static_cast<std::uint32_t>(data.size()));
    return bytes + std::string("BIN\0", 4) + data;
}

// Numbers in JSON.
std::string number(std::size_t value) { return std::to_string(value); }

// A head of 1,153 vertices, the numbers of them in one list.
struct Head {
    Mesh mesh = makeCap();
    std::vector<std::uint32_t> indices;

    Head() {
        for (const auto& triangle : mesh.triangles)
            indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
};

Mesh import(const std::string& bytes) {
    const TemporaryFolder folder;
    return importMesh(folder.write("head.glb", bytes));
}

std::string errorOf(const std::string& bytes) {
    const TemporaryFolder folder;
    const auto path = folder.write("head.glb", bytes);
    return errorText([&] { importMesh(path); });
}

// ---- meshoptimizer ------------------------------------------------------------------------------

struct View {
    std::string compressed;
    std::size_t stride = 0;  // bytes
    std::size_t count = 0;
    std::string mode = "ATTRIBUTES";
    std::string filter = "";
};

template <class Element>
View attributesView(std::span<const Element> elements) {
    std::string bytes(meshopt_encodeVertexBufferBound(elements.size(), sizeof(Element)), '\0');
    auto* const data = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(meshopt_encodeVertexBuffer(
        data, bytes.size(), elements.data(), elements.size(), sizeof(Element)));
    return {.compressed = bytes, .stride = sizeof(Element), .count = elements.size()};
}

View trianglesView(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
    auto* const data = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(meshopt_encodeIndexBuffer(data, bytes.size(), indices.data(), indices.size()));
    return {.compressed = bytes, .stride = 4, .count = indices.size(), .mode = "TRIANGLES"};
}

View indicesView(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    std::string bytes(meshopt_encodeIndexSequenceBound(indices.size(), vertices), '\0');
    auto* const data = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(meshopt_encodeIndexSequence(data, bytes.size(), indices.data(), indices.size()));
    return {.compressed = bytes, .stride = 4, .count = indices.size(), .mode = "INDICES"};
}

struct Compressed {
    std::vector<View> views;
    std::string accessors;  // a JSON object for each view, without bufferView
    std::string primitive = R"("attributes":{"POSITION":0,"NORMAL":1},"indices":2)";
    std::string extension = "EXT_meshopt_compression";
    std::string used;  // more extensions: ,"..."
};

// As gltfpack -c writes: one buffer with the compressed data, one that stands for the others.
std::string glb(const Compressed& file) {
    std::string data, views;
    std::size_t size = 0;
    for (const View& view : file.views) {
        if (!views.empty()) views += ',';
        views += R"({"buffer":1,"byteOffset":)" + number(size) + R"(,"byteLength":)" +
                 number(view.count * view.stride);
        if (view.mode == "ATTRIBUTES") views += R"(,"byteStride":)" + number(view.stride);
        views += R"(,"extensions":{")" + file.extension + R"(":{"buffer":0,"byteOffset":)" +
                 number(data.size()) + R"(,"byteLength":)" + number(view.compressed.size()) +
                 R"(,"byteStride":)" + number(view.stride) + R"(,"mode":")" + view.mode + '"' +
                 (view.filter.empty() ? "" : R"(,"filter":")" + view.filter + '"') +
                 R"(,"count":)" + number(view.count) + "}}}";
        data += view.compressed;
        data.resize((data.size() + 3) / 4 * 4, '\0');
        size += view.count * view.stride;
    }
    const std::string names = '"' + file.extension + '"' + file.used;
    return glb(
        R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        R"("extensionsUsed":[)" +
            names + R"(],"extensionsRequired":[)" + names + R"(],"meshes":[{"primitives":[{)" +
            file.primitive + R"(}]}],"accessors":[)" + file.accessors + R"(],"bufferViews":[)" +
            views + R"(],"buffers":[{"byteLength":)" + number(data.size()) + R"(},{"byteLength":)" +
            number(size) + R"(,"extensions":{")" + file.extension + R"(":{"fallback":true}}}]})",
        data);
}

// `view` is the number of the accessor's buffer view.
std::string accessor(std::size_t view, const std::string& type, std::size_t count) {
    return R"({"bufferView":)" + number(view) + R"(,"count":)" + number(count) + ',' + type + '}';
}

constexpr const char* kVectors = R"("componentType":5126,"type":"VEC3")";
constexpr const char* kIndices = R"("componentType":5125,"type":"SCALAR")";

Compressed meshoptHead(const Head& head) {
    const std::size_t vertices = head.mesh.positions.size();
    return {
        .views =
            {attributesView(std::span(head.mesh.positions)),
             attributesView(std::span(head.mesh.normals)), trianglesView(head.indices, vertices)},
        .accessors = accessor(0, kVectors, vertices) + ',' + accessor(1, kVectors, vertices) + ',' +
                     accessor(2, kIndices, head.indices.size())};
}

// The codec of triangles may turn a triangle, but keeps their order.
bool isTurned(std::array<std::uint32_t, 3> triangle, const std::array<std::uint32_t, 3>& from) {
    for (int turn = 0; turn < 3; ++turn) {
        if (triangle == from) return true;
        std::ranges::rotate(triangle, triangle.begin() + 1);
    }
    return false;
}

TEST(GltfCompression, MeshoptimizersHeadsAreExact) {
    const Head head;
    for (const char* const extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        Compressed file = meshoptHead(head);
        file.extension = extension;
        const Mesh mesh = import(glb(file));
        EXPECT_EQ(mesh.positions, head.mesh.positions);
        ASSERT_EQ(mesh.triangles.size(), head.mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            ASSERT_TRUE(isTurned(mesh.triangles[i], head.mesh.triangles[i])) << i;
        ASSERT_EQ(mesh.normals.size(), head.mesh.normals.size());
        for (std::size_t i = 0; i < mesh.normals.size(); ++i)  // made unit length again
            ASSERT_LT(glm::distance(mesh.normals[i], head.mesh.normals[i]), 1e-6f) << i;
    }
}

// Positions of 16 bits (KHR_mesh_quantization), normals through the octahedral filter of 8 bits.
// Rounding moves a point of the octahedron by up to sqrt(6) / 254, which its face's distance from
// the centre, 1 / sqrt(3), makes sqrt(18) / 254 on the sphere; decoding rounds by sqrt(3) / 254.
TEST(GltfCompression, MeshoptimizersFiltersAreUndone) {
    const Head head;
    const std::size_t vertices = head.mesh.positions.size();
    std::vector<std::array<std::uint16_t, 4>> positions;
    std::vector<glm::vec4> normals;
    for (const glm::vec3& position : head.mesh.positions) {
        std::array<std::uint16_t, 4> row{};
        for (int axis = 0; axis < 3; ++axis)
            row[static_cast<std::size_t>(axis)] =
                static_cast<std::uint16_t>(std::lround(10'000.0f * (position[axis] + 1.0f)));
        positions.push_back(row);
    }
    for (const glm::vec3& normal : head.mesh.normals) normals.emplace_back(normal, 0.0f);
    std::vector<std::array<std::int8_t, 4>> octahedral(vertices);
    meshopt_encodeFilterOct(octahedral.data(), vertices, 4, 8, &normals[0].x);
    Compressed file = meshoptHead(head);
    file.views[0] = attributesView(std::span<const std::array<std::uint16_t, 4>>(positions));
    file.views[1] = attributesView(std::span<const std::array<std::int8_t, 4>>(octahedral));
    file.views[1].filter = "OCTAHEDRAL";
    file.accessors =
        accessor(0, R"("componentType":5123,"type":"VEC3")", vertices) + ',' +
        accessor(1, R"("componentType":5120,"normalized":true,"type":"VEC3")", vertices) + ',' +
        accessor(2, kIndices, head.indices.size());
    file.used = R"(,"KHR_mesh_quantization")";
    const Mesh mesh = import(glb(file));
    ASSERT_EQ(mesh.positions.size(), vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        for (int axis = 0; axis < 3; ++axis)  // a float's rounding of 20,000
            ASSERT_NEAR(
                mesh.positions[i][axis], 10'000.0f * (head.mesh.positions[i][axis] + 1.0f), 0.502f);
        ASSERT_LT(
            glm::distance(mesh.normals[i], head.mesh.normals[i]),
            (std::sqrt(18.0f) + std::sqrt(3.0f)) / 254.0f)
            << i;
    }
}

// The exponential filter keeps mantissas of 15 bits with their sign, and one exponent for a vector,
// which the encoder takes as 0 if a number is 0: steps are at most 2^-14.
TEST(GltfCompression, TheExponentialFilterIsUndone) {
    const Head head;
    const std::size_t vertices = head.mesh.positions.size();
    std::vector<glm::vec3> encoded(vertices);
    meshopt_encodeFilterExp(encoded.data(), vertices, 12, 15, &head.mesh.positions[0].x);
    Compressed file = meshoptHead(head);
    file.views[0] = attributesView(std::span<const glm::vec3>(encoded));
    file.views[0].filter = "EXPONENTIAL";
    const Mesh mesh = import(glb(file));
    ASSERT_EQ(mesh.positions.size(), vertices);
    for (std::size_t i = 0; i < vertices; ++i)
        ASSERT_LT(
            glm::distance(mesh.positions[i], head.mesh.positions[i]),
            0.5f * std::sqrt(3.0f) * std::exp2(-14.0f) + 1e-7f);
}

TEST(GltfCompression, StrandsAreReadToo) {
    const std::vector<glm::vec3> points{
        {0, 0, 0}, {0, 0.5f, 0}, {0, 1, 0.25f}, {1, 0, 0}, {1, 0.25f, 0}};
    const std::vector<std::uint32_t> lines{0, 1, 1, 2, 3, 4};
    const Compressed file{
        .views = {attributesView(std::span(points)), indicesView(lines, points.size())},
        .accessors =
            accessor(0, kVectors, points.size()) + ',' + accessor(1, kIndices, lines.size()),
        .primitive = R"("attributes":{"POSITION":0},"indices":1,"mode":1)"};
    const TemporaryFolder folder;
    const StrandSet strands = importStrands(folder.write("hair.glb", glb(file)));
    EXPECT_EQ(strands.points, points);
    EXPECT_THAT(strands.ends, testing::ElementsAre(3u, 5u));
}

TEST(GltfCompression, DataThatDontFitAreRefused) {
    const Head head;
    const auto error = [&](const std::function<void(Compressed&)>& change) {
        Compressed file = meshoptHead(head);
        change(file);
        return errorOf(glb(file));
    };
    EXPECT_THAT(
        error([](Compressed& file) { file.views[0].compressed.resize(100); }),
        HasSubstr("buffer view 0: meshoptimizer can't decode it: it is damaged"));
    EXPECT_THAT(
        error([](Compressed& file) { file.views[2].compressed[0] = '\x00'; }),
        HasSubstr("buffer view 2: meshoptimizer can't decode it"));
    EXPECT_THAT(
        error([](Compressed& file) { file.views[2].stride = 8; }),
        HasSubstr("elements of 8 bytes don't fit its mode of compression"));
    EXPECT_THAT(
        error([](Compressed& file) { file.views[1].filter = "QUATERNION"; }),
        HasSubstr("buffer view 1: 1153 elements of 12 bytes don't fit"));
    EXPECT_THAT(
        error([](Compressed& file) { file.views[1].filter = "COLOR"; }),
        HasSubstr("buffer view 1: the filter 'COLOR' is not supported"));
    EXPECT_THAT(
        error([](Compressed& file) { file.views[1].mode = "LINES"; }),
        HasSubstr("buffer view 1: the unknown mode of compression 'LINES'"));
    EXPECT_THAT(
        error([](Compressed& file) { file.views[0].count = 100'000'000; }),
        HasSubstr("the compressed parts expand to more than"));
    // Indices that name no vertex.
    EXPECT_THAT(
        error([&](Compressed& file) {
            std::vector<std::uint32_t> indices = head.indices;
            indices[7] = 5000;
            file.views[2] = trianglesView(indices, 5001);
        }),
        HasSubstr("names vertex 5000"));
}

// ---- Draco --------------------------------------------------------------------------------------

enum class Order { kept, changed };

struct DracoFile {
    std::string compressed;
    std::size_t vertices = 0;
    std::array<std::uint32_t, 3> ids{};  // of positions, normals and texture coordinates
};

glm::vec2 coordinateOf(const glm::vec3& position) { return {4.0f * position.x, 4.0f * position.z}; }

// Without bits, floats are kept as they are.
DracoFile dracoFile(const Head& head, Order order, int bits) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(head.mesh.triangles.size()));
    const int positions =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normals =
        builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int coordinates =
        builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    for (std::size_t i = 0; i < head.mesh.triangles.size(); ++i) {
        const draco::FaceIndex face(static_cast<std::uint32_t>(i));
        const auto& [a, b, c] = head.mesh.triangles[i];
        const auto set = [&](int attribute, auto&& value) {
            const auto one = value(a), two = value(b), three = value(c);
            builder.SetAttributeValuesForFace(attribute, face, &one, &two, &three);
        };
        set(positions, [&](std::uint32_t v) { return head.mesh.positions[v]; });
        set(normals, [&](std::uint32_t v) { return head.mesh.normals[v]; });
        set(coordinates, [&](std::uint32_t v) { return coordinateOf(head.mesh.positions[v]); });
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(
        order == Order::kept ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
    if (bits > 0) {
        for (const auto attribute :
             {draco::GeometryAttribute::POSITION, draco::GeometryAttribute::NORMAL,
              draco::GeometryAttribute::TEX_COORD})
            encoder.SetAttributeQuantization(attribute, bits);
    }
    draco::EncoderBuffer buffer;
    encoder.SetTrackEncodedProperties(true);
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    DracoFile file{
        .compressed = std::string(buffer.data(), buffer.size()),
        .vertices = encoder.num_encoded_points()};
    std::size_t next = 0;
    for (const int attribute : {positions, normals, coordinates})
        file.ids[next++] = mesh->attribute(attribute)->unique_id();
    return file;
}

struct DracoJson {
    std::size_t triangles = 0;
    std::string mode = "4";
    std::string more = "";  // members of accessors
    std::uint32_t offset = 0;  // added to ids
    std::size_t vertices_off = 0;
};

// As Blender writes: accessors without buffer views.
std::string glb(const DracoFile& file, const DracoJson& json) {
    const auto accessor = [&](const std::string& type, std::size_t count) {
        return R"({"count":)" + number(count) + ',' + type + json.more + '}';
    };
    const std::size_t vertices = file.vertices + json.vertices_off;
    const std::string names = R"(["KHR_draco_mesh_compression"])";
    return glb(
        R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        R"("extensionsUsed":)" +
            names + R"(,"extensionsRequired":)" + names + R"(,"meshes":[{"primitives":[{"mode":)" +
            json.mode +
            R"(,"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,)"
            R"("extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":)"
            R"({"POSITION":)" +
            number(file.ids[0] + json.offset) + R"(,"NORMAL":)" + number(file.ids[1]) +
            R"(,"TEXCOORD_0":)" + number(file.ids[2]) + R"(}}}}]}],"accessors":[)" +
            accessor(kVectors, vertices) + ',' + accessor(kVectors, vertices) + ',' +
            accessor(R"("componentType":5126,"type":"VEC2")", vertices) + ',' +
            accessor(R"("componentType":5123,"type":"SCALAR")", 3 * json.triangles) +
            R"(],"bufferViews":[{"buffer":0,"byteLength":)" + number(file.compressed.size()) +
            R"(}],"buffers":[{"byteLength":)" + number(file.compressed.size()) + "}]}",
        file.compressed);
}

// Whether each of the head's triangles is in the mesh, with corners, normals and texture
// coordinates within these distances.
void expectEqual(const Mesh& mesh, const Head& head, float distance, float turn) {
    ASSERT_EQ(mesh.triangles.size(), head.mesh.triangles.size());
    ASSERT_EQ(mesh.texture_coordinates.size(), mesh.positions.size());
    const auto centre = [](const Mesh& of, const std::array<std::uint32_t, 3>& t) {
        return (of.positions[t[0]] + of.positions[t[1]] + of.positions[t[2]]) / 3.0f;
    };
    for (const auto& triangle : head.mesh.triangles) {
        const glm::vec3 wanted = centre(head.mesh, triangle);
        const auto nearest = std::ranges::min(mesh.triangles, {}, [&](const auto& each) {
            return glm::distance(centre(mesh, each), wanted);
        });
        float best = std::numeric_limits<float>::max();
        for (std::size_t shift = 0; shift < 3; ++shift) {  // it faces the same way
            float worst = 0.0f;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = nearest[(corner + shift) % 3];
                const glm::vec3& position = head.mesh.positions[triangle[corner]];
                worst = std::max(worst, glm::distance(mesh.positions[vertex], position));
            }
            if (worst >= best) continue;
            best = worst;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = nearest[(corner + shift) % 3];
                const std::uint32_t from = triangle[corner];
                if (worst > distance) continue;
                ASSERT_LE(glm::distance(mesh.normals[vertex], head.mesh.normals[from]), turn);
                ASSERT_LE(
                    glm::distance(
                        mesh.texture_coordinates[vertex], coordinateOf(head.mesh.positions[from])),
                    4.0f * distance);
            }
        }
        ASSERT_LE(best, distance);
    }
}

TEST(GltfCompression, DracosHeadsAreExactWithoutQuantization) {
    const Head head;
    const DracoFile file = dracoFile(head, Order::kept, 0);
    expectEqual(import(glb(file, {.triangles = head.mesh.triangles.size()})), head, 0.0f, 1e-6f);
}

// 14 bits of the longest side, 0.2 m, are 12 um, and half of that on each of three axes.
// Octahedral normals of 14 bits turn by less than 2^-12.
TEST(GltfCompression, DracosHeadsAreWithinTheirQuantization) {
    const Head head;
    for (const Order order : {Order::kept, Order::changed}) {
        const DracoFile file = dracoFile(head, order, 14);
        if (order == Order::changed) {
            EXPECT_LT(file.compressed.size(), 32 * file.vertices / 3);
        }
        expectEqual(
            import(glb(file, {.triangles = head.mesh.triangles.size()})), head,
            0.5f * std::sqrt(3.0f) * 0.2f / 16'383.0f + 1e-8f, 1.0f / 4096.0f);
    }
}

TEST(GltfCompression, DracosDataThatDontFitAreRefused) {
    const Head head;
    const DracoFile file = dracoFile(head, Order::changed, 12);
    const std::size_t triangles = head.mesh.triangles.size();
    EXPECT_THAT(
        errorOf(glb(file, {.triangles = triangles + 1})),
        HasSubstr(
            "mesh 0, primitive 0: the compressed data have " + number(3 * triangles) +
            " corners of triangles, but the file says " + number(3 * triangles + 3)));
    EXPECT_THAT(
        errorOf(glb(file, {.triangles = triangles, .vertices_off = 1})), HasSubstr(" vertices, "));
    EXPECT_THAT(
        errorOf(glb(file, {.triangles = triangles, .offset = 77})),
        HasSubstr("have no attribute 77"));
    EXPECT_THAT(
        errorOf(glb(file, {.triangles = triangles, .mode = "5"})),
        HasSubstr("mesh 0, primitive 0: is compressed by Draco, but is no list of triangles"));
    DracoFile damaged = file;
    damaged.compressed.resize(damaged.compressed.size() / 2);
    EXPECT_THAT(
        errorOf(glb(damaged, {.triangles = triangles})),
        HasSubstr("mesh 0, primitive 0: Draco can't decode it"));
}

// Every byte of a compressed file may be wrong: it is read or refused, and nothing else happens.
TEST(GltfCompression, DamagedFilesEndInErrors) {
    Head head;
    head.mesh = makeCap({.rings = 3, .sectors = 5});
    head.indices.clear();
    for (const auto& triangle : head.mesh.triangles)
        head.indices.insert(head.indices.end(), triangle.begin(), triangle.end());
    const DracoFile draco = dracoFile(head, Order::changed, 10);
    const Compressed meshopt = meshoptHead(head);
    std::size_t refused = 0;
    const auto read = [&](const std::string& bytes) {
        if (errorText([&] { import(bytes); }) != "no error") ++refused;
    };
    for (std::size_t i = 0; i < draco.compressed.size(); i += 3) {
        DracoFile file = draco;
        file.compressed[i] = static_cast<char>(file.compressed[i] ^ 0x55);
        read(glb(file, {.triangles = head.mesh.triangles.size()}));
    }
    for (std::size_t view = 0; view < meshopt.views.size(); ++view) {
        for (std::size_t i = 0; i < meshopt.views[view].compressed.size(); i += 7) {
            Compressed file = meshopt;
            char& byte = file.views[view].compressed[i];
            byte = static_cast<char>(byte ^ 0x55);
            read(glb(file));
        }
    }
    EXPECT_GT(refused, 10u);
}

}  // namespace
}  // namespace hair::groom
