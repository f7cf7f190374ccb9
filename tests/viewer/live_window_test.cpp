// Tests the window while a picture of the scene does not finish. A latch stops the drawing thread,
// and nothing here depends on timing. This shows a bound for the window's response time: the window
// waits for no step of that thread and no work of its device, so the response takes only a picture
// of the window itself (docs/viewer.md has figures).
#include "benchmarks/viewer/viewer.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <semaphore>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "benchmarks/commands/commands.h"
#include "benchmarks/viewer/actions.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/scene_file.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"
#include "tests/viewer/virtual_display.h"

namespace benchmarks::viewer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Far longer than a busy machine needs; anything longer hangs.
constexpr std::chrono::seconds kWindowHangs{120};

// Stops the drawing thread between an order and its work.
class Gate {
public:
    void pass() {
        if (!closed_) return;
        waits_.release();
        opens_.acquire();
        if (error_) throw engine::DeviceLost("planted");
    }
    void close() { closed_ = true; }
    // Whether a thread has reached the gate since the last call.
    bool isReached() { return waits_.try_acquire(); }
    void open() {
        closed_ = false;
        opens_.release();
    }
    void openToAnError() {
        error_ = true;
        open();
    }

private:
    std::atomic<bool> closed_ = false;
    std::atomic<bool> error_ = false;
    std::counting_semaphore<> waits_{0};
    std::counting_semaphore<> opens_{0};
};

class LiveWindow : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (isOver()) return;
        GTEST_FLAG_SET(death_test_style, "threadsafe");
        // The process of a death test inherits its parent's display.
        if (!testing::internal::InDeathTestChild()) display_.emplace();
        if (display_ && !display_->variables())
            return skipWithout(Need::display, "there is neither Xvfb nor a display");
        if (display_ && !display_->name().empty()) {
            setenv("DISPLAY", display_->name().c_str(), 1);
            unsetenv("WAYLAND_DISPLAY");
        }
        options_.scene.scene = folder_.write("small.json", R"({
            "base": ")" HAIRBENCH_SCENES_DIR R"(/thesis.json",
            "simulation": {"settle_steps": 0},
            "strands": {"density": 4, "tessellation": 2},
            "render": {"width": 160, "height": 90},
            "sweep": {"/groom/guides": null, "/strands/density": null,
                      "/strands/tessellation": null, "/render/msaa": null, "/lod/level": null}})");
        options_.scene.device.validation = engine::Validation::on;
        options_.preferences = folder_.file("viewer.json");
        options_.width = 640;
        options_.height = 360;
        options_.frames = 1000000;
        options_.live = true;
        options_.before_drawing = [this] { gate_.pass(); };
    }

    // Draws pictures of the window until a condition holds.
    template <class Holds>
    static void drawUntil(Viewer& viewer, Holds&& holds) {
        const auto late = std::chrono::steady_clock::now() + kWindowHangs;
        while (!holds()) {
            ASSERT_LT(std::chrono::steady_clock::now(), late);
            ASSERT_TRUE(viewer.frame());
        }
    }
    static void waitForTheScene(Viewer& viewer) {
        viewer.play().playing = false;
        drawUntil(viewer, [&] { return viewer.side(0).shown().isThere(); });
    }
    static void edit(Viewer& viewer, std::uint32_t density) {
        hair::Settings settings = viewer.side(0).wanted();
        settings.strands.density = density;
        viewer.edit(0, settings);
    }

    Gate gate_;
    ViewOptions options_;
    TemporaryFolder folder_;

private:
    std::optional<VirtualDisplay> display_;
};

TEST_F(LiveWindow, AnswersWhileAPictureIsDrawn) {
    Viewer viewer(options_);
    ASSERT_NO_FATAL_FAILURE(waitForTheScene(viewer));
    gate_.close();
    edit(viewer, 5);
    ASSERT_NO_FATAL_FAILURE(drawUntil(viewer, [&] { return gate_.isReached(); }));
    // From here on, the drawing thread is stopped.
    const auto before = viewer.picture().pixels;
    viewer.perform(Action::light_theme);
    viewer.perform(Action::panel_files);
    viewer.resize(700, 400);
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(viewer.frame());
    const auto light = viewer.picture().pixels;
    EXPECT_NE(light, before);
    viewer.perform(Action::dark_theme);
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(viewer.frame());
    EXPECT_NE(viewer.picture().pixels, light);
    EXPECT_EQ(viewer.side(0).shown().settings.strands.density, 4u);
    EXPECT_EQ(viewer.side(0).wanted().strands.density, 5u);
    gate_.open();
    drawUntil(viewer, [&] { return viewer.side(0).shown().settings.strands.density == 5u; });
    EXPECT_THAT(viewer.takeMessages(), IsEmpty());
}

// If settings change while a picture is drawn, only the last ones are drawn next: no intermediate
// ones, and no mixture.
TEST_F(LiveWindow, LosesNoChangeThatIsMadeMeanwhile) {
    Viewer viewer(options_);
    ASSERT_NO_FATAL_FAILURE(waitForTheScene(viewer));
    std::vector<std::uint32_t> shown{viewer.side(0).shown().settings.strands.density};
    const auto look = [&] {
        const hair::Settings& now = viewer.side(0).shown().settings;
        // Two settings of one edit, which must appear together.
        if (now.strands.density > 4u) {
            EXPECT_EQ(now.camera.field_of_view, static_cast<float>(now.strands.density));
        }
        if (now.strands.density != shown.back()) shown.push_back(now.strands.density);
    };
    const auto editBoth = [&](std::uint32_t value) {
        hair::Settings settings = viewer.side(0).wanted();
        settings.strands.density = value;
        settings.camera.field_of_view = static_cast<float>(value);
        viewer.edit(0, settings);
    };
    gate_.close();
    editBoth(5);
    ASSERT_NO_FATAL_FAILURE(drawUntil(viewer, [&] { return gate_.isReached(); }));
    for (std::uint32_t value = 6; value <= 40; ++value) {
        editBoth(value);
        ASSERT_TRUE(viewer.frame());
        look();
    }
    gate_.open();
    drawUntil(viewer, [&] {
        look();
        return shown.back() == 40u;
    });
    EXPECT_THAT(shown, ElementsAre(4u, 5u, 40u));
    // Each is one undo step.
    viewer.perform(Action::undo);
    EXPECT_EQ(viewer.side(0).wanted().strands.density, 39u);
    EXPECT_THAT(viewer.takeMessages(), IsEmpty());
}

TEST_F(LiveWindow, TakesStepsThatWereAskedForMeanwhile) {
    Viewer viewer(options_);
    ASSERT_NO_FATAL_FAILURE(waitForTheScene(viewer));
    gate_.close();
    edit(viewer, 5);
    ASSERT_NO_FATAL_FAILURE(drawUntil(viewer, [&] { return gate_.isReached(); }));
    viewer.perform(Action::step);
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(viewer.frame());
    EXPECT_EQ(viewer.side(0).shown().frame, 0u);
    gate_.open();
    drawUntil(viewer, [&] { return viewer.side(0).shown().frame == 1u; });
    EXPECT_EQ(viewer.side(0).shown().settings.strands.density, 5u);
}

TEST_F(LiveWindow, WritesAScreenshotOfWhatWasAskedForMeanwhile) {
    Viewer viewer(options_);
    ASSERT_NO_FATAL_FAILURE(waitForTheScene(viewer));
    gate_.close();
    edit(viewer, 5);
    ASSERT_NO_FATAL_FAILURE(drawUntil(viewer, [&] { return gate_.isReached(); }));
    edit(viewer, 9);
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder_.path());
    viewer.perform(Action::screenshot);
    ASSERT_TRUE(viewer.frame());
    EXPECT_FALSE(std::filesystem::exists(folder_.file("hairbench-small-0001.png")));
    gate_.open();
    drawUntil(viewer, [&] { return viewer.message().starts_with("wrote "); });
    std::filesystem::current_path(before);
    EXPECT_EQ(openScene(folder_.file("hairbench-small-0001.png")).settings.strands.density, 9u);
}

TEST_F(LiveWindow, OpensWhileTheSceneIsMade) {
    gate_.close();
    Viewer viewer(options_);
    ASSERT_NO_FATAL_FAILURE(drawUntil(viewer, [&] { return gate_.isReached(); }));
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(viewer.frame());
    EXPECT_FALSE(viewer.side(0).shown().isThere());
    EXPECT_FALSE(viewer.picture().pixels.empty());
    for (const Action action : {Action::frame_groom, Action::view_front, Action::compare})
        viewer.perform(action);
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(viewer.frame());
    gate_.open();
    drawUntil(viewer, [&] { return viewer.sideCount() == 2; });
    EXPECT_THAT(viewer.takeMessages(), IsEmpty());
}

// An error while drawing reaches the window. With a user, the window stays open so that changes can
// be saved.
TEST_F(LiveWindow, StaysWhereDrawingFails) {
    options_.frames = 0;
    Viewer viewer(options_);
    ASSERT_NO_FATAL_FAILURE(waitForTheScene(viewer));
    gate_.close();
    edit(viewer, 7);
    drawUntil(viewer, [&] { return gate_.isReached(); });
    gate_.openToAnError();
    drawUntil(viewer, [&] { return !viewer.message().empty(); });
    EXPECT_THAT(viewer.message(), HasSubstr("planted"));
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(viewer.frame());
    EXPECT_EQ(viewer.side(0).wanted().strands.density, 7u);
}

TEST_F(LiveWindow, EndsAScriptWhereDrawingFails) {
    Viewer viewer(options_);
    ASSERT_NO_FATAL_FAILURE(waitForTheScene(viewer));
    gate_.close();
    edit(viewer, 7);
    ASSERT_NO_FATAL_FAILURE(drawUntil(viewer, [&] { return gate_.isReached(); }));
    gate_.openToAnError();
    EXPECT_THROW(drawUntil(viewer, [] { return false; }), engine::DeviceLost);
}

TEST_F(LiveWindow, SaysWhetherAPictureIsStillBeingDrawn) {
    Viewer viewer(options_);
    ASSERT_NO_FATAL_FAILURE(waitForTheScene(viewer));
    gate_.close();
    edit(viewer, 5);
    ASSERT_NO_FATAL_FAILURE(drawUntil(viewer, [&] { return gate_.isReached(); }));
    EXPECT_FALSE(viewer.finish(std::chrono::milliseconds(1)));
    gate_.open();
    EXPECT_TRUE(viewer.finish(kWindowHangs));
}

// The picture in progress never finishes, but the program ends normally.
TEST_F(LiveWindow, ClosesWhileAPictureIsDrawn) {
    options_.frames = 5;
    options_.before_drawing = [] {
        while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    };
    EXPECT_EXIT(std::exit(commands::viewScene(options_)), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace benchmarks::viewer
