#include "benchmarks/viewer/files_panel.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <imgui.h>

#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"
#include "tests/viewer/headless_ui.h"

#ifndef _WIN32
#include <signal.h>
#endif

namespace benchmarks::viewer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;

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

std::vector<std::string> titles(const std::vector<SceneGroup>& groups) {
    std::vector<std::string> found;
    for (const SceneGroup& group : groups) found.push_back(group.title);
    return found;
}

// The groups are the folders of scenes/.
TEST(SceneGroups, AreTheShippedFoldersAndTheOpenOne) {
    const TemporaryFolder folder;
    const std::vector<SceneGroup> shipped = sceneGroups(HAIRBENCH_SCENES_DIR);
    EXPECT_THAT(titles(shipped), IsSupersetOf({"Scenes", "Portraits", "Extended", "Truth"}));
    EXPECT_EQ(shipped.front().title, "Scenes");
    std::size_t files = 0;
    for (const SceneGroup& group : shipped) files += group.files.size();
    EXPECT_GE(files, 40u);
    // A folder of the user's comes first, if it has scenes.
    EXPECT_EQ(titles(sceneGroups(folder.path())), titles(shipped));
    const std::filesystem::path mine = folder.write("mine/a.json", "{}");
    const std::vector<SceneGroup> all = sceneGroups(mine.parent_path());
    EXPECT_EQ(all.size(), shipped.size() + 1);
    EXPECT_EQ(all.front().title, "In mine");
    EXPECT_THAT(all.front().files, ElementsAre(mine));
}

#ifndef _WIN32
// Pictures by programs that stand for hairbench: shell scripts.
class ThumbnailTest : public GpuTest {
protected:
    std::filesystem::path program(const std::string& lines) const {
        const std::filesystem::path file = folder_.write("program", "#!/bin/sh\n" + lines);
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        return file;
    }

    // Looks at the scene in pictures of the window until it has another state.
    Thumbnails::Picture
    after(Thumbnails& thumbnails, Thumbnails::State state, Thumbnails::Draw draw) const {
        const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        for (;;) {
            const Thumbnails::Picture picture = thumbnails.of(scene_);
            thumbnails.work(draw);
            if (picture.state != state || std::chrono::steady_clock::now() > late) return picture;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }

    TemporaryFolder folder_;
    std::filesystem::path scene_ = folder_.write("a.json", "{}");
};

using State = Thumbnails::State;
using Draw = Thumbnails::Draw;

TEST_F(ThumbnailTest, SaysWhyThereIsNone) {
    Thumbnails thumbnails(device(), {.program = {program("echo no hair >&2; exit 1").string()}});
    EXPECT_EQ(after(thumbnails, State::waiting, Draw::wanted).state, State::drawing);
    const Thumbnails::Picture picture = after(thumbnails, State::drawing, Draw::wanted);
    EXPECT_EQ(picture.state, State::failed);
    EXPECT_EQ(picture.problem, "no hair");
    EXPECT_EQ(thumbnails.message(), "");
}

// While frames play, the process ends at once, and begins anew afterwards.
TEST_F(ThumbnailTest, GivesWayToFramesThatPlay) {
    Thumbnails thumbnails(
        device(),
        {.program = {program("echo $$ >> " + folder_.file("pids").string() + "; exec sleep 600")
                         .string()}});
    EXPECT_EQ(after(thumbnails, State::waiting, Draw::wanted).state, State::drawing);
    while (!std::filesystem::exists(folder_.file("pids"))) std::this_thread::yield();
    EXPECT_EQ(thumbnails.message(), "1 picture left");
    EXPECT_EQ(after(thumbnails, State::drawing, Draw::later).state, State::waiting);
    EXPECT_EQ(thumbnails.message(), "Pause to draw 1 picture");
    const pid_t ended = std::stoi(textOf(folder_.file("pids")));
    EXPECT_EQ(kill(ended, 0), -1);
    EXPECT_EQ(after(thumbnails, State::waiting, Draw::wanted).state, State::drawing);
}
#endif

// The dialog in a window of 1280 x 720 px with a keyboard, without drawing.
class Dialog : public testing::Test {
protected:
    Dialog() {
        folder_.write("hair/bob.json", "{}");
        folder_.write("hair/notes.txt", "");
        folder_.write("rest.json", "{}");
    }

    void picture() {
        ui_.show(
            [&] {
                if (const auto taken = dialog_.show()) chosen_ = taken;
            },
            1);
    }

    // Replaces the name in the dialog, and presses Enter.
    void enter(const std::string& name) {
        ImGuiIO& io = ImGui::GetIO();
        picture();
        picture();
        for (const bool down : {true, false}) {
            io.AddKeyEvent(ImGuiMod_Ctrl, down);
            io.AddKeyEvent(ImGuiKey_A, down);
            picture();
        }
        io.AddInputCharactersUTF8(name.c_str());
        for (int i = 0; i < 3; ++i) picture();
        for (const bool down : {true, false}) {
            io.AddKeyEvent(ImGuiKey_Enter, down);
            picture();
            picture();
        }
    }

    TemporaryFolder folder_;
    HeadlessUi ui_{1280, 720};
    FileDialog dialog_;
    std::optional<FileDialog::Chosen> chosen_;
};

TEST_F(Dialog, TakesANameInItsFolder) {
    dialog_.open(FileDialog::Use::open, folder_.path());
    enter("rest.json");
    ASSERT_TRUE(chosen_);
    EXPECT_EQ(chosen_->use, FileDialog::Use::open);
    EXPECT_EQ(chosen_->path, std::filesystem::canonical(folder_.file("rest.json")));
    picture();
    EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId));
}

TEST_F(Dialog, TakesAPathElsewhere) {
    dialog_.open(FileDialog::Use::open, folder_.file("hair"));
    enter(folder_.file("rest.json").string());
    ASSERT_TRUE(chosen_);
    EXPECT_EQ(chosen_->path, folder_.file("rest.json"));
}

TEST_F(Dialog, OpensNoMissingFile) {
    dialog_.open(FileDialog::Use::open, folder_.path());
    enter("gone.json");
    EXPECT_FALSE(chosen_);
    EXPECT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId));
}

// The name of a folder leads into it.
TEST_F(Dialog, EntersAFolder) {
    dialog_.open(FileDialog::Use::open, folder_.path());
    enter("hair");
    EXPECT_FALSE(chosen_);
    // The field has lost the keyboard; the box opens anew in the folder that a name leads to.
    dialog_.open(FileDialog::Use::open, folder_.file("hair"));
    enter("bob.json");
    ASSERT_TRUE(chosen_);
    EXPECT_EQ(chosen_->path, std::filesystem::canonical(folder_.file("hair/bob.json")));
}

// A scene gets its ending, and may replace another one.
TEST_F(Dialog, SavesUnderANewNameOrAnOldOne) {
    dialog_.open(FileDialog::Use::save, folder_.file("rest-0001.json"));
    enter("mine");
    ASSERT_TRUE(chosen_);
    EXPECT_EQ(chosen_->use, FileDialog::Use::save);
    EXPECT_EQ(chosen_->path, std::filesystem::canonical(folder_.path()) / "mine.json");
    chosen_.reset();
    dialog_.open(FileDialog::Use::save, folder_.file("rest-0001.json"));
    enter("rest.json");
    ASSERT_TRUE(chosen_);
    EXPECT_EQ(chosen_->path, std::filesystem::canonical(folder_.file("rest.json")));
}

}  // namespace
}  // namespace benchmarks::viewer
