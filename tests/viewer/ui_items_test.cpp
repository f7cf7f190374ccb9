#include <algorithm>

#include <gtest/gtest.h>

#include <imgui.h>
#include <imgui_internal.h>

#include "benchmarks/viewer/script/script.h"
#include "engine/ui.h"
#include "tests/error_text.h"
#include "tests/viewer/headless_ui.h"

namespace benchmarks::viewer {
namespace {

// Returns the rectangle of Dear ImGui's last widget.
engine::UiRect lastRect() {
    const ImVec2 first = ImGui::GetItemRectMin(), last = ImGui::GetItemRectMax();
    return {first.x, first.y, last.x, last.y};
}

void expectSame(const engine::UiRect& a, const engine::UiRect& b) {
    EXPECT_EQ(a.left, b.left);
    EXPECT_EQ(a.top, b.top);
    EXPECT_EQ(a.right, b.right);
    EXPECT_EQ(a.bottom, b.bottom);
}

TEST(UiItems, KnowWhereWidgetsAre) {
    HeadlessUi ui(640, 360);
    const engine::UiItems items;
    engine::UiRect button, child_button;
    ui.show([&] {
        ImGui::Begin("Panel");
        ImGui::Button("Save");
        button = lastRect();
        ImGui::BeginChild("list", {200, 100});
        ImGui::Button("Save");
        child_button = lastRect();
        ImGui::EndChild();
        ImGui::End();
    });
    EXPECT_EQ(
        errorText([&] { itemNamed(items, {"Save", ""}); }),
        "there are several: item 'Save', in Panel and in Panel/list");
    expectSame(itemNamed(items, {"Save", "Panel/list"}).rect, child_button);
    const auto first = std::ranges::find(items.items(), "Save", &engine::UiItem::label);
    ASSERT_NE(first, items.items().end());
    expectSame(first->rect, button);
}

TEST(UiItems, KnowTheirState) {
    HeadlessUi ui(640, 360);
    const engine::UiItems items;
    ui.show([] {
        ImGui::Begin("Panel");
        bool yes = true, no = false;
        ImGui::Checkbox("on", &yes);
        ImGui::Checkbox("off", &no);
        ImGui::BeginDisabled();
        ImGui::Button("gray");
        ImGui::EndDisabled();
        ImGui::SetNextItemOpen(true);
        if (ImGui::TreeNode("open")) ImGui::TreePop();
        ImGui::TreeNode("closed");
        if (ImGui::BeginTabBar("tabs")) {
            if (ImGui::BeginTabItem("front")) ImGui::EndTabItem();
            ImGui::EndTabBar();
        }
        ImGui::End();
    });
    EXPECT_TRUE(itemNamed(items, {"on", ""}).checked);
    EXPECT_FALSE(itemNamed(items, {"off", ""}).checked);
    EXPECT_FALSE(itemNamed(items, {"gray", ""}).enabled);
    EXPECT_TRUE(itemNamed(items, {"on", ""}).enabled);
    EXPECT_TRUE(itemNamed(items, {"open", ""}).open);
    EXPECT_FALSE(itemNamed(items, {"closed", ""}).open);
    EXPECT_GT(itemNamed(items, {"front", ""}).rect.width(), 0.0f);
}

TEST(UiItems, AreThoseOfTheLastPictureAlone) {
    HeadlessUi ui(640, 360);
    const engine::UiItems items;
    ui.show([] {
        ImGui::Begin("Panel");
        ImGui::Button("before");
        ImGui::End();
    });
    ui.show([] {
        ImGui::Begin("Panel");
        ImGui::Button("after");
        ImGui::End();
    });
    EXPECT_FALSE(findItem(items, {"before", ""}));
    EXPECT_TRUE(findItem(items, {"after", ""}));
    EXPECT_EQ(
        errorText([&] { itemNamed(items, {"aftre", "Panel"}); }),
        "no item 'aftre' in Panel is visible (did you mean 'after'?); known: after");
    EXPECT_EQ(
        errorText([&] { itemNamed(items, {"", "Pane"}); }),
        "no window 'Pane' is visible (did you mean 'Panel'?); known: Panel");
}

TEST(UiItems, CostNothingOnceNobodyAsks) {
    HeadlessUi ui(640, 360);
    const auto widgets = [] {
        ImGui::Begin("Panel");
        ImGui::Button("Save");
        ImGui::End();
    };
    {
        const engine::UiItems items;
        ui.show(widgets);
        EXPECT_TRUE(findItem(items, {"Save", ""}));
    }
    EXPECT_FALSE(ImGui::GetCurrentContext()->TestEngineHookItems);
    ui.show(widgets);  // does not call the destroyed object
}

TEST(UserInput, PressesWhatIsUnderTheMouseAndLeavesOtherEventsOut) {
    HeadlessUi ui(640, 360);
    const engine::UiItems items;
    UserInput input;
    int pressed = 0;
    const auto widgets = [&] {
        // Stands for GLFW's events from the user's own mouse.
        ImGui::GetIO().AddMousePosEvent(639.0f, 359.0f);
        ImGui::GetIO().AddMouseButtonEvent(0, true);
        ImGui::Begin("Panel");
        if (ImGui::Button("Save")) ++pressed;
        ImGui::End();
    };
    ui.show(widgets);
    const engine::UiRect rect = itemNamed(items, {"Save", ""}).rect;
    input.move(rect.left + 2.0f, rect.top + 2.0f);
    ui.show(widgets, 1);
    EXPECT_EQ(pressed, 0);
    input.button(0, UserInput::Change::press);
    ui.show(widgets, 1);
    input.button(0, UserInput::Change::release);
    ui.show(widgets, 1);
    EXPECT_EQ(pressed, 1);
    ui.show(widgets, 3);
    EXPECT_EQ(pressed, 1);
    EXPECT_EQ(ImGui::GetIO().MousePos.x, rect.left + 2.0f);
}

}  // namespace
}  // namespace benchmarks::viewer
