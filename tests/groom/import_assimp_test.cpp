#include <algorithm>
#include <map>
#include <span>
#include <sstream>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/mesh/mesh_stream.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A square roof: a quad of scalp at y = 1 and a triangle of skin, counter-clockwise seen from +y.
constexpr const char* kObj = R"(
v 0 1 0
v 0 1 1
v 1 1 1
v 1 1 0
v 2 1 0
usemtl scalp
f 1 2 3 4
usemtl skin
f 4 3 5
)";

double areaOf(const Mesh& mesh, const std::string& material) {
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.materials[mesh.triangle_materials[i]].name != material) continue;
        const auto& [a, b, c] = mesh.triangles[i];
        const glm::vec3 edge = mesh.positions[b] - mesh.positions[a];
        const glm::vec3 normal = glm::cross(edge, mesh.positions[c] - mesh.positions[a]);
        area += 0.5 * double{normal.y};  // of the side that faces up
    }
    return area;
}

TEST(ImportAssimp, ReadsAnObjWithoutItsMaterialFile) {
    const TemporaryFolder folder;
    const Mesh mesh = importMesh(folder.write("roof.obj", kObj));
    EXPECT_EQ(mesh.triangles.size(), 3u);  // the quad is triangulated
    EXPECT_EQ(mesh.triangle_materials.size(), 3u);
    EXPECT_DOUBLE_EQ(areaOf(mesh, "scalp"), 1.0);
    EXPECT_DOUBLE_EQ(areaOf(mesh, "skin"), 0.5);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const glm::vec3& normal : mesh.normals) {
        EXPECT_LT(glm::distance(normal, glm::vec3(0, 1, 0)), 1e-6f);
    }
    EXPECT_LE(mesh.positions.size(), 7u);  // 4 + 3: vertices are shared within a material
}

TEST(ImportAssimp, ReadsMaterialColours) {
    const TemporaryFolder folder;
    folder.write("roof.mtl", "newmtl scalp\nKd 0.25 0.5 0.75\nnewmtl skin\nKd 1 0 0\n");
    const Mesh mesh = importMesh(folder.write("roof.obj", std::string("mtllib roof.mtl\n") + kObj));
    for (const Material& material : mesh.materials) {
        if (material.name != "scalp" && material.name != "skin") continue;  // assimp's own default
        const glm::vec3 expected =
            material.name == "scalp" ? glm::vec3(0.25f, 0.5f, 0.75f) : glm::vec3(1.0f, 0.0f, 0.0f);
        EXPECT_EQ(material.base_color, expected);
    }
    EXPECT_DOUBLE_EQ(areaOf(mesh, "scalp"), 1.0);
}

TEST(ImportAssimp, ReadsPlyAndStlAndOff) {
    const TemporaryFolder folder;
    const auto ply = folder.write(
        "a.PLY", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                 "end_header\n0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n");
    const auto stl = folder.write(
        "a.stl", "solid a\nfacet normal 0 1 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\n"
                 "vertex 1 0 0\nendloop\nendfacet\nendsolid a\n");
    const auto off = folder.write("a.off", "OFF\n3 1 0\n0 0 0\n0 0 1\n1 0 0\n3 0 1 2\n");
    for (const auto& path : {ply, stl, off}) {
        const Mesh mesh = importMesh(path);
        ASSERT_EQ(mesh.triangles.size(), 1u) << path;
        const auto& [a, b, c] = mesh.triangles[0];
        const glm::vec3 edge = mesh.positions[b] - mesh.positions[a];
        EXPECT_EQ(glm::cross(edge, mesh.positions[c] - mesh.positions[a]), glm::vec3(0, 1, 0));
    }
}

TEST(ImportAssimp, TurnsTheUnitOfTheFileIntoMetres) {
    const TemporaryFolder folder;
    const Mesh mesh = importMesh(folder.write("a.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 0 0 50 100 0 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)"));
    glm::vec3 high(0.0f);
    for (const glm::vec3& position : mesh.positions) high = glm::max(high, position);
    EXPECT_LT(glm::distance(high, glm::vec3(1.0f, 0.0f, 0.5f)), 1e-6f);
}

// OBJ has v up, glTF and we have it down.
TEST(ImportAssimp, ReadsTextureCoordinates) {
    const TemporaryFolder folder;
    const Mesh mesh = importMesh(folder.write("a.obj", R"(
v 0 0 0
v 0 0 1
v 1 0 0
v 1 0 1
vt 0.25 1
vt 0.5 0.25
vt 1 0
o mapped
f 1/1 2/2 3/3
o plain
f 2 4 3
)"));
    ASSERT_EQ(mesh.texture_coordinates.size(), mesh.positions.size());
    std::map<std::pair<float, float>, glm::vec2> at;  // of x and z
    for (const std::uint32_t vertex : mesh.triangles[0]) {
        const glm::vec3& p = mesh.positions[vertex];
        at[{p.x, p.z}] = mesh.texture_coordinates[vertex];
    }
    EXPECT_EQ((at[{0.0f, 0.0f}]), glm::vec2(0.25f, 0.0f));
    EXPECT_EQ((at[{0.0f, 1.0f}]), glm::vec2(0.5f, 0.75f));
    EXPECT_EQ((at[{1.0f, 0.0f}]), glm::vec2(1.0f, 1.0f));
    for (const std::uint32_t vertex : mesh.triangles[1])
        EXPECT_EQ(mesh.texture_coordinates[vertex], glm::vec2(0.0f));
    const Mesh plain = importMesh(folder.write("roof.obj", kObj));
    EXPECT_TRUE(plain.texture_coordinates.empty());
}

// A seam: the same place, another texture coordinate.
TEST(ImportAssimp, KeepsVerticesApartThatDifferInTextureCoordinates) {
    const TemporaryFolder folder;
    const Mesh mesh = importMesh(folder.write(
        "a.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 1\nvt 0 0\nvt 0 1\nvt 1 0\nvt 1 1\n"
                 "f 1/1 2/2 3/3\nf 2/4 4/4 3/3\n"));
    EXPECT_EQ(mesh.positions.size(), 5u);
}

TEST(ImportAssimp, ReadsObjectsAndGroupsAsParts) {
    const TemporaryFolder folder;
    const Mesh mesh = importMesh(folder.write("a.obj", R"(
v 0 0 0
v 0 0 1
v 1 0 0
v 1 0 1
o bust
f 1 2 3
g scalp
f 2 4 3
f 1 2 4
)"));
    ASSERT_EQ(mesh.triangle_parts.size(), 3u);
    std::vector<std::string> names;
    for (const std::uint32_t part : mesh.triangle_parts) names.push_back(mesh.parts.at(part));
    EXPECT_THAT(names, testing::ElementsAre("bust", "scalp", "scalp"));
}

// Two nodes with one geometry. The second is moved and mirrored, so that its triangle has to be
// turned round to face the same way.
TEST(ImportAssimp, PlacesEveryNode) {
    const TemporaryFolder folder;
    const Mesh mesh = importMesh(folder.write("a.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 0 0 1 1 0 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node id="one" name="one"><instance_geometry url="#g"/></node>
<node id="two" name="two"><translate>5 0 0</translate><scale>-1 1 1</scale>
<instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)"));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_THAT(mesh.parts, testing::ElementsAre("one", "two"));
    glm::vec3 high(0.0f);
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::vec3 edge = mesh.positions[b] - mesh.positions[a];
        EXPECT_EQ(glm::cross(edge, mesh.positions[c] - mesh.positions[a]), glm::vec3(0, 1, 0));
    }
    for (const glm::vec3& position : mesh.positions) high = glm::max(high, position);
    EXPECT_EQ(high, glm::vec3(5.0f, 0.0f, 1.0f));
}

// A skin: the joint "crown" has the weights 1, 0.75 and 0 of the three vertices.
TEST(ImportAssimp, ReadsBonesAsVertexGroups) {
    const TemporaryFolder folder;
    const Mesh mesh = importMesh(folder.write("a.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 0 0 1 1 0 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_controllers><controller id="c"><skin source="#g">
<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
<source id="j"><Name_array id="ja" count="2">crown nape</Name_array><technique_common>
<accessor source="#ja" count="2" stride="1"><param name="JOINT" type="name"/></accessor>
</technique_common></source>
<source id="m"><float_array id="ma" count="32">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1
1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</float_array><technique_common>
<accessor source="#ma" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor>
</technique_common></source>
<source id="w"><float_array id="wa" count="3">1 0.75 0.25</float_array><technique_common>
<accessor source="#wa" count="3" stride="1"><param name="WEIGHT" type="float"/></accessor>
</technique_common></source>
<joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#m"/></joints>
<vertex_weights count="3"><input semantic="JOINT" source="#j" offset="0"/>
<input semantic="WEIGHT" source="#w" offset="1"/><vcount>1 2 1</vcount>
<v>0 0 0 1 1 2 1 0</v></vertex_weights>
</skin></controller></library_controllers>
<library_visual_scenes><visual_scene id="s">
<node id="crown" sid="crown" name="crown" type="JOINT"/>
<node id="nape" sid="nape" name="nape" type="JOINT"/>
<node id="n" name="n"><instance_controller url="#c"><skeleton>#crown</skeleton></instance_controller>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)"));
    ASSERT_EQ(mesh.positions.size(), 3u);
    ASSERT_EQ(mesh.vertex_groups.size(), 2u);
    EXPECT_EQ(mesh.vertex_groups[0].name, "crown");
    std::map<std::pair<float, float>, float> weights;  // of x and z
    for (std::size_t i = 0; i < 3; ++i)
        weights[{mesh.positions[i].x, mesh.positions[i].z}] = mesh.vertex_groups[0].weights.at(i);
    EXPECT_EQ((weights[{0.0f, 0.0f}]), 1.0f);
    EXPECT_EQ((weights[{0.0f, 1.0f}]), 0.75f);
    EXPECT_EQ((weights[{1.0f, 0.0f}]), 0.0f);
}

TEST(ImportAssimp, RefusesBrokenFiles) {
    const TemporaryFolder folder;
    const auto refusal = [&](const char* name, std::string_view content) {
        const auto path = folder.write(name, content);
        const std::string error = errorText([&] { importMesh(path); });
        EXPECT_THAT(error, AllOf(StartsWith(path.string() + ": "), testing::Not(HasSubstr("\n"))));
        return error;
    };
    EXPECT_NE(refusal("empty.obj", ""), "");
    EXPECT_NE(refusal("noise.obj", "hello\nworld\n"), "");
    EXPECT_NE(refusal("noise.fbx", "not an fbx file at all"), "");
    EXPECT_NE(refusal("noise.dae", "<xml"), "");
    EXPECT_NE(refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "");
    EXPECT_NE(refusal("lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "");
    EXPECT_NE(refusal("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "");
    EXPECT_THAT(
        refusal("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("not finite"));
    EXPECT_THAT(
        refusal("inf.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("not finite"));
}

TEST(ImportMesh, SaysWhatIsMissing) {
    const TemporaryFolder folder;
    for (const char* name : {"gone.glb", "gone.obj"}) {
        EXPECT_EQ(
            errorText([&] { importMesh(folder.file(name)); }),
            folder.file(name).string() + ": no such file");
    }
    std::filesystem::create_directory(folder.file("folder.obj"));
    EXPECT_THAT(errorText([&] { importMesh(folder.file("folder.obj")); }), HasSubstr("not a file"));
}

TEST(ImportMesh, ListsTheFormatsItKnows) {
    const TemporaryFolder folder;
    const std::string error = errorText([&] { importMesh(folder.write("head.xyz", "")); });
    EXPECT_THAT(error, HasSubstr("unknown mesh format '.xyz'; known: .glb, .gltf, .obj"));
    for (const MeshImporter& importer : meshImporters()) {
        for (const std::string_view extension : importer.extensions) {
            EXPECT_THAT(error, HasSubstr(std::string(extension)));
        }
    }
}

// ---- What assimp was not made for ---------------------------------------------------------------

std::string plyOf(const std::string& vertices, const std::string& faces, const std::string& rows) {
    return "ply\nformat ascii 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n" + rows;
}

// Each of these crashed or blocked the whole program, or took gigabytes, when assimp was a part of
// it. A corner that is no vertex makes it write past the heap, a face without corners makes it
// abort, and text among numbers makes it loop.
TEST(ImportAssimp, RefusesWhatItsReaderDiesOf) {
    const TemporaryFolder folder;
    const std::string three = "0 0 0\n0 0 1\n1 0 0\n";
    std::string numbers = "0 0 0 zero 0 50 100 0 0";
    const auto dae = [&](const std::string& values) {
        return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">)" +
               values + R"(</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 x</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
    };
    const std::pair<const char*, std::string> files[] = {
        {"past.ply", plyOf("3", "1", three + "3 0 1 2000000000\n")},
        {"beside.ply", plyOf("3", "1", three + "3 0 1 3\n")},
        {"negative.ply", plyOf("3", "1", three + "3 0 1 -1\n")},
        {"corners.ply", plyOf("3", "1", three + "0\n")},
        {"faces.ply", plyOf("3", "99999999", three + "3 0 1 2\n")},
        {"vertices.ply", plyOf("4294967295", "1", three + "3 0 1 2\n")},
        {"text.dae", dae(numbers)},
        {"loop.dae", dae(std::string(100000, 'x'))},
        {"deep.dae", "<?xml version=\"1.0\"?>" + std::string(200000, '<') + "a>"},
        {"empty.fbx", std::string("Kaydara FBX Binary  \0\x1a\0\xff\xff\xff\xff", 27)},
        {"short.stl", std::string(80, ' ') + std::string("\xff\xff\xff\x7f", 4)},
    };
    for (const auto& [name, content] : files) {
        const auto path = folder.write(name, content);
        const std::string text = errorText([&] { importMesh(path); });
        EXPECT_THAT(text, StartsWith(path.string() + ": "));
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        EXPECT_LT(text.size(), 400u) << text;
    }
}

// Assimp's time to triangulate a face grows with the square of its corners: 4e8 steps here.
TEST(ImportAssimp, RefusesFacesThatTakeTooLongToCut) {
    const TemporaryFolder folder;
    std::string text, face = "f";
    for (int i = 1; i <= 20000; ++i) {
        text += "v " + std::to_string(i) + ' ' + std::to_string(i % 7) + " 0\n";
        face += ' ' + std::to_string(i);
    }
    const auto path = folder.write("a.obj", text + face + '\n');
    EXPECT_EQ(
        errorText([&] { importMesh(path); }),
        path.string() + ": face 0 has 20000 corners: faces with so many would take minutes to cut "
                        "into triangles");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Nested nodes: 10^8 of them in 7 kB, which assimp creates before it returns.
TEST(ImportAssimp, GivesNodesOfNodesNoMoreMemoryThanAFileOfTheirSize) {
    const TemporaryFolder folder;
    std::string nodes = "<node id=\"n0\"/>";
    for (int i = 1; i <= 8; ++i) {
        nodes += "<node id=\"n" + std::to_string(i) + "\">";
        for (int k = 0; k < 10; ++k)
            nodes += "<instance_node url=\"#n" + std::to_string(i - 1) + "\"/>";
        nodes += "</node>";
    }
    const auto path = folder.write(
        "a.dae", "<?xml version=\"1.0\"?><COLLADA "
                 "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
                 "<library_nodes>" +
                     nodes +
                     "</library_nodes><library_visual_scenes><visual_scene id=\"s\"><node>"
                     "<instance_node url=\"#n8\"/></node></visual_scene></library_visual_scenes>"
                     "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
    EXPECT_EQ(
        errorText([&] { importMesh(path); }),
        path.string() + ": needs more memory than a file of its size may use");
}
#endif

// Files that a mesh names must be in its folders. A pipe must not make the reader wait for its
// writer.
TEST(ImportAssimp, OpensFilesOfItsFoldersAlone) {
    const TemporaryFolder folder;
    const std::string text = std::string("mtllib ") + "NAME" + "\n" + kObj;
    folder.write("private.mtl", "newmtl scalp\nKd 1 0 0\n");
    folder.write("in/own.mtl", "newmtl scalp\nKd 1 0 0\n");
    std::filesystem::create_symlink("../private.mtl", folder.file("in/link.mtl"));
    ASSERT_EQ(mkfifo(folder.file("in/pipe.mtl").c_str(), 0600), 0);
    const auto errorOf = [&](const std::string& name, const NamedFileCheck& check) {
        std::string mesh = text;
        mesh.replace(mesh.find("NAME"), 4, name);
        const auto path = folder.write("in/a.obj", mesh);
        return errorText([&] { importMesh(path, Textures::skipped, check); });
    };
    const NamedFileCheck check(
        [](const std::filesystem::path&) {}, {std::filesystem::canonical(folder.file("in"))});
    EXPECT_EQ(errorOf("own.mtl", check), "no error");
    const NamedFileCheck all([](const std::filesystem::path&) {});
    EXPECT_EQ(errorOf("../private.mtl", all), "no error");
    const Mesh mesh = importMesh(folder.file("in/a.obj"), Textures::skipped, all);
    EXPECT_TRUE(std::ranges::any_of(mesh.materials, [](const Material& each) {
        return each.base_color == glm::vec3(1, 0, 0);
    }));
    // Without a check, the mesh's own folder is the limit.
    for (const NamedFileCheck& limited : {check, NamedFileCheck()})
        for (const char* name : {"../private.mtl", "link.mtl"})
            EXPECT_THAT(errorOf(name, limited), HasSubstr("is outside")) << name;
    EXPECT_THAT(errorOf("pipe.mtl", {}), HasSubstr("pipe.mtl: is not a file"));
}

// If a face names the vertex after the last, assimp makes a triangle with the memory past the
// vertices.
TEST(ImportAssimp, RefusesCornersOfAPlyThatAreNoVertices) {
    const TemporaryFolder folder;
    const std::string vertices = "0 0 0\n0 0 1\n1 0 0\n1 0 1\n";
    const auto text = [&](const std::string& rows) {
        return folder.write("mesh.ply", plyOf("4", "2", vertices + "3 0 1 2\n" + rows + "\n"));
    };
    EXPECT_EQ(importMesh(text("3 1 3 2")).triangles.size(), 2u);
    for (const auto& [row, reason] :
         {std::pair{"3 1 4 2", "line 15: vertex 4 is named, but there are 4"},
          {"3 1 -1 2", "line 15: vertex -1 is named, but there are 4"},
          {"0", "line 15: a face has no corners"}}) {
        const auto path = text(row);
        EXPECT_EQ(errorText([&] { importMesh(path); }), path.string() + ": " + reason);
    }
    // The list under its other name, with a type that can't number vertices.
    const auto path_of_floats = folder.write(
        "floats.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar float vertex_index\n"
        "end_header\n0 0 0\n0 0 1\n1 0 0\n3 0 1 nan\n");
    EXPECT_EQ(
        errorText([&] { importMesh(path_of_floats); }),
        path_of_floats.string() + ": line 13: a face's corners are not integers");
    const auto bytes = [&](char corner) {
        std::string file =
            "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
            "property float y\nproperty float z\nelement face 1\n"
            "property list uchar int vertex_indices\nend_header\n";
        for (const float value : {0.f, 0.f, 0.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f, 1.f})
            file.append(reinterpret_cast<const char*>(&value), sizeof(value));
        file.append({3, 0, 0, 0, 0, 1, 0, 0, 0, corner, 0, 0, 0});
        return folder.write("bytes.ply", file);
    };
    EXPECT_EQ(importMesh(bytes(3)).triangles.size(), 1u);
    const auto path = bytes(4);
    EXPECT_THAT(
        errorText([&] { importMesh(path); }),
        testing::AllOf(
            StartsWith(path.string() + ": byte "),
            testing::EndsWith(": vertex 4 is named, but there are 4")));
}

// Texts and files that stand in a mesh's place, by the first bytes that their own documents state.
TEST(ImportMesh, NamesWhatItDoesNotRead) {
    const TemporaryFolder folder;
    const std::pair<std::string, const char*> kStandIns[] = {
        {"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 5\n",
         "is a pointer of Git LFS, which is not read: it stands for a large file: run 'git lfs "
         "pull'"},
        {"<!DOCTYPE html>\n<html lang=\"en\">", "is a page in HTML, which is not read"},
        {"BLENDER-v405", "is a Blender file, which is not read"}};
    for (const auto& [bytes, reason] : kStandIns)
        for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.ply", "a.stl", "a.fbx", "a.abc"}) {
            const auto path = folder.write(name, bytes);
            EXPECT_THAT(
                errorText([&] { importMesh(path); }),
                AllOf(StartsWith(path.string() + ": "), HasSubstr(reason)))
                << name;
        }
    // Meshes of FBX are read, so that a damaged one is not refused for its format.
    EXPECT_THAT(
        errorText([&] { importMesh(folder.write("a.fbx", "Kaydara FBX Binary  ")); }),
        Not(HasSubstr("which is not read")));
}

// A stream from a program that a file has taken over.
TEST(MeshStream, IsRefusedWhateverIsChanged) {
    ReadMesh read;
    read.mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    read.mesh.normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
    read.mesh.texture_coordinates = {{0, 0}, {0, 1}, {1, 0}};
    read.mesh.triangles = {{0, 1, 2}};
    read.mesh.triangle_materials = {0};
    read.mesh.triangle_parts = {0};
    read.mesh.parts = {"scalp"};
    read.mesh.vertex_groups = {{.name = "hair", .weights = {0, 0.5f, 1}}};
    read.mesh.materials = {{.name = "skin", .base_color = {0.25f, 0.5f, 1}}};
    read.mesh.is_placed = true;
    read.mesh.warnings = {"1 hidden mesh is left out"};
    read.textures = {"skin.png"};
    std::ostringstream out;
    writeMeshStream(out, read);
    const std::string whole = out.str();
    const auto parsed = [](const std::string& bytes) {
        return readMeshStream(std::as_bytes(std::span(bytes)));
    };
    const ReadMesh same = parsed(whole);
    EXPECT_EQ(same.mesh.positions, read.mesh.positions);
    EXPECT_EQ(same.mesh.triangles, read.mesh.triangles);
    EXPECT_EQ(same.mesh.parts, read.mesh.parts);
    EXPECT_EQ(same.mesh.vertex_groups[0].weights, read.mesh.vertex_groups[0].weights);
    EXPECT_EQ(same.mesh.materials[0].name, "skin");
    EXPECT_EQ(same.mesh.materials[0].base_color, read.mesh.materials[0].base_color);
    EXPECT_TRUE(same.mesh.is_placed);
    EXPECT_EQ(same.mesh.warnings, read.mesh.warnings);
    EXPECT_EQ(same.textures, read.textures);
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THAT(errorText([&] { parsed(whole.substr(0, size)); }), StartsWith("byte ")) << size;
    EXPECT_EQ(errorText([&] { parsed(whole + "x"); }).substr(0, 5), "byte ");
    // Any damaged byte gives an error, or a mesh whose arrays fit each other.
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0xff);
        errorText([&] {
            const ReadMesh changed = parsed(damaged);
            for (const auto& triangle : changed.mesh.triangles)
                for (const std::uint32_t vertex : triangle)
                    EXPECT_LT(vertex, changed.mesh.positions.size());
            EXPECT_EQ(changed.mesh.normals.size(), changed.mesh.positions.size());
        });
    }
}

}  // namespace
}  // namespace hair::groom
