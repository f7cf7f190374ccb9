// Tests reading meshes of Alembic archives, made byte by byte
// (tests/groom/formats/alembic_files.h).
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/mesh/import_alembic.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/groom/formats/alembic_files.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A square in the plane y = 0 and a triangle beside it. Corners are clockwise seen from +y, as
// Alembic has them for a face that is seen from there: x to z turns from +y to the left.
std::vector<MadeProperty> squareAndTriangle() {
    return {
        madeFloats("P", 3, {0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 2, 0, 0}),
        madeIntegers(".faceCounts", {4, 3}), madeIntegers(".faceIndices", {0, 1, 2, 3, 1, 4, 2})};
}

MadeObject madeMesh(
    std::vector<MadeProperty> geometry, std::vector<MadeObject> children = {},
    const std::string& schema = "AbcGeom_PolyMesh_v1") {
    return {
        .name = "head",
        .metadata = "schema=" + schema,
        .properties = {madeCompound(".geom", std::move(geometry))},
        .children = std::move(children)};
}

MadeObject madeFaceSet(const std::string& name, std::vector<std::int32_t> faces) {
    return {
        .name = name,
        .metadata = "schema=AbcGeom_FaceSet_v1",
        .properties = {madeCompound(".faceset", {madeIntegers(".faces", std::move(faces))})}};
}

Mesh meshOf(const std::vector<MadeObject>& objects) {
    const TemporaryFolder folder;
    return importMesh(folder.write("head.abc", madeArchive(objects)));
}

std::string meshError(const std::vector<MadeObject>& objects) {
    const std::string bytes = madeArchive(objects);
    return errorText([&] { readAlembicMesh(std::as_bytes(std::span(bytes))); });
}

// The sum of the triangles' area vectors.
glm::vec3 areaOf(const Mesh& mesh) {
    glm::vec3 sum(0);
    for (const auto& [a, b, c] : mesh.triangles)
        sum += 0.5f *
               glm::cross(
                   mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    return sum;
}

TEST(ImportAlembicMesh, TurnsFacesOutward) {
    for (const char* schema : {"AbcGeom_PolyMesh_v1", "AbcGeom_SubD_v1"}) {
        const Mesh mesh = meshOf({madeMesh(squareAndTriangle(), {}, schema)});
        EXPECT_EQ(mesh.positions.size(), 5u);
        EXPECT_EQ(mesh.triangles.size(), 3u);
        // A square of area 1 and a triangle of area 1/2.
        EXPECT_EQ(areaOf(mesh), glm::vec3(0, 1.5f, 0));
        for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 1, 0));
        EXPECT_THAT(mesh.parts, ElementsAre("head"));
        EXPECT_TRUE(mesh.texture_coordinates.empty());
    }
}

// Scaled by 2, -2, 2 and moved by 5: a mirrored mesh still faces outward, which is -y now.
TEST(ImportAlembicMesh, IsPlacedByTheTransformsAboveIt) {
    const Mesh mesh = meshOf({madeTransform(
        "move", std::string("\x10\x00", 2), {0, 5, 0, 2, -2, 2}, {madeMesh(squareAndTriangle())})});
    EXPECT_EQ(mesh.positions[2], glm::vec3(2, 5, 2));
    EXPECT_EQ(areaOf(mesh), glm::vec3(0, -6, 0));
}

TEST(ImportAlembicMesh, HasFaceSetsAsMaterials) {
    const Mesh mesh = meshOf(
        {madeMesh(squareAndTriangle(), {madeFaceSet("scalp", {1}), madeFaceSet("skin", {0})})});
    ASSERT_EQ(mesh.materials.size(), 3u);
    EXPECT_EQ(mesh.materials[1].name, "scalp");
    EXPECT_THAT(mesh.triangle_materials, ElementsAre(2, 2, 1));
    EXPECT_THAT(
        meshError({madeMesh(squareAndTriangle(), {madeFaceSet("scalp", {2})})}),
        HasSubstr("/head/scalp/.faceset/.faces: face 2 is named, but there are 2"));
}

// The two faces share vertices 1 and 2. The second face has another coordinate at vertex 2.
TEST(ImportAlembicMesh, SplitsVerticesWhereTextureCoordinatesDiffer) {
    std::vector<MadeProperty> geometry = squareAndTriangle();
    geometry.push_back(madeFloats("uv", 2, {0, 0, 1, 0, 1, 1, 0, 1, 1, 0, 0.5f, 0, 0.5f, 1}));
    const Mesh mesh = meshOf({madeMesh(geometry)});
    ASSERT_EQ(mesh.positions.size(), 6u);
    EXPECT_EQ(mesh.positions[5], mesh.positions[2]);
    EXPECT_EQ(mesh.texture_coordinates[2], glm::vec2(1, 0));  // v is down
    EXPECT_EQ(mesh.texture_coordinates[5], glm::vec2(0.5f, 0));
    EXPECT_EQ(mesh.normals[5], glm::vec3(0, 1, 0));
    std::vector<MadeProperty> of_vertices = squareAndTriangle();
    of_vertices.push_back(madeFloats("uv", 2, {0, 0, 1, 0, 1, 1, 0, 1, 0.25f, 0.25f}));
    EXPECT_EQ(meshOf({madeMesh(of_vertices)}).texture_coordinates[4], glm::vec2(0.25f, 0.75f));
}

// Alembic's ObjectVisibility is a scalar int8 beside the schema's properties: 0 hidden, 1 visible,
// -1 as the object above.
TEST(ImportAlembicMesh, LeavesOutHiddenMeshes) {
    const auto with = [](MadeObject object, std::string name, std::int8_t visibility) {
        object.name = std::move(name);
        object.properties.push_back(
            {.name = "visible",
             .kind = 1,
             .type = 2,
             .samples = {std::string(1, static_cast<char>(visibility))}});
        return object;
    };
    const MadeObject square = madeMesh(squareAndTriangle());
    const MadeObject above = madeTransform(
        "move", "\x10", {0, 5, 0},
        {square, with(square, "shown", 1), with(square, "as_above", -1)});
    const Mesh mesh = meshOf({with(above, "hides", 0), with(square, "own", -1)});
    EXPECT_THAT(mesh.parts, ElementsAre("shown", "own"));
    EXPECT_EQ(mesh.triangles.size(), 6u);
    EXPECT_EQ(mesh.positions[0], glm::vec3(0, 5, 0));
    EXPECT_THAT(mesh.warnings, ElementsAre("2 hidden meshes are left out"));
    EXPECT_THAT(meshOf({square}).warnings, ElementsAre());
    EXPECT_THAT(
        meshError({with(square, "a", 0)}),
        HasSubstr("the archive has only hidden meshes: show them, then export"));
}

TEST(ImportAlembicMesh, RefusesCountsAndIndicesThatDoNotFit) {
    const auto error = [&](std::size_t which, MadeProperty property) {
        std::vector<MadeProperty> geometry = squareAndTriangle();
        geometry[which] = std::move(property);
        return meshError({madeMesh(geometry)});
    };
    EXPECT_THAT(
        error(1, madeIntegers(".faceCounts", {4, 4})),
        HasSubstr("/head/.geom/.faceCounts: the faces have 8 corners, but there are 7 indices"));
    EXPECT_THAT(error(1, madeIntegers(".faceCounts", {8, -1})), HasSubstr("a face of -1 corners"));
    EXPECT_THAT(
        error(2, madeIntegers(".faceIndices", {0, 1, 2, 3, 1, 5, 2})),
        HasSubstr("a corner names vertex 5, but there are 5"));
    EXPECT_THAT(
        error(2, madeIntegers(".faceIndices", {0, 1, 2, 3, 1, -1, 2})),
        HasSubstr("a corner names vertex -1"));
    EXPECT_THAT(
        error(0, madeFloats("P", 3, {0, NAN, 0})),
        HasSubstr("/head/.geom/P: value 0 is not finite"));
    std::vector<MadeProperty> geometry = squareAndTriangle();
    geometry.push_back(madeFloats("uv", 2, {0, 0}));
    EXPECT_THAT(
        meshError({madeMesh(geometry)}),
        HasSubstr("1 values, expected one for each of 7 corners or 5 vertices"));
    EXPECT_THAT(
        meshError({madeCurves("a", {})}), HasSubstr("the archive has no mesh, only curves"));
    EXPECT_THAT(meshError({}), HasSubstr("the archive has no mesh"));
}

}  // namespace
}  // namespace hair::groom
