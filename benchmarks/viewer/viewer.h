#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/scene/sweep.h"
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
#include "benchmarks/viewer/shell.h"
#include "benchmarks/viewer/timings_panel.h"
#include "benchmarks/viewer/toolbar.h"
#include "engine/presenter.h"
#include "engine/ui.h"
#include "engine/window.h"

namespace benchmarks::viewer {

struct ViewOptions {
    scene::SceneOptions scene;
    std::uint32_t width = 1600;  // of the window, screen coordinates
    std::uint32_t height = 900;
    double scale = 0.0;  // of widgets; 0: the screen's
    std::uint32_t frames = 0;  // of the window, after which it closes; 0: never
    std::filesystem::path screenshot;  // of the last one; empty: none
    std::filesystem::path script;  // steps that drive it; empty: none
    std::filesystem::path shaders;  // watched for changes; empty: those it was built from
    // What it remembers, a file; empty: the user's own, or nothing where a script drives it.
    std::filesystem::path preferences;
    std::vector<std::string> command;  // as reports quote it
};

// A window in which a scene plays, and in which everything about it can be changed.
class Viewer {
public:
    explicit Viewer(const ViewOptions& options);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    // Draws one picture of the window; false once it is closed.
    bool frame();

    // What users do, for scripts. Sides are counted from 0; there are two while it compares.
    std::size_t sideCount() const;
    const Side& side(std::size_t index) const;
    void edit(std::size_t index, const hair::Settings& settings);
    void perform(Action action);
    void drop(const std::vector<std::filesystem::path>& files);
    void resize(std::uint32_t width, std::uint32_t height);  // screen coordinates
    PlayState& play();

    // What the window shows.
    engine::Presenter::Picture picture() const;
    // The last thing that went wrong or that the user was told; may be empty.
    const std::string& message() const;
    float scale() const;  // of letters and widgets
    engine::PresentMode presentMode() const;

    // Warnings and errors of the validation layer, so far.
    std::vector<std::string> takeMessages();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// What the viewer is made of. The functions are in the files that their headings name.
struct Viewer::Parts {
    Parts(const ViewOptions& options, const SceneFile& file, const hair::Settings& settings);

    // ---- viewer.cpp
    // One picture of the window; false once it is closed.
    bool frame();
    void waitForEvents();
    void followScale();
    void present();
    void reloadShaders();
    void playFrames();
    void keepPreferences();
    void measure(std::size_t side);

    // ---- shell.cpp: what the window shows, and what is done with it
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

    // ---- shell.cpp
    std::filesystem::path suggestedPath() const;  // of a scene to save
    void open(const std::filesystem::path& path);
    void save();
    void saveAs(const std::filesystem::path& path);
    void copyArguments();
    void screenshot();
    void record();
    void drop(const std::filesystem::path& file);

    PreferencesFile preferences;
    bool driven;        // by a script, or for so many pictures: it never waits
    float fixed_scale;  // of the command line, in place of the screen's; 0: none
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
    ReportOrigin origin;  // of the scene that is open
    Recorder recorder;
    PlayState state;
    Message message;
    std::string reported;  // the side's problem that the message was about
    std::string reported_preferences;
    PathPopup path_popup;
    std::string search;
    Tabs tabs;
    bool help = false;
    bool merged = false;  // the columns, for want of room
    // s, as ImGui::GetTime().
    double awake_until = 0.0;
    double kept_at = -1e9;  // at once, so that a broken file is reported
    double told_at = 0.0;
    unsigned told = 0;  // messages
};

}  // namespace benchmarks::viewer
