#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/viewer/script/script.h"
#include "tests/viewer/headless_ui.h"

// Each fault is planted. One layout has none.
namespace benchmarks::viewer {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

void panel(const char* name, float x, float width, ImGuiWindowFlags flags = 0) {
    ImGui::SetNextWindowPos({x, 0});
    ImGui::SetNextWindowSize({width, 300});
    ImGui::Begin(name, nullptr, flags);
}

// Two correct panels with every kind of widget.
void goodPanels() {
    static constexpr const char* kText = "A line that fits into the panel";
    bool on = true;
    float number = 0.5f;
    panel("Left", 0, 300);
    ImGui::TextUnformatted(kText);
    ImGui::TextWrapped("%s; %s; %s", kText, kText, kText);
    ImGui::Button("Save");
    ImGui::SameLine();
    ImGui::SmallButton("x");
    ImGui::Checkbox("guides", &on);
    ImGui::SetNextItemWidth(100);
    ImGui::DragFloat("strength", &number);
    ImGui::SetNextItemWidth(-1);
    ImGui::SliderFloat("##unnamed", &number, 0.0f, 1.0f);
    if (ImGui::TreeNodeEx("simulation", ImGuiTreeNodeFlags_SpanAvailWidth)) ImGui::TreePop();
    ImGui::Selectable("smoke.json");
    if (ImGui::BeginTabBar("tabs")) {
        if (ImGui::BeginTabItem("Timings")) ImGui::EndTabItem();
        ImGui::EndTabBar();
    }
    ImGui::End();
    panel("Right", 300, 340);
    if (ImGui::BeginTable("passes", 2)) {
        ImGui::TableSetupColumn("pass");
        ImGui::TableSetupColumn("ms");
        ImGui::TableHeadersRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted("simulate");
        ImGui::TableNextColumn();
        ImGui::TextUnformatted("0.42");
        ImGui::EndTable();
    }
    ImGui::BeginChild("list", {0, 100});
    for (int i = 0; i < 50; ++i) ImGui::Text("row %d", i);  // scrolled, so cut at top and bottom
    ImGui::SetScrollY(33.0f);
    ImGui::EndChild();
    ImGui::End();
}

struct Faults {
    std::vector<std::string> clipped;
    std::vector<std::string> outside;
};

Faults faultsOf(const std::function<void()>& widgets) {
    HeadlessUi ui(640, 360);
    const engine::UiItems items;
    ui.show(widgets);
    return {clippedText(items), outsideItems(items)};
}

TEST(LayoutFaults, AreNoneWhereAllFits) {
    const Faults faults = faultsOf(goodPanels);
    EXPECT_THAT(faults.clipped, IsEmpty());
    EXPECT_THAT(faults.outside, IsEmpty());
}

TEST(LayoutFaults, HaveTextThatIsWiderThanItsPanel) {
    const Faults faults = faultsOf([] {
        panel("Panel", 0, 100);
        ImGui::TextUnformatted("A line that does not fit into the panel");
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, Contains(HasSubstr("Panel: its contents are")));
}

TEST(LayoutFaults, HaveLabelsThatAreWiderThanTheirWidgets) {
    const Faults faults = faultsOf([] {
        panel("Panel", 0, 300);
        ImGui::Button("Save the scene", {50, 0});
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, Contains(HasSubstr("Panel: \"Save the scene\" needs")));
}

TEST(LayoutFaults, HaveLabelsBesideWidgetsThatLeaveTheirPanel) {
    const Faults faults = faultsOf([] {
        float number = 0.0f;
        panel("Panel", 0, 200);
        ImGui::SetNextItemWidth(150);
        ImGui::DragFloat("strength of wind", &number);
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, Contains(HasSubstr("its contents are")));
}

// A clip rectangle through the middle of a letter, unknown to any widget.
TEST(LayoutFaults, HaveLettersThatTheDeviceCutsOff) {
    const Faults faults = faultsOf([] {
        panel("Panel", 0, 300);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float middle = at.x + 1.5f * ImGui::CalcTextSize("M").x;
        ImGui::PushClipRect(at, {middle, at.y + 100}, true);
        ImGui::GetWindowDrawList()->AddText(at, IM_COL32_WHITE, "MMM");
        ImGui::PopClipRect();
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, Contains(HasSubstr("the letter 'M'")));
}

TEST(LayoutFaults, HaveLettersThatDearImGuiCutsOff) {
    const Faults faults = faultsOf([] {
        panel("Panel", 0, 300);
        ImGui::SetNextItemWidth(63);  // in the middle of a letter of 7 px
        ImGui::BeginCombo("##model", "dual_scattering", ImGuiComboFlags_NoArrowButton);
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, Contains(HasSubstr("is cut off")));
}

TEST(LayoutFaults, AreNoneForTextThatAFieldScrolls) {
    const Faults faults = faultsOf([] {
        static char text[] = "a description that is longer than its field";
        panel("Panel", 0, 300);
        ImGui::SetNextItemWidth(100);
        ImGui::InputText("##description", text, sizeof text);
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, IsEmpty());
}

TEST(LayoutFaults, HaveNumbersThatAreWiderThanTheirFields) {
    const Faults faults = faultsOf([] {
        float number = 123456.75f;
        panel("Panel", 0, 300);
        ImGui::SetNextItemWidth(40);
        ImGui::DragFloat("##wide", &number, 1.0f, 0.0f, 0.0f, "%.5f");
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, Contains("Panel: the text of \"##wide\" is cut off"));
}

TEST(LayoutFaults, HaveColumnsOfTablesThatAreTooNarrow) {
    const Faults faults = faultsOf([] {
        panel("Panel", 0, 300);
        if (ImGui::BeginTable("passes", 2)) {
            ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthFixed, 30);
            ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthStretch);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted("a long name of a pass");
            ImGui::TableNextColumn();
            ImGui::EndTable();
        }
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, Contains(HasSubstr("column 0 of a table")));
}

TEST(LayoutFaults, HaveContentsBelowAPanelThatDoesNotScroll) {
    const auto widgets = [](ImGuiWindowFlags flags) {
        return [=] {
            panel("Panel", 0, 300, flags);
            for (int i = 0; i < 30; ++i) ImGui::Button(("row " + std::to_string(i)).c_str());
            ImGui::End();
        };
    };
    const Faults fixed = faultsOf(widgets(ImGuiWindowFlags_NoScrollbar));
    EXPECT_THAT(fixed.clipped, Contains(HasSubstr("too high")));
    const Faults scrolls = faultsOf(widgets(0));
    EXPECT_THAT(scrolls.clipped, IsEmpty());
    EXPECT_THAT(scrolls.outside, IsEmpty());
}

TEST(LayoutFaults, HavePanelsOutsideOfTheWindow) {
    const Faults faults = faultsOf([] {
        panel("Panel", 500, 200);
        ImGui::End();
    });
    EXPECT_THAT(faults.outside, Contains("Panel leaves the window"));
}

TEST(LayoutFaults, HavePanelsThatLieOnOneAnother) {
    const Faults faults = faultsOf([] {
        panel("A", 0, 200);
        ImGui::End();
        panel("B", 190, 200);
        ImGui::End();
    });
    EXPECT_THAT(faults.outside, Contains("A and B overlap"));
}

TEST(LayoutFaults, HaveWidgetsBesideTheirPanel) {
    const Faults faults = faultsOf([] {
        panel("Panel", 0, 200);
        ImGui::SetCursorPosX(180);
        ImGui::Button("##unseen", {100, 0});
        ImGui::End();
    });
    EXPECT_THAT(faults.outside, Contains(HasSubstr("##unseen")));
}

TEST(LayoutFaults, AreNoneForAPopupOnAPanel) {
    const Faults faults = faultsOf([] {
        panel("Panel", 0, 300);
        ImGui::OpenPopup("menu");
        if (ImGui::BeginPopup("menu")) {
            ImGui::MenuItem("Save scene", "Ctrl+S");
            ImGui::EndPopup();
        }
        ImGui::End();
    });
    EXPECT_THAT(faults.clipped, IsEmpty());
    EXPECT_THAT(faults.outside, IsEmpty());
}

}  // namespace
}  // namespace benchmarks::viewer
