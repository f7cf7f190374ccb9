#include <ostream>

#include <gmock/gmock.h>

#include "benchmarks/viewer/settings_panel.h"

namespace benchmarks::viewer {

void PrintTo(const SettingDifference& difference, std::ostream* stream) {
    *stream << difference.pointer << ": " << difference.a << " | " << difference.b;
}

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(SettingsDifferences, AreNoneBetweenEqualSettings) {
    hair::Settings settings;
    settings.render.meshes.resize(2);
    EXPECT_THAT(settingsDifferences(settings, settings), IsEmpty());
}

TEST(SettingsDifferences, NameEachFieldAndBothValues) {
    hair::Settings a, b;
    a.strands.density = 8;
    b.strands.density = 64;
    b.camera.position = {1.0f, 2.5f, -0.1f};
    a.camera.position = {0.0f, 0.0f, 0.5f};
    b.render.tone_map = hair::ToneMap::agx;
    b.render.overlays.guides = true;
    b.description = "two \"words\"";
    EXPECT_THAT(
        settingsDifferences(a, b),
        ElementsAre(
            SettingDifference{"/description", R"("")", R"("two \"words\"")"},
            SettingDifference{"/strands/density", "8", "64"},
            SettingDifference{"/camera/position", "[0, 0, 0.5]", "[1, 2.5, -0.1]"},
            SettingDifference{"/render/tone_map", R"("none")", R"("agx")"},
            SettingDifference{"/render/overlays/guides", "false", "true"}));
}

TEST(SettingsDifferences, CompareListsMemberByMember) {
    hair::Settings a, b;
    a.render.meshes.resize(1);
    b.render.meshes.resize(2);
    b.render.meshes[0].scale = 2.0f;
    const auto differences = settingsDifferences(a, b);
    ASSERT_EQ(differences.size(), 2u);
    EXPECT_EQ(differences[0], (SettingDifference{"/render/meshes/0/scale", "1", "2"}));
    EXPECT_EQ(differences[1].pointer, "/render/meshes/1");
    EXPECT_EQ(differences[1].a, "");
    EXPECT_EQ(differences[1].b.front(), '{');
}

}  // namespace
}  // namespace benchmarks::viewer
