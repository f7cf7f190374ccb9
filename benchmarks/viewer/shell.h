#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "benchmarks/viewer/actions.h"
#include "benchmarks/viewer/columns.h"
#include "benchmarks/viewer/compare_panel.h"
#include "benchmarks/viewer/open_scene.h"
#include "benchmarks/viewer/picture_area.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/preferences.h"
#include "benchmarks/viewer/recorder.h"
#include "benchmarks/viewer/scene_list.h"
#include "benchmarks/viewer/shader_reload.h"
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
    Parts(const ViewOptions& options, const SceneFile& file, const hair::Settings& settings);

    // ---- viewer.cpp: the window, picture by picture

    // Draws one picture of the window; false once it is closed.
    bool frame();
    void waitForEvents();
    void followScale();
    void present();
    void reloadShaders();
    void playFrames();
    void keepPreferences();
    void measure(std::size_t side);

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
    void showStatus();

    // ---- shell.cpp: what menus and keys do

    void perform(Action action);
    ActionState stateOf(Action action) const;
    bool changeSetting(Action action);
    bool changeWindow(Action action);
    void toggleColumn(Column& column);
    void compare();

    PreferencesFile preferences;
    bool driven;        // by a script, or for a number of pictures: it never waits for events
    float fixed_scale;  // the command line's, in place of the screen's; 0: none
    float styled_scale = 0.0f;
    Theme styled_theme = Theme::dark;
    engine::Window window;
    engine::Device device;
    engine::Presenter presenter;
    engine::Ui ui;
    PictureArea area;
    ComparePanel compare_panel;
    ShaderReload reload;
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
    double awake_until = 0.0;  // s, as ImGui::GetTime()
    double kept_at = -1e9;     // s; the first picture looks, so that a broken file is reported
    double told_at = 0.0;      // s
    unsigned told = 0;         // count of the message that is shown
};

}  // namespace benchmarks::viewer
