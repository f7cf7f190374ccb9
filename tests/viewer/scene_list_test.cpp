#include "benchmarks/viewer/open_scene.h"

#include <gmock/gmock.h>
#include <imgui.h>

#include "tests/temporary_folder.h"

namespace benchmarks::viewer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ListedScenes, AreTheJsonFilesOfTheFolderButSchemas) {
    const TemporaryFolder folder;
    for (const char* name : {"b.json", "a.json", "scene.schema.json", "a.png", "c/d.json"})
        folder.write(name, "{}");
    EXPECT_THAT(
        sceneFilesIn(folder.path()), ElementsAre(folder.file("a.json"), folder.file("b.json")));
    EXPECT_THAT(sceneFilesIn(folder.file("nowhere")), IsEmpty());
}

TEST(ListedScenes, SayWhatTheyAreOrWhyNot) {
    const TemporaryFolder folder;
    const ListedScene good = listedScene(folder.write("a.json", R"({"description": "Hair."})"));
    EXPECT_EQ(good.name, "a");
    EXPECT_EQ(good.description, "Hair.");
    EXPECT_EQ(good.problem, "");
    EXPECT_THAT(listedScene(folder.write("b.json", "{")).problem, HasSubstr("syntax error"));
    EXPECT_THAT(
        listedScene(folder.write("c.json", R"({"suite": ["a.json"]})")).problem,
        HasSubstr("a suite of scenes"));
    EXPECT_THAT(listedScene(folder.file("gone.json")).problem, HasSubstr("no such file"));
}

// A list in a panel 280 px wide, with a mouse and a keyboard but without drawing.
class SceneListPanel : public testing::Test {
protected:
    void SetUp() override {
        context_ = ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui::GetIO().DisplaySize = {1280, 720};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        folder_.write("curly.json", "{}");
        folder_.write("rest.json", "{}");
        folder_.write("suite.json", R"({"suite": ["rest.json"]})");
    }

    void TearDown() override { ImGui::DestroyContext(context_); }

    std::optional<std::filesystem::path> frame(SceneList& list) {
        ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({280, 400});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration);
        auto chosen = list.show(folder_.file("rest.json"));
        content_ = ImGui::GetWindowWidth() - ImGui::GetStyle().WindowPadding.x;
        last_right_ = ImGui::GetItemRectMax().x;
        ImGui::End();
        ImGui::EndFrame();
        return chosen;
    }

    std::optional<std::filesystem::path> click(SceneList& list, float x, float y) {
        ImGui::GetIO().AddMousePosEvent(x, y);
        frame(list);
        ImGui::GetIO().AddMouseButtonEvent(0, true);
        frame(list);
        ImGui::GetIO().AddMouseButtonEvent(0, false);
        return frame(list);
    }

    // Returns the y coordinate of a row's middle.
    float row(int index) const {
        const ImGuiStyle& style = ImGui::GetStyle();
        return style.WindowPadding.y + 2.0f * ImGui::GetFrameHeightWithSpacing() +
               (static_cast<float>(index) + 0.5f) * ImGui::GetTextLineHeightWithSpacing();
    }

    void type(SceneList& list, const std::string& text, float y) {
        click(list, 20.0f, y);
        ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
        frame(list);
    }

    TemporaryFolder folder_;
    float content_ = 0.0f;
    float last_right_ = 0.0f;

private:
    ImGuiContext* context_ = nullptr;
};

TEST_F(SceneListPanel, GivesTheSceneThatIsClicked) {
    SceneList list(folder_.path());
    EXPECT_EQ(frame(list), std::nullopt);
    EXPECT_EQ(click(list, 40, row(0)), folder_.file("curly.json"));
    EXPECT_EQ(click(list, 40, row(1)), folder_.file("rest.json"));
}

TEST_F(SceneListPanel, DoesNotGiveASuite) {
    SceneList list(folder_.path());
    frame(list);
    EXPECT_EQ(click(list, 40, row(2)), std::nullopt);
}

TEST_F(SceneListPanel, FiltersByName) {
    SceneList list(folder_.path());
    frame(list);
    const float filter =
        ImGui::GetStyle().WindowPadding.y + 1.5f * ImGui::GetFrameHeightWithSpacing();
    type(list, "RES", filter);
    EXPECT_EQ(click(list, 40, row(0)), folder_.file("rest.json"));
}

TEST_F(SceneListPanel, TakesAPathWithEnter) {
    SceneList list(folder_.path());
    frame(list);
    type(list, "/some/other.json", row(0) - 2.0f * ImGui::GetFrameHeightWithSpacing());
    ImGui::GetIO().AddKeyEvent(ImGuiKey_Enter, true);
    EXPECT_EQ(frame(list), "/some/other.json");
    ImGui::GetIO().AddKeyEvent(ImGuiKey_Enter, false);
    EXPECT_EQ(frame(list), std::nullopt);
}

TEST_F(SceneListPanel, StaysWithinItsPanel) {
    SceneList list(folder_.path());
    frame(list);
    EXPECT_LE(last_right_, content_);
}

}  // namespace
}  // namespace benchmarks::viewer
