#include "hair/groom/build_groom.h"

#include <gmock/gmock.h>

#include "hair/groom/export_hgl.h"
#include "hair/groom/grow.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"
#include "tests/groom/test_meshes.h"

namespace hair {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(BuildGroom, ReadsTheFileBesideTheScene) {
    const TemporaryFolder folder;
    const Groom grown = grow(makeCap(), {}, 20, 1);
    exportHgl(grown, folder.file("guides.HGL"));
    GroomSettings settings;
    settings.file = "guides.HGL";
    const Groom groom = buildGroom(settings, nullptr, folder.file(""), 1);
    EXPECT_EQ(groom.points, grown.points);
    EXPECT_EQ(groom.root_triangles, grown.root_triangles);
}

TEST(BuildGroom, GrowsWhereNoFileIsNamed) {
    const Mesh cap = makeCap();
    GroomSettings settings;
    settings.guides = 30;
    settings.grow.vertices = 5;
    const Groom groom = buildGroom(settings, &cap, "scenes", 7);
    EXPECT_EQ(groom.points, grow(cap, settings.grow, 30, 7).points);
}

TEST(BuildGroom, NamesThePath) {
    GroomSettings settings;
    EXPECT_THAT(
        errorText([&] { buildGroom(settings, nullptr, "scenes", 1); }),
        StartsWith("scenes/assets/head.glb: "));
    Mesh bald = makeCap();
    bald.materials.pop_back();
    bald.triangle_materials.assign(bald.triangle_materials.size(), 0);
    EXPECT_THAT(
        errorText([&] { buildGroom(settings, &bald, "scenes", 1); }),
        StartsWith("scenes/assets/head.glb: the mesh has no material named 'scalp'"));
    settings.file = "gone.hgl";
    EXPECT_EQ(
        errorText([&] { buildGroom(settings, nullptr, "scenes", 1); }),
        "scenes/gone.hgl: no such file");
}

TEST(BuildGroom, ListsTheFormatsItKnows) {
    GroomSettings settings;
    settings.file = "guides.abc";
    EXPECT_EQ(
        errorText([&] { buildGroom(settings, nullptr, "scenes", 1); }),
        "scenes/guides.abc: unknown guide format '.abc'; known are .hgl");
    for (const GroomImporter& importer : groomImporters()) {
        EXPECT_THAT(
            errorText([&] { buildGroom(settings, nullptr, "scenes", 1); }),
            HasSubstr(std::string(importer.extension)));
    }
}

}  // namespace
}  // namespace hair
