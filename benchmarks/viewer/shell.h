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

#include "benchmarks/scene/sweep.h"
#include "benchmarks/viewer/actions.h"
#include "benchmarks/viewer/files_panel.h"
#include "benchmarks/viewer/open_scene.h"
#include "benchmarks/viewer/picture_area.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/preferences.h"
#include "benchmarks/viewer/settings_panel.h"
#include "benchmarks/viewer/shader_reload.h"
#include "benchmarks/viewer/side.h"
#include "benchmarks/viewer/studio.h"
#include "benchmarks/viewer/timings_panel.h"
#include "benchmarks/viewer/toolbar.h"
#include "engine/device.h"
#include "engine/presenter.h"
#include "engine/ui.h"
#include "engine/window.h"

namespace benchmarks::viewer {

struct ViewOptions {
    scene::SceneOptions scene;
    std::uint32_t width = 1600;  // of the window, in screen coordinates
    std::uint32_t height = 900;
    double scale = 0.0;  // of letters and widgets; 0: the screen's
    std::uint32_t frames = 0;  // the window closes after so many pictures; 0: it stays open
    std::filesystem::path screenshot;  // file for the window's last picture; empty: none
    std::filesystem::path script;  // steps that drive the window; empty: none
    bool live = false;  // Viewer::setLive(), for scripts or a number of pictures
    std::filesystem::path shaders;  // watched folder; empty: the build's
    // File of preferences; empty: the user's file, or none with a script.
    std::filesystem::path preferences;
    std::vector<std::string> command;  // for reports
    std::filesystem::path program{};  // this one, which draws thumbnails; empty: none
    // Called on the drawing thread with each order before any work, for tests that delay it; may be
    // empty.
    std::function<void()> before_drawing{};
};

// The parts behind the viewer's panels: the window itself, the thread that draws, and files.

// The last message to the user.
class Message {
public:
    enum class Tone { told, problem };

    void tell(const std::string& text) { set(text, Tone::told); }
    void complain(const std::string& text) { set(text, Tone::problem); }

    const std::string& text() const { return text_; }
    Tone tone() const { return tone_; }
    // Counts messages, so that a repeated text counts as a new message.
    unsigned count() const { return count_; }

    // Turns exceptions of `work` into complaints, except a lost device.
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

// The state of the viewer, and its work beside the contents of the window, which viewer.cpp adds.
struct Shell {
    Shell(
        const ViewOptions& options, const SceneFile& file, const hair::Settings& settings,
        measure::HairCache cache);
    virtual ~Shell() = default;
    Shell(const Shell&) = delete;
    Shell& operator=(const Shell&) = delete;

    // Shows the contents of the window with Dear ImGui.
    virtual void showWindow() = 0;
    // Returns the note that the picture in progress is slow; may be empty.
    virtual std::string drawingNote() const = 0;

    // ---- The window, picture by picture

    // Draws the scene's first picture, if the window waits for pictures.
    void start();

    // Draws one picture of the window; false if it was closed.
    bool frame();
    void drawPicture();
    Thumbnails::Draw thumbnailsToDraw() const;
    void waitForEvents();
    double patience() const;
    void followScale();
    void present();
    void keepPreferences();
    double seconds() const;  // since it was opened, by a clock that scripts do not control

    // ---- The thread that draws

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
    // Calls `act` once the side's last request is applied and, with Needs::picture, shown as the
    // runner draws it.
    enum class Needs { settings, picture };
    void whenFollowed(Side& side, Needs needs, std::function<void(Side&)> act);
    void actOnFollowed();

    // ---- Files that are opened and written

    std::filesystem::path suggestedPath() const;  // a path to save a scene
    void open(const std::filesystem::path& path);
    void save();
    void saveAs(const std::filesystem::path& path);
    void copyArguments();
    void screenshot();
    void record();
    void drop(const std::filesystem::path& file);

    scene::Outside outside;  // for opened scenes
    PreferencesFile preferences;
    bool driven;  // by a script, or for a number of pictures
    bool live = false;  // does not wait for drawing although driven
    float fixed_scale;  // from the command line, replaces the screen's; 0: none
    float styled_scale = 0.0f;
    Theme styled_theme = Theme::dark;
    engine::Window window;
    bool gives_way;  // the drawing thread leaves processors to the window
    std::unique_ptr<engine::Device> scene_device;  // for the drawing thread
    engine::Device device;  // for the window; created last
    engine::Presenter presenter;
    engine::Ui ui;
    PictureArea area;
    ComparePanel compare_panel;
    OpenScene scene;
    SceneList scenes;
    Thumbnails thumbnails;
    bool draws_thumbnails;
    PictureTools tools;
    TimingsPanel timings;
    ReportOrigin origin;  // for reports of the open scene
    Recorder recorder;
    PlayState state;
    Message message;
    std::string reported;  // problem of the side that was last reported
    std::string reported_preferences;
    FileDialog dialog;
    std::string search;
    Tabs tabs;
    bool help = false;
    bool merged = false;  // only one column fits
    std::string shown_note;  // drawingNote() in the window's last picture
    double awake_until = 0.0;  // s, as ImGui::GetTime()
    double kept_at = -1e9;  // s; makes the first picture check, so that a broken file is reported
    double told_at = 0.0;  // s
    unsigned told = 0;  // count of the shown message

    // An action that waits until a side's request is applied.
    struct Waiting {
        std::uint64_t side = 0;
        std::uint64_t revision = 0;
        Needs needs = Needs::settings;
        std::function<void(Side&)> act;
    };
    std::vector<Waiting> waiting;
    bool previews = true;  // pictures in motion may be coarser
    PreviewControl control;
    bool paused_crawling = false;  // once per opened scene
    ShaderStatus shaders;
    double due = 0.0;  // s since the last order, by the window's clock
    double ordered_at = 0.0;  // s, as seconds()
    double moved_at = 0.0;  // s, time of the last motion
    std::chrono::steady_clock::time_point opened_at = std::chrono::steady_clock::now();
    std::optional<double> looked_at;  // s; time of reading mouse and keys, for the next picture
    bool unseen = false;  // the window has not shown the latest replies
    bool disturbed = false;  // the window drew during the scene's picture
    bool stopped = false;  // the drawing thread has failed
    std::vector<double> answers;  // ms, of the last pictures of the window
    std::vector<double> came;  // s, like seconds(), of recent pictures of the scene

    // Last, so that it ends before anything that it uses is destroyed.
    Studio studio;
    WorkerThread<Order, Reply> drawing;
};

}  // namespace benchmarks::viewer
