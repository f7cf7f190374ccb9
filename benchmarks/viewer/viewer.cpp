#include "benchmarks/viewer/viewer.h"

#include <string>

#include <imgui.h>

#include "benchmarks/viewer/shell.h"
#include "engine/error.h"
#include "engine/process.h"

namespace benchmarks::viewer {
namespace {

constexpr double kAwake = 1.0;    // s that the window is drawn on for after something happened
constexpr double kAsleep = 0.25;  // s between pictures while nothing does
constexpr double kKeeping = 2.0;  // s between looks at whether preferences changed

engine::DeviceOptions windowed(engine::DeviceOptions options) {
    options.window_extensions = engine::Window::instanceExtensions();
    return options;
}

std::filesystem::path preferencesOf(const ViewOptions& options) {
    if (!options.preferences.empty() || !options.script.empty()) return options.preferences;
    return usersPreferences().value_or("");
}

// The size that the command line gives, else that of the last time.
engine::WindowDescription windowOf(const ViewOptions& options, const Preferences& preferences) {
    const ViewOptions unsaid;
    const bool as_it_was = options.width == unsaid.width && options.height == unsaid.height;
    return {
        .width = as_it_was ? preferences.width : options.width,
        .height = as_it_was ? preferences.height : options.height};
}

hair::Settings settingsOf(const ViewOptions& options) {
    scene::Scene scene = scene::loadScene(options.scene.scene);
    return scene::singleCase(scene, options.scene).settings;
}

// Makes what is shown the picture of the side's settings: ends drags, and throws where the settings
// were refused.
void bringUpToDate(Side& side) {
    side.settle();
    side.follow();
    if (!side.problem().empty())
        throw engine::Error("what the panel says can't be", side.problem());
}

}  // namespace

// ---- The window, picture by picture -------------------------------------------------------------

Viewer::Parts::Parts(
    const ViewOptions& options, const SceneFile& file, const hair::Settings& settings)
    : preferences(preferencesOf(options)), driven(!options.script.empty() || options.frames > 0),
      fixed_scale(static_cast<float>(options.scale)), window(windowOf(options, preferences.now)),
      device(windowed(options.scene.device)),
      presenter(device, window, preferences.now.present_mode), ui(device, window, 1.0f),
      area(device),
      reload(device, options.shaders.empty() ? HAIRBENCH_SHADER_FOLDER : options.shaders),
      scene(device, file, settings), scenes(file.directory), timings(device) {
    origin.command = options.command;
    origin.validation = options.scene.device.validation;
    // What the command line says is the whole scale.
    if (options.scale > 0.0) preferences.now.zoom = 1.0f;
    window.setTitle("hairbench " + file.name);
    remember(preferences.now, file.path);
}

// A window in which nothing happens is drawn a few times a second.
void Viewer::Parts::waitForEvents() {
    const bool minimised = presenter.extent().width == 0;
    const bool awake = driven || state.playing || tools.isBusy() || ImGui::GetTime() < awake_until;
    window.poll(awake && !minimised ? 0.0 : kAsleep);
    if (window.takeActivity()) awake_until = ImGui::GetTime() + kAwake;
}

// Letters as large as the screen and the user want them, and the style that goes with them.
void Viewer::Parts::followScale() {
    const float screen = fixed_scale > 0.0f ? fixed_scale : window.contentScale();
    const float wanted = screen * preferences.now.zoom;
    if (wanted == styled_scale && preferences.now.theme == styled_theme) return;
    if (wanted != ui.scale()) ui.setScale(wanted);
    ImGui::GetStyle() = styleOf(preferences.now.theme, wanted);
    styled_scale = wanted;
    styled_theme = preferences.now.theme;
}

void Viewer::Parts::present() {
    presenter.frame(
        [&](engine::Commands& commands) {
            area.copy(
                commands, scene.side(0).player().played().output(),
                scene.sideCount() > 1 ? &scene.side(1).player().played().output() : nullptr);
        },
        [&](engine::Commands& commands) { ui.draw(commands); });
}

void Viewer::Parts::reloadShaders() {
    if (!reload.poll()) return;
    const auto rebuild = [&] {
        for (Side* const side : scene.sides()) side->rebuild();
    };
    try {
        rebuild();
        reload.accept();
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (const engine::Error& error) {
        reload.reject(error.what());
        rebuild();
    }
}

void Viewer::Parts::playFrames() {
    // A recording has every frame, however fast time is to go by.
    const auto frames =
        recorder.records() ? OpenScene::Frames::every_one : OpenScene::Frames::as_due;
    scene.play(state, double{ImGui::GetIO().DeltaTime}, frames);
    const std::string& problem = scene.editedSide().problem();
    if (problem != reported && !problem.empty()) message.complain(problem);
    reported = problem;
    message.attempt([&] { recorder.frame(scene.side(0).player()); });
}

// The runner's measurement of a side, while the window shows how far it is.
void Viewer::Parts::measure(std::size_t side) {
    timings.measuring().measure(
        scene.side(side), origin,
        {.picture =
             [&] {
                 window.poll(0.0);
                 if (presenter.extent().width == 0) return;  // minimised
                 ui.begin();
                 showWindow();
                 ui.end();
                 present();
             },
         .closes =
             [&] {
                 window.poll(0.0);
                 return window.wantsToClose() || engine::interrupted();
             }});
}

void Viewer::Parts::keepPreferences() {
    if (presenter.extent().width > 0) {
        // What the desktop made larger on a fine screen it will make larger again.
        const VkExtent2D size = window.size();
        const float scale = window.contentScale();
        preferences.now.width = static_cast<std::uint32_t>(static_cast<float>(size.width) / scale);
        preferences.now.height =
            static_cast<std::uint32_t>(static_cast<float>(size.height) / scale);
    }
    preferences.keep();
    if (!preferences.problem().empty() && preferences.problem() != reported_preferences) {
        reported_preferences = preferences.problem();
        message.complain(reported_preferences);
    }
}

bool Viewer::Parts::frame() {
    waitForEvents();
    const double now = ImGui::GetTime();
    if (now > kept_at + kKeeping) {
        keepPreferences();
        kept_at = now;
    }
    if (window.wantsToClose()) return false;
    for (const std::filesystem::path& file : window.takeDropped()) drop(file);
    if (presenter.extent().width == 0) return true;  // minimised
    followScale();
    presenter.setMode(preferences.now.present_mode);
    ui.begin();
    showWindow();
    if (!ImGui::IsAnyItemActive() && !tools.isBusy())
        for (Side* const side : scene.sides()) side->settle();
    ui.end();
    present();
    if (const auto side = timings.measuring().wanted()) measure(*side);
    reloadShaders();
    playFrames();
    return true;
}

// ---- Files that are opened and written ----------------------------------------------------------

std::filesystem::path Viewer::Parts::suggestedPath() const {
    const SceneFile& file = scene.file();
    if (scene.wasSaved()) return file.path;
    return freeName(file.path.parent_path(), file.name, ".json");
}

void Viewer::Parts::open(const std::filesystem::path& path) {
    message.attempt([&] {
        const SceneFile file = openScene(path);
        scene.open(file);
        scenes = SceneList(file.directory);
        area.views = Views::a;
        window.setTitle("hairbench " + file.name);
        remember(preferences.now, file.path);
        message.tell("opened " + file.path.string());
    });
}

// A scene that somebody wrote has more than its state in it, such as a sweep: it is replaced only
// where the user says so.
void Viewer::Parts::save() {
    if (scene.wasSaved())
        saveAs(scene.file().path);
    else
        path_popup.open(suggestedPath());
}

void Viewer::Parts::saveAs(const std::filesystem::path& path) {
    message.attempt([&] {
        Side& side = scene.editedSide();
        bringUpToDate(side);
        saveScene(side.wanted(), scene.file().directory, path);
        scene.savedAs(path);
        window.setTitle("hairbench " + scene.file().name);
        remember(preferences.now, path);
        message.tell("saved to " + path.string());
    });
}

void Viewer::Parts::copyArguments() {
    message.attempt([&] {
        const scene::Scene saved = scene::loadScene(scene.file().path);
        // It may have been saved to another folder than the one that it was opened in.
        const std::string arguments = caseArguments(
            saved,
            movedFiles(scene.editedSide().wanted(), scene.file().directory, saved.directory));
        ImGui::SetClipboardText(arguments.c_str());
        message.tell(arguments.empty() ? "nothing differs from the scene" : "copied: " + arguments);
    });
}

void Viewer::Parts::screenshot() {
    message.attempt([&] {
        Side& side = scene.editedSide();
        bringUpToDate(side);
        const std::filesystem::path folder = std::filesystem::current_path();
        const std::filesystem::path path =
            freeName(folder, "hairbench-" + scene.file().name, ".png");
        const hair::Settings& settings = side.player().settings();
        writeScreenshot(
            path, settings.render.width, settings.render.height, side.player().played().picture(),
            sceneText(settings, scene.file().directory, folder));
        message.tell("wrote " + path.string());
    });
}

void Viewer::Parts::record() {
    message.attempt([&] {
        if (recorder.records()) {
            message.tell(
                "recorded " + std::to_string(recorder.written()) + " frames to " +
                recorder.folder().string());
            recorder.stop();
            return;
        }
        recorder.start(
            freeName(std::filesystem::current_path(), "hairbench-" + scene.file().name, ""));
        message.tell("recording to " + recorder.folder().string());
    });
}

void Viewer::Parts::drop(const std::filesystem::path& file) {
    const Dropped what = whatIs(file);
    if (what == Dropped::scene) {
        open(file);
    } else if (what == Dropped::unknown) {
        message.complain(
            file.string() + ": no scene, screenshot, groom, mesh or environment, by its name");
    } else {
        message.attempt([&] {
            const hair::Settings settings =
                withDropped(scene.editedSide().wanted(), scene.file().directory, file);
            scene.edit(scene.edited(), settings, {.changed = true});
            message.tell("took " + file.string());
        });
    }
}

// ---- What is seen from outside ------------------------------------------------------------------

Viewer::Viewer(const ViewOptions& options)
    : parts_(
          std::make_unique<Parts>(options, openScene(options.scene.scene), settingsOf(options))) {}
Viewer::~Viewer() { parts_->keepPreferences(); }

bool Viewer::frame() { return parts_->frame(); }

std::size_t Viewer::sideCount() const { return parts_->scene.sideCount(); }
const Side& Viewer::side(std::size_t index) const { return parts_->scene.side(index); }
void Viewer::edit(std::size_t index, const hair::Settings& settings) {
    parts_->scene.edit(index, settings, {.changed = true});
}
void Viewer::perform(Action action) { parts_->perform(action); }
void Viewer::drop(const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) parts_->drop(file);
}
void Viewer::resize(std::uint32_t width, std::uint32_t height) {
    parts_->window.resize(width, height);
}
PlayState& Viewer::play() { return parts_->state; }

engine::Presenter::Picture Viewer::picture() const { return parts_->presenter.picture(); }

const std::string& Viewer::message() const { return parts_->message.text(); }
float Viewer::scale() const { return parts_->ui.scale(); }
engine::PresentMode Viewer::presentMode() const { return parts_->presenter.mode(); }

std::vector<std::string> Viewer::takeMessages() { return parts_->device.messages().take(); }

}  // namespace benchmarks::viewer
