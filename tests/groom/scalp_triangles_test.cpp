#include "hair/groom/growth/scalp.h"

#include <gmock/gmock.h>

#include "tests/error_text.h"
#include "tests/groom/test_meshes.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

// Three squares in a row, two triangles each, of materials skin, scalp, scalp, in parts named head,
// head, wig; the vertices on the last square's outer edge have half of the full weight in "fringe".
Mesh row() {
    Mesh mesh = makeGrid(3, 1, [](auto, auto) { return false; });
    mesh.materials = {{.name = "skin"}, {.name = "scalp"}};
    mesh.triangle_materials = {0, 0, 1, 1, 1, 1};
    mesh.parts = {"head", "wig"};
    mesh.triangle_parts = {0, 0, 0, 0, 1, 1};
    mesh.vertex_groups = {
        {.name = "fringe", .weights = {0, 0, 1, 0.5f, 0, 0, 1, 0.5f}},
        {.name = "thin", .weights = {0, 0, 1, 0.49f, 0, 0, 1, 0.49f}}};
    return mesh;
}

TEST(ScalpTriangles, AreThoseOfAMaterial) {
    EXPECT_THAT(scalpTriangles(row(), "scalp"), ElementsAre(2, 3, 4, 5));
}

TEST(ScalpTriangles, AreThoseOfAPart) {
    EXPECT_THAT(scalpTriangles(row(), "wig"), ElementsAre(4, 5));
}

TEST(ScalpTriangles, AreThoseWhoseCornersHaveHalfOfAGroup) {
    EXPECT_THAT(scalpTriangles(row(), "fringe"), ElementsAre(4, 5));
    EXPECT_THAT(errorText([] { scalpTriangles(row(), "thin"); }), HasSubstr("no triangle belongs"));
}

TEST(ScalpTriangles, AreAllOfThemForAStar) { EXPECT_THAT(scalpTriangles(row(), "*"), SizeIs(6)); }

TEST(ScalpTriangles, PreferMaterialsToPartsToGroups) {
    Mesh mesh = row();
    mesh.parts[1] = "scalp";
    mesh.vertex_groups[0].name = "head";
    EXPECT_THAT(scalpTriangles(mesh, "scalp"), ElementsAre(2, 3, 4, 5));
    EXPECT_THAT(scalpTriangles(mesh, "head"), ElementsAre(0, 1, 2, 3));
    mesh.materials.push_back({.name = "wig"});  // used by no triangle
    mesh.parts[1] = "wig";
    EXPECT_THAT(scalpTriangles(mesh, "wig"), ElementsAre(4, 5));
}

TEST(ScalpTriangles, JoinWhatSharesAName) {
    Mesh mesh = row();
    mesh.materials[0].name = "scalp";
    EXPECT_THAT(scalpTriangles(mesh, "scalp"), SizeIs(6));
}

TEST(ScalpTriangles, ListWhatThereIs) {
    EXPECT_EQ(
        errorText([] { scalpTriangles(row(), "hat"); }),
        "nothing in the mesh is named 'hat'; materials: 'skin', 'scalp'; parts: 'head', 'wig'; "
        "vertex groups: 'fringe', 'thin'");
    EXPECT_EQ(
        errorText([] { scalpTriangles(Mesh{}, "hat"); }),
        "nothing in the mesh is named 'hat'; materials: none; parts: none; vertex groups: none");
    Mesh mesh = row();
    mesh.parts.resize(35, "more");
    EXPECT_THAT(errorText([&] { scalpTriangles(mesh, "hat"); }), HasSubstr("'more' and 5 more;"));
}

}  // namespace
}  // namespace hair::groom
