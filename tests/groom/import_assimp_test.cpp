#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/import_mesh.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace hair {
namespace {

using testing::AllOf;
using testing::HasSubstr;
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
    EXPECT_THAT(error, HasSubstr("unknown mesh format '.xyz'; known are .glb, .gltf, .obj"));
    for (const MeshImporter& importer : meshImporters()) {
        for (const std::string_view extension : importer.extensions) {
            EXPECT_THAT(error, HasSubstr(std::string(extension)));
        }
    }
}

}  // namespace
}  // namespace hair
