#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/viewer/actions.h"
#include "benchmarks/viewer/columns.h"
#include "benchmarks/viewer/compare_panel.h"
#include "benchmarks/viewer/open_scene.h"
#include "benchmarks/viewer/order_thread.h"
#include "benchmarks/viewer/picture_area.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/preferences.h"
#include "benchmarks/viewer/preview.h"
#include "benchmarks/viewer/recorder.h"
#include "benchmarks/viewer/scene_list.h"
#include "benchmarks/viewer/shader_reload.h"
#include "benchmarks/viewer/studio.h"
#include "benchmarks/viewer/timings_panel.h"
#include "benchmarks/viewer/toolbar.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/device.h"
#include "engine/presenter.h"
#include "engine/ui.h"
#include "engine/window.h"

// The inside of the viewer, for viewer.cpp and shell.cpp alone.
namespace benchmarks::viewer {

// The last thing that the user was told.
class Message {
public:
    enum class Tone { told, problem };

    void tell(const std::string& text) { set(text, Tone::told); }
    void complain(const std::string& text) { set(text, Tone::problem); }

    const std::string& text() const { return text_; }
    Tone tone() const { return tone_; }
    // Counts messages, so that the same text again is a new one.
    unsigned count() const { return count_; }

    // What `work` throws, a lost device apart, becomes a complaint.
    template <class Work>
    void attempt(Work&& work) {
        try {
            work();
        } catch (const engine::DeviceLost&) {
            throw;
        } catch (const engine::Error& error) {
            complain(error.what());
        }
    }

private:
    void set(const std::string& text, Tone tone) {
        text_ = text;
        tone_ = tone;
        ++count_;
    }

    std::string text_;
    Tone tone_ = Tone::told;
    unsigned count_ = 0;
};

// A box over everything else that asks for the path of a file to write.
class PathPopup {
public:
    // Opens the box, from the next picture of the window on, with a path to begin with.
    void open(const std::filesystem::path& suggested);

    // Shows the box while it is open, and returns the path that was accepted.
    std::optional<std::filesystem::path> show();

private:
    std::string typed_;
    bool opens_ = false;
};

// What the viewer is made of.
struct Viewer::Parts {
    Parts(
        const ViewOptions& options, const SceneFile& file, const hair::Settings& settings,
        measure::HairCache cache);

    // ---- viewer.cpp: the window, picture by picture

    // Draws one picture of the window; false once it is closed.
    bool frame();
    void drawPicture();
    void waitForEvents();
    double patience() const;
    void followScale();
    void present();
    void keepPreferences();
    double seconds() const;  // since it was opened, by a clock that scripts don't set

    // ---- viewer.cpp: the thread that draws

    bool waitsForDrawing() const { return driven && !live; }
    void orderWork();
    void beginWork(Order order);
    void waitForWork();
    void takeWork();
    void holdStill();
    void pauseIfCrawling();
    void takeNews(const OpenScene::News& news);
    unsigned levelFor(const Order& order);
    double picturesPerSecond() const;
    void stopDrawing(const std::string& why);
    // Does something once what a side was asked for last is followed and, where that is wanted,
    // shown as the runner draws it.
    enum class Needs { settings, picture };
    void whenFollowed(Side& side, Needs needs, std::function<void(Side&)> act);
    void actOnFollowed();

    // ---- viewer.cpp: files that are opened and written

    std::filesystem::path suggestedPath() const;  // where a scene might be saved
    void open(const std::filesystem::path& path);
    void save();
    void saveAs(const std::filesystem::path& path);
    void copyArguments();
    void screenshot();
    void record();
    void drop(const std::filesystem::path& file);

    // ---- shell.cpp: what the window shows

    void showWindow();
    void showColumn(const char* name, const Box& box, std::span<const Tab> shown, Tab& chosen);
    void showTab(Tab tab);
    void showScene();
    void showFiles();
    void showCompare();
    void showPicture();
    std::string drawingNote() const;
    void showStatus();

    // ---- shell.cpp: what menus and keys do

    void perform(Action action);
    ActionState stateOf(Action action) const;
    bool changeSetting(Action action);
    bool changeWindow(Action action);
    void toggleColumn(Column& column);
    void compare();

    scene::Outside outside;  // of scenes that are opened
    PreferencesFile preferences;
    bool driven;  // by a script, or for a number of pictures
    bool live = false;  // though it is driven, it doesn't wait for what is drawn
    float fixed_scale;  // the command line's, in place of the screen's; 0: none
    float styled_scale = 0.0f;
    Theme styled_theme = Theme::dark;
    engine::Window window;
    bool gives_way;  // whether what draws the scene leaves the processors to the window
    std::unique_ptr<engine::Device> scene_device;  // of the thread that draws
    engine::Device device;  // of the window; the last one to be made
    engine::Presenter presenter;
    engine::Ui ui;
    PictureArea area;
    ComparePanel compare_panel;
    OpenScene scene;
    SceneList scenes;
    PictureTools tools;
    TimingsPanel timings;
    ReportOrigin origin;  // what reports of the open scene quote
    Recorder recorder;
    PlayState state;
    Message message;
    std::string reported;  // the side's problem that the message was about
    std::string reported_preferences;
    PathPopup path_popup;
    std::string search;
    Tabs tabs;
    bool help = false;
    bool merged = false;  // there is room for one column only
    std::string shown_note;  // drawingNote() of the last picture of the window
    double awake_until = 0.0;  // s, as ImGui::GetTime()
    double kept_at = -1e9;  // s; the first picture looks, so that a broken file is reported
    double told_at = 0.0;  // s
    unsigned told = 0;  // count of the message that is shown

    // What waits for a side to be followed.
    struct Waiting {
        std::uint64_t side = 0;
        std::uint64_t revision = 0;
        Needs needs = Needs::settings;
        std::function<void(Side&)> act;
    };
    std::vector<Waiting> waiting;
    bool previews = true;  // what moves may be drawn coarser
    PreviewControl control;
    bool paused_crawling = false;  // since the scene was opened
    ShaderStatus shaders;
    double due = 0.0;  // s since the last order, by the window's clock
    double ordered_at = 0.0;  // s, as seconds()
    double moved_at = 0.0;  // s, when something moved last
    std::chrono::steady_clock::time_point opened_at = std::chrono::steady_clock::now();
    std::optional<double> looked_at;  // s: at mouse and keys, for the next picture
    bool unseen = false;  // something came that the window has not shown
    bool disturbed = false;  // the window drew while it was drawn
    bool stopped = false;  // whoever draws has failed
    std::vector<double> answers;  // ms, of the last pictures of the window
    std::vector<double> came;  // s, as seconds(), when pictures of the scene came of late

    // Last, so that it is over before anything that it uses is gone.
    Studio studio;
    OrderThread<Order, Reply> drawing;
};

}  // namespace benchmarks::viewer
