#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "benchmarks/viewer/files/recorder.h"
#include "benchmarks/viewer/files/scene_list.h"
#include "benchmarks/viewer/picture/compare_panel.h"
#include "benchmarks/viewer/picture/picture_area.h"
#include "benchmarks/viewer/play/open_scene.h"
#include "benchmarks/viewer/shaders/shader_reload.h"
#include "benchmarks/viewer/shell/layout.h"
#include "benchmarks/viewer/shell/menu_bar.h"
#include "benchmarks/viewer/shell/message.h"
#include "benchmarks/viewer/shell/path_popup.h"
#include "benchmarks/viewer/shell/preferences_file.h"
#include "benchmarks/viewer/shell/tabs.h"
#include "benchmarks/viewer/timings/timings_panel.h"
#include "benchmarks/viewer/tools/picture_tools.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/presenter.h"
#include "engine/ui.h"
#include "engine/window.h"

namespace benchmarks {

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

    // ---- shell/panels.cpp: what the window shows, and what is done with it
    void showWindow();
    void showColumn(const char* name, const Box& box, std::span<const Tab> shown, Tab& chosen);
    void showTab(Tab tab);
    void showScene();
    void showFiles();
    void showCompare();
    void showPicture();
    void showStatus();

    // ---- shell/perform.cpp: what menus and keys do
    void perform(Action action);
    ActionState stateOf(Action action) const;
    bool changeSetting(Action action);
    bool changeWindow(Action action);
    void toggleColumn(Column& column);
    void compare();

    // ---- shell/perform_files.cpp
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

}  // namespace benchmarks
