#include "benchmarks/viewer/settings_panel.h"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "engine/ui.h"
#include "tests/viewer/headless_ui.h"

namespace benchmarks::viewer {
namespace {

class SettingsPanel : public testing::Test {
protected:
    void show(int pictures = 3) {
        edit_ = {};
        ui_.show(
            [&] {
                ImGui::SetNextWindowPos({0, 0});
                ImGui::SetNextWindowSize({270, 4000});  // narrowest column at this scale
                ImGui::Begin("Scene", nullptr, ImGuiWindowFlags_NoDecoration);
                edit_ |= settingsPanel(settings_, original_, search_);
                ImGui::End();
            },
            pictures);
    }

    // Returns the widget with this end of its label.
    const engine::UiItem* find(const std::string& end) const {
        const auto& items = items_.items();
        const auto found = std::ranges::find_if(
            items, [&](const engine::UiItem& item) { return item.label.ends_with(end); });
        return found == items.end() ? nullptr : &*found;
    }

    void click(const std::string& end) {
        const engine::UiItem* const item = find(end);
        ASSERT_NE(item, nullptr) << end;
        ImGuiIO& io = ImGui::GetIO();
        io.AddMousePosEvent(
            (item->rect.left + item->rect.right) / 2, (item->rect.top + item->rect.bottom) / 2);
        show(2);
        io.AddMouseButtonEvent(0, true);
        show(2);
        io.AddMouseButtonEvent(0, false);
        show(2);
    }

    HeadlessUi ui_{1280, 4000};
    engine::UiItems items_;
    hair::Settings settings_;
    hair::Settings original_;
    std::string search_;
    Edit edit_;
};

TEST_F(SettingsPanel, ChangesNothingByItself) {
    show();
    EXPECT_FALSE(edit_.changed);
    EXPECT_FALSE(edit_.continues);
    EXPECT_NE(find("##/seed"), nullptr);
}

TEST_F(SettingsPanel, FindsFieldsByNameByPointerAndByHelp) {
    for (const char* const search :
         {"field of view", "FIELD_OF_VIEW", "/camera/field", "vertical field"}) {
        search_ = search;
        show();
        EXPECT_NE(find("##/camera/field_of_view"), nullptr) << search;
        EXPECT_EQ(find("##/camera/near_plane"), nullptr) << search;
        EXPECT_EQ(find("##/seed"), nullptr) << search;
    }
    search_ = "nothing is called so";
    show();
    EXPECT_EQ(find("##/camera/field_of_view"), nullptr);
}

TEST_F(SettingsPanel, ShowsAGroupThatIsCalledSoWhole) {
    search_ = "camera";
    show();
    EXPECT_NE(find("##/camera/near_plane"), nullptr);
    EXPECT_NE(find("##/camera/position/2"), nullptr);
}

TEST_F(SettingsPanel, SwitchesABox) {
    search_ = "/render/overlays/guides";
    show();
    click("##/render/overlays/guides");
    EXPECT_TRUE(settings_.render.overlays.guides);
    click("##/render/overlays/guides");
    EXPECT_FALSE(settings_.render.overlays.guides);
}

TEST_F(SettingsPanel, SetsAChangedFieldBack) {
    search_ = "/camera/field_of_view";
    show();
    EXPECT_EQ(find("##/camera/field_of_view/reset"), nullptr);
    settings_.camera.field_of_view = 33.0f;
    show();
    click("##/camera/field_of_view/reset");
    EXPECT_EQ(settings_.camera.field_of_view, original_.camera.field_of_view);
    EXPECT_EQ(find("##/camera/field_of_view/reset"), nullptr);
}

TEST_F(SettingsPanel, AddsToAListInAListAndRemoves) {
    settings_.simulation.pulls.resize(1);
    search_ = "pulls";
    show();
    click("Add##/simulation/pulls/0/path");
    ASSERT_EQ(settings_.simulation.pulls.at(0).path.size(), 1u);
    EXPECT_NE(find("##/simulation/pulls/0/path/0/position/0"), nullptr);
    click("Remove##/simulation/pulls/0");
    EXPECT_TRUE(settings_.simulation.pulls.empty());
}

TEST_F(SettingsPanel, ShowsAHugeListByPages) {
    settings_.simulation.colliders.resize(60000);
    original_ = settings_;
    search_ = "colliders";
    show();
    EXPECT_NE(find("##/simulation/colliders/0/radius"), nullptr);
    EXPECT_EQ(find("##/simulation/colliders/59999/radius"), nullptr);
    EXPECT_LT(items_.items().size(), 500u);
    click("##later");
    EXPECT_EQ(find("##/simulation/colliders/0/radius"), nullptr);
    EXPECT_NE(find("##/simulation/colliders/10/radius"), nullptr);
}

TEST_F(SettingsPanel, KeepsNamesAndWidgetsWithinTheNarrowestColumn) {
    settings_.camera.field_of_view = 33.0f;
    settings_.render.background.x = 0.9f;
    for (const char* const group :
         {"camera", "render", "simulation", "strands", "shading", "run"}) {
        search_ = std::string("/") + group;
        show();
        for (const engine::UiItem& item : items_.items()) {
            if (item.is_window || !item.window.starts_with("Scene")) continue;
            EXPECT_GE(item.rect.left, 0.0f) << item.label;
            EXPECT_LE(item.rect.right, 270.0f) << item.label;
        }
    }
}

// Parameters of docs/extending.md.
TEST_F(SettingsPanel, ShowsAFilesParameters) {
    for (hair::Settings* settings : {&settings_, &original_}) {
        settings->shading.model = hair::ShadingModel::extension;
        settings->shading.model_file = "mine.glsl";
        hair::ExtensionParameters& parameters = settings->shading.model_parameters;
        parameters.file = std::make_shared<const hair::Extension>(hair::parseExtension(
            hair::ExtensionKind::shading, "mine.glsl",
            "// @parameter bands 3 [1, 12] count: steps\n"
            "// @parameter tint (0.5, 0.25, 1) [0, 1] 1: of the shade\n"));
        parameters.values = {
            {"bands", false, glm::vec3(3.0f)}, {"tint", true, {0.5f, 0.25f, 1.0f}}};
    }
    search_ = "bands";
    show();
    EXPECT_NE(find("##/shading/model_parameters/bands"), nullptr);
    EXPECT_NE(find("##/shading/model_parameters/tint/2"), nullptr);
    EXPECT_EQ(find("##/shading/model_parameters/bands/reset"), nullptr);

    settings_.shading.model_parameters.values[0].value.x = 5.0f;
    show();
    click("##/shading/model_parameters/bands/reset");
    EXPECT_EQ(settings_.shading.model_parameters.values[0].value.x, 3.0f);
}

}  // namespace
}  // namespace benchmarks::viewer
