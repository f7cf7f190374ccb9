#include "benchmarks/viewer/actions.h"

#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <imgui.h>

namespace benchmarks::viewer {
namespace {

// Keys that fly the camera: benchmarks/viewer/view_tools.cpp.
constexpr int kFlying[] = {ImGuiKey_W,         ImGuiKey_A,          ImGuiKey_S,
                           ImGuiKey_D,         ImGuiKey_Q,          ImGuiKey_E,
                           ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow,
                           ImGuiKey_DownArrow, ImGuiKey_PageUp,     ImGuiKey_PageDown};

TEST(Actions, AreEachInTheTableOnce) {
    std::multiset<Action> actions;
    for (const ActionRow& row : actionTable()) actions.insert(row.action);
    for (int i = 0; i <= static_cast<int>(kLastAction); ++i)
        EXPECT_EQ(actions.count(static_cast<Action>(i)), 1u) << i;
    EXPECT_EQ(actions.size(), static_cast<std::size_t>(kLastAction) + 1);
}

TEST(Actions, ShareNoKey) {
    std::map<int, const char*> keys;
    for (const int key : kFlying) keys[key] = "flying";
    for (const ActionRow& row : actionTable()) {
        if (row.key == 0) continue;
        const auto [other, is_new] = keys.emplace(row.key, row.name);
        EXPECT_TRUE(is_new) << row.keys << ": " << row.name << " and " << other->second;
    }
}

TEST(Actions, ShowTheKeysThatTheyHave) {
    for (const ActionRow& row : actionTable()) {
        const std::string keys = row.keys;
        EXPECT_EQ(row.key != 0, !keys.empty()) << row.name;
        EXPECT_EQ((row.key & ImGuiMod_Ctrl) != 0, keys.find("Ctrl+") != keys.npos) << row.name;
        EXPECT_EQ((row.key & ImGuiMod_Shift) != 0, keys.find("Shift+") != keys.npos) << row.name;
        EXPECT_EQ((row.key & ImGuiMod_Alt) != 0, keys.find("Alt+") != keys.npos) << row.name;
    }
}

TEST(Actions, ExplainThemselves) {
    for (const ActionRow& row : actionTable()) {
        EXPECT_NE(std::string(row.menu), "");
        EXPECT_NE(std::string(row.name), "");
        EXPECT_GT(std::string(row.help).size(), std::string(row.name).size() / 2) << row.name;
    }
}

TEST(Actions, AreInMenusOfTheirOwnNames) {
    std::set<std::string> menus;
    std::size_t rows = 0;
    for (const auto& menu : actionMenus()) {
        EXPECT_TRUE(menus.insert(menu.front().menu).second) << menu.front().menu << " is twice";
        std::set<std::string> names;
        for (const ActionRow& row : menu) {
            EXPECT_STREQ(row.menu, menu.front().menu);
            EXPECT_TRUE(names.insert(row.name).second) << row.name;
        }
        rows += menu.size();
    }
    EXPECT_EQ(rows, actionTable().size());
}

TEST(SettingActions, SwitchOneSettingEach) {
    hair::Settings settings;
    std::set<const bool*> switched;
    for (const ActionRow& row : actionTable())
        if (std::string(row.menu) == "Show") switched.insert(switchOf(row.action, settings));
    EXPECT_EQ(switched.count(nullptr), 0u);
    EXPECT_EQ(
        switched,
        (std::set<const bool*>{
            &settings.render.overlays.guides, &settings.render.overlays.root_triangles,
            &settings.render.overlays.bodies, &settings.render.head, &settings.render.hair}));
    EXPECT_EQ(switchOf(Action::play, settings), nullptr);
}

// Every value of /render/show has one entry, in the menu View.
TEST(SettingActions, ShowTheStrandsInOneWayEach) {
    std::map<hair::Show, std::string> shown;
    for (const ActionRow& row : actionTable()) {
        const auto show = showOf(row.action);
        if (!show) continue;
        EXPECT_STREQ(row.menu, "View");
        EXPECT_TRUE(shown.emplace(*show, row.name).second) << row.name;
    }
    EXPECT_EQ(shown.size(), 9u);
    EXPECT_EQ(shown[hair::Show::groups], "Strands: groups");
}

TEST(SettingActions, LookFromAPresetOfTheirOwn) {
    std::set<const CameraPreset*> presets;
    for (const Action action :
         {Action::view_front, Action::view_side, Action::view_back, Action::view_top,
          Action::view_close, Action::view_far}) {
        EXPECT_NE(presetOf(action), nullptr) << rowOf(action).name;
        presets.insert(presetOf(action));
    }
    EXPECT_EQ(presets.size(), 6u);
    EXPECT_EQ(presetOf(Action::frame_groom), nullptr);
    EXPECT_EQ(presetOf(Action::tool_camera), nullptr);
}

// Presses keys in Dear ImGui without a window.
class Keys : public testing::Test {
protected:
    Keys() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {100, 100};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        frame([] {});
    }
    ~Keys() override { ImGui::DestroyContext(); }

    template <class Body>
    std::vector<Action> frame(Body&& body) {
        ImGui::NewFrame();
        body();
        const std::vector<Action> actions = pressedActions();
        ImGui::EndFrame();
        return actions;
    }

    // Dear ImGui may process a modifier and its key in separate frames.
    std::vector<Action> press(std::initializer_list<ImGuiKey> keys) {
        for (const ImGuiKey key : keys) ImGui::GetIO().AddKeyEvent(key, true);
        std::vector<Action> actions;
        for (int i = 0; i < 4; ++i)
            for (const Action action : frame([] {})) actions.push_back(action);
        for (const ImGuiKey key : keys) ImGui::GetIO().AddKeyEvent(key, false);
        for (int i = 0; i < 4; ++i) frame([] {});
        return actions;
    }
};

TEST_F(Keys, DoWhatTheTableSays) {
    EXPECT_EQ(press({ImGuiKey_Space}), std::vector{Action::play});
    EXPECT_EQ(press({ImGuiKey_1}), std::vector{Action::overlay_guides});
    EXPECT_EQ(press({ImGuiMod_Ctrl, ImGuiKey_1}), std::vector{Action::panel_scene});
    EXPECT_EQ(press({ImGuiMod_Alt, ImGuiKey_1}), std::vector{Action::view_front});
    EXPECT_EQ(press({ImGuiMod_Ctrl, ImGuiKey_S}), std::vector{Action::save_scene});
    EXPECT_EQ(
        press({ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiKey_S}), std::vector{Action::save_scene_as});
    EXPECT_EQ(press({ImGuiKey_F1}), std::vector{Action::help});
    EXPECT_EQ(press({ImGuiKey_J}), std::vector<Action>{});
}

TEST_F(Keys, ShowHelpForAQuestionMarkOnAnyKeyboard) {
    ImGui::GetIO().AddInputCharacter('?');
    EXPECT_EQ(frame([] {}), std::vector{Action::help});
}

TEST_F(Keys, DoNothingWhileTextIsTyped) {
    const auto typing = [] {
        static char text[16] = {};
        ImGui::Begin("window");
        ImGui::SetKeyboardFocusHere();
        ImGui::InputText("text", text, sizeof text);
        ImGui::End();
    };
    for (int i = 0; i < 4; ++i) frame(typing);
    ASSERT_TRUE(ImGui::GetIO().WantTextInput);
    ImGui::GetIO().AddKeyEvent(ImGuiKey_Space, true);
    ImGui::GetIO().AddInputCharacter('?');
    for (int i = 0; i < 3; ++i) EXPECT_EQ(frame(typing), std::vector<Action>{});
}

}  // namespace
}  // namespace benchmarks::viewer
