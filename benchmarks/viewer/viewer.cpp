#include "benchmarks/viewer/viewer.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include <imgui.h>

#include "benchmarks/viewer/files_panel.h"
#include "benchmarks/viewer/settings_panel.h"
#include "benchmarks/viewer/shell.h"
#include "engine/shaders.h"

namespace benchmarks::viewer {
namespace {

constexpr double kLong = 1.0;  // s; a picture of the scene that takes longer is mentioned
constexpr double kToldFor = 12.0;  // s; duration of a message

constexpr std::array kSides{
    Choice<std::size_t>{"A", 0, "The settings below are those of A."},
    Choice<std::size_t>{"B", 1, "The settings below are those of B; marked ones differ from A."}};

void enabledButton(const char* label, bool enabled, const auto& press) {
    ImGui::BeginDisabled(!enabled);
    if (ImGui::Button(label)) press();
    ImGui::EndDisabled();
}

std::string hintOf(Tool tool) {
    for (const ActionRow& row : actionTable())
        if (toolOf(row.action) == tool) return std::string(row.name) + ": " + row.help;
    return {};
}

constexpr float kZoomStep = 1.125f;

std::optional<engine::PresentMode> presentModeOf(Action action) {
    switch (action) {
    case Action::present_fifo:
        return engine::PresentMode::fifo;
    case Action::present_mailbox:
        return engine::PresentMode::mailbox;
    case Action::present_immediate:
        return engine::PresentMode::immediate;
    default:
        return std::nullopt;
    }
}

std::optional<Tab> tabOf(Action action) {
    switch (action) {
    case Action::panel_files:
        return Tab::files;
    case Action::panel_scene:
        return Tab::scene;
    case Action::panel_timings:
        return Tab::timings;
    case Action::panel_compare:
        return Tab::compare;
    case Action::panel_shaders:
        return Tab::shaders;
    default:
        return std::nullopt;
    }
}

// Keeps assets that were read and grown for the check in the cache, for the scene's first picture.
hair::Settings settingsOf(const ViewOptions& options, measure::HairCache& cache) {
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    return scene::singleCase(scene, options.scene, &cache.assets()).settings;
}

}  // namespace

// ---- The parts
// -----------------------------------------------------------------------------------

struct Viewer::Parts : Shell {
    Parts(
        const ViewOptions& options, const SceneFile& file, const hair::Settings& settings,
        measure::HairCache cache)
        : Shell(options, file, settings, std::move(cache)) {
        start();
    }

    // ---- Contents of the window

    void showWindow() override;
    void showColumn(const char* name, const Box& box, std::span<const Tab> shown, Tab& chosen);
    void showTab(Tab tab);
    void showScene();
    void showFiles();
    void showCompare();
    void showPicture();
    std::string drawingNote() const override;
    void showStatus();

    // ---- Effects of menus and keys

    void perform(Action action);
    ActionState stateOf(Action action) const;
    bool changeSetting(Action action);
    bool changeWindow(Action action);
    void toggleColumn(Column& column);
    void compare();
};

// ---- Contents of the window ---------------------------------------------------------------------

void Viewer::Parts::showScene() {
    Side& side = scene.editedSide();
    ImGui::SetNextItemWidth(-1.0f);
    textInput("##search", search, "Search settings");
    enabledButton("Undo", side.canUndo(), [&] { side.undo(); });
    ImGui::SameLine();
    enabledButton("Redo", side.canRedo(), [&] { side.redo(); });
    if (scene.sideCount() > 1) {
        ImGui::SameLine(0.0f, ImGui::GetFontSize());
        std::size_t edited = scene.edited();
        choiceButtons<std::size_t>(kSides, edited);
        scene.setEdited(edited);
    }
    if (!side.problem().empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram));
        ImGui::TextWrapped("%s", side.problem().c_str());
        ImGui::PopStyleColor();
    }
    ImGui::Separator();
    hair::Settings settings = scene.editedSide().wanted();
    Edit edit;
    if (ImGui::BeginChild("fields")) edit = settingsPanel(settings, scene.reference(), search);
    ImGui::EndChild();
    scene.edit(scene.edited(), settings, edit);
}

void Viewer::Parts::showFiles() {
    if (ImGui::Button("Open file...")) perform(Action::open_scene);
    ImGui::SetItemTooltip("A scene, a screenshot, hair, a mesh or an environment.\n"
                          "Files can be dropped on the window, too.");
    ImGui::SameLine();
    std::optional<std::filesystem::path> chosen = recentScenes(preferences.now.recent);
    if (const auto listed = scenes.show(scene.file().path, thumbnails)) chosen = listed;
    if (chosen) open(*chosen);
}

void Viewer::Parts::showCompare() {
    compare_panel.edited = static_cast<int>(scene.edited());
    compare_panel.same_camera = scene.cameras == Cameras::linked;
    const bool two = scene.sideCount() > 1;
    const CompareWish wish =
        compare_panel.show(area, scene.side(0).wanted(), two ? &scene.side(1).wanted() : nullptr);
    scene.setEdited(static_cast<std::size_t>(compare_panel.edited));
    scene.cameras = compare_panel.same_camera ? Cameras::linked : Cameras::separate;
    switch (wish) {
    case CompareWish::nothing:
        break;
    case CompareWish::start:
    case CompareWish::stop:
        compare();
        break;
    case CompareWish::swap:
        scene.swapSides();
        break;
    case CompareWish::copy_a_to_b:
        scene.side(1).edit(scene.side(0).wanted(), {.changed = true});
        break;
    }
}

void Viewer::Parts::showTab(Tab tab) {
    switch (tab) {
    case Tab::scene:
        showScene();
        break;
    case Tab::files:
        showFiles();
        break;
    case Tab::timings:
        origin.scene = scene.file().path;
        origin.name = scene.file().name;
        timings.show(
            scene.side(0), scene.sideCount() > 1 ? &scene.side(1) : nullptr, origin,
            {.device = presenter.milliseconds(),
             .slowest_answer = answers.empty() ? 0.0 : std::ranges::max(answers),
             .pictures_per_second = picturesPerSecond(),
             .memory = device.allocatedBytes()});
        break;
    case Tab::compare:
        showCompare();
        break;
    case Tab::shaders:
        shaderPanel(shaders);
        break;
    }
}

void Viewer::Parts::showColumn(
    const char* name, const Box& box, std::span<const Tab> shown, Tab& chosen) {
    pane(name, box, Surface::panel, [&] {
        if (tabStrip(shown, chosen)) tabs.choose(chosen);
        ImGui::Spacing();
        if (ImGui::BeginChild(tabName(chosen))) showTab(chosen);
        ImGui::EndChild();
    });
}

void Viewer::Parts::showPicture() {
    {
        Side& side = scene.editedSide();
        hair::Settings settings = side.wanted();
        Edit edit;
        // Tools need a shown picture to point at.
        ImGui::BeginDisabled(!side.shown().isThere());
        if (ImGui::BeginChild("toolbar", {0.0f, 0.0f}, ImGuiChildFlags_AutoResizeY))
            edit = tools.toolbar(settings, side.shown());
        ImGui::EndChild();
        ImGui::EndDisabled();
        scene.edit(scene.edited(), settings, edit);
    }
    constexpr ImGuiWindowFlags kStill =
        ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
    if (ImGui::BeginChild("picture", {0.0f, 0.0f}, ImGuiChildFlags_None, kStill)) {
        std::array<std::string, 2> captions;
        for (std::size_t i = 0; i < scene.sideCount(); ++i)
            captions[i] = frameTimeCaption(scene.side(i).timings());
        shown_note = drawingNote();
        for (const PictureArea::Shown& shown : area.show(captions, shown_note)) {
            const auto index = static_cast<std::size_t>(shown.side);
            hair::Settings settings = scene.side(index).wanted();
            const Edit edit = tools.update(
                shown.rect, shown.clip, shown.hovered, area.held() == shown.side, settings,
                scene.side(index).shown());
            scene.edit(index, settings, edit);
        }
    }
    ImGui::EndChild();
}

// Returns notes about the current pictures.
std::string Viewer::Parts::drawingNote() const {
    const Shown& shown = scene.side(0).shown();
    std::string note;
    if (shown.level > 0)
        note = previewText(shown.level, shown.strand_share, shown.width, shown.height);
    const double since = drawing.busy() ? seconds() - ordered_at : 0.0;
    if (!shown.isThere() || since >= kLong) {
        if (!note.empty()) note += "; ";
        note += shown.isThere() ? "the next picture is being drawn" : "the scene is being opened";
        note += ", " + std::to_string(static_cast<int>(since)) + " s";
    }
    return note;
}

void Viewer::Parts::showStatus() {
    if (message.count() != told) {
        told = message.count();
        told_at = ImGui::GetTime();
    }
    const Shown& shown = scene.editedSide().shown();
    const hair::RenderSettings& render = shown.settings.render;
    StatusText status{
        .text = hintOf(tools.tool),
        .device = scene_device->info().name,
        .picture = std::to_string(render.width) + " × " + std::to_string(render.height) +
                   " px, frame " + std::to_string(shown.frame)};
    if (shown.previews) status.picture += ", continues from the previous state";
    if (shown.level > 0) status.picture += ", preview";
    if (!shaders.replaced.empty()) status.picture += ", shaders changed";
    if (recorder.records()) {
        status.text = recorder.message();
        status.tone = StatusText::Tone::message;
    } else if (!message.text().empty() && ImGui::GetTime() < told_at + kToldFor) {
        status.text = message.text();
        status.tone = message.tone() == Message::Tone::problem ? StatusText::Tone::problem
                                                               : StatusText::Tone::message;
    }
    statusLine(status);
}

void Viewer::Parts::showWindow() {
    for (const Action action : menuBar([&](Action each) { return stateOf(each); })) perform(action);
    for (const Action action : pressedActions())
        if (stateOf(action).enabled) perform(action);

    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const Layout layout = arrange(
        size.x, size.y, ImGui::GetFrameHeight(), ImGui::GetFontSize(), preferences.now.left,
        preferences.now.right);
    merged = layout.merged;
    if (merged)
        showColumn("Left", layout.left, allTabs(), tabs.only);
    else
        showColumn("Left", layout.left, leftTabs(), tabs.left);
    showColumn("Right", layout.right, rightTabs(), tabs.right);
    pane("Picture", layout.picture, Surface::stage, [&] { showPicture(); });
    pane("Play", layout.play, Surface::bar, [&] { playPanel(state, scene.side(0).shown()); });
    pane("Status", layout.status, Surface::bar, [&] { showStatus(); });
    splitters(layout, preferences.now);
    helpPanel(help);
    if (const std::optional<FileDialog::Chosen> chosen = dialog.show()) {
        if (chosen->use == FileDialog::Use::save)
            saveAs(chosen->path);
        else
            drop(chosen->path);
    }
}

// ---- Effects of menus and keys ------------------------------------------------------------------

void Viewer::Parts::compare() {
    if (scene.sideCount() > 1) {
        scene.stopComparing();
        area.views = Views::a;
        message.tell("A is shown alone");
    } else {
        scene.startComparing();
    }
}

// Changes settings; false if the action does not concern settings.
bool Viewer::Parts::changeSetting(Action action) {
    hair::Settings settings = scene.editedSide().wanted();
    const Shown& shown = scene.editedSide().shown();
    Edit edit{.changed = true};
    if (bool* const value = switchOf(action, settings))
        *value = !*value;
    else if (const std::optional<hair::Show> show = showOf(action))
        settings.render.show = *show;
    else if ((presetOf(action) || action == Action::frame_groom) && !shown.isThere())
        return true;
    else if (const CameraPreset* const preset = presetOf(action))
        edit = tools.look(settings, shown, *preset);
    else if (action == Action::frame_groom)
        edit = tools.frameGroom(settings, shown);
    else
        return false;
    scene.edit(scene.edited(), settings, edit);
    return true;
}

// If only one column fits, toggles both.
void Viewer::Parts::toggleColumn(Column& column) {
    Preferences& now = preferences.now;
    if (merged)
        now.left.shown = now.right.shown = !(now.left.shown || now.right.shown);
    else
        column.shown = !column.shown;
}

// Changes the window's arrangement; false if the action does not concern it.
bool Viewer::Parts::changeWindow(Action action) {
    Preferences& now = preferences.now;
    const auto zoomTo = [&](float zoom) {
        now.zoom = std::clamp(zoom, kSmallestZoom, kLargestZoom);
    };
    if (const std::optional<Tab> tab = tabOf(action)) {
        tabs.choose(*tab);
        (std::ranges::count(leftTabs(), *tab) > 0 ? now.left : now.right).shown = true;
        return true;
    }
    if (const std::optional<engine::PresentMode> mode = presentModeOf(action)) {
        now.present_mode = *mode;
        return true;
    }
    switch (action) {
    case Action::dark_theme:
        now.theme = Theme::dark;
        return true;
    case Action::light_theme:
        now.theme = Theme::light;
        return true;
    case Action::larger:
        zoomTo(now.zoom * kZoomStep);
        return true;
    case Action::smaller:
        zoomTo(now.zoom / kZoomStep);
        return true;
    case Action::left_column:
        toggleColumn(now.left);
        return true;
    case Action::right_column:
        toggleColumn(now.right);
        return true;
    case Action::help:
        help = !help;
        return true;
    case Action::reset_layout: {
        const Preferences first;
        now.left = first.left;
        now.right = first.right;
        now.zoom = first.zoom;
        tabs = {};
        return true;
    }
    default:
        return false;
    }
}

void Viewer::Parts::perform(Action action) {
    if (changeSetting(action) || changeWindow(action)) return;
    if (const std::optional<Tool> tool = toolOf(action)) {
        tools.tool = *tool;
        return;
    }
    switch (action) {
    case Action::open_scene:
        dialog.open(FileDialog::Use::open, scene.file().directory);
        break;
    case Action::save_scene:
        save();
        break;
    case Action::save_scene_as:
        dialog.open(FileDialog::Use::save, suggestedPath());
        break;
    case Action::copy_axes:
        copyArguments();
        break;
    case Action::screenshot:
        screenshot();
        break;
    case Action::record:
        record();
        break;
    case Action::quit:
        window.close();
        break;
    case Action::undo:
        scene.editedSide().undo();
        break;
    case Action::redo:
        scene.editedSide().redo();
        break;
    case Action::play:
        state.playing = !state.playing;
        break;
    case Action::step:
        state.step = true;
        break;
    case Action::restart:
        state.seek = 0;
        break;
    case Action::preview:
        previews = !previews;
        break;
    case Action::compare:
        compare();
        break;
    case Action::edit_other:
        scene.setEdited(1 - scene.edited());
        break;
    default:
        break;
    }
}

ActionState Viewer::Parts::stateOf(Action action) const {
    const Preferences& now = preferences.now;
    hair::Settings settings = scene.editedSide().wanted();
    if (const bool* const value = switchOf(action, settings)) return {.checked = *value};
    if (const std::optional<hair::Show> show = showOf(action))
        return {.checked = settings.render.show == *show};
    if (const std::optional<Tool> tool = toolOf(action)) return {.checked = tools.tool == *tool};
    if (const std::optional<engine::PresentMode> mode = presentModeOf(action))
        return {
            .checked = presenter.mode() == *mode,
            .enabled = std::ranges::count(presenter.modes(), *mode) > 0};
    switch (action) {
    case Action::record:
        return {.checked = recorder.records()};
    case Action::undo:
        return {.enabled = scene.editedSide().canUndo()};
    case Action::redo:
        return {.enabled = scene.editedSide().canRedo()};
    case Action::play:
        return {.checked = state.playing};
    case Action::step:
        return {.enabled = !state.playing};
    case Action::preview:
        return {.checked = previews};
    case Action::compare:
        return {.checked = scene.sideCount() > 1};
    case Action::edit_other:
        return {.enabled = scene.sideCount() > 1};
    case Action::dark_theme:
        return {.checked = now.theme == Theme::dark};
    case Action::light_theme:
        return {.checked = now.theme == Theme::light};
    case Action::left_column:
        return {.checked = now.left.shown || (merged && now.right.shown)};
    case Action::right_column:
        return {.checked = now.right.shown || (merged && now.left.shown)};
    case Action::help:
        return {.checked = help};
    default:
        return {};
    }
}

// ---- Public interface ---------------------------------------------------------------------------

Viewer::Viewer(const ViewOptions& options) {
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const hair::Settings settings = settingsOf(options, cache);
    parts_ = std::make_unique<Parts>(
        options, openScene(options.scene.scene, options.scene.outside), settings, std::move(cache));
}
Viewer::~Viewer() {
    // The measuring thread waits for the window between rounds.
    parts_->timings.measuring().cancel();
    parts_->keepPreferences();
}

bool Viewer::frame() { return parts_->frame(); }

bool Viewer::finish(std::chrono::milliseconds patience) {
    parts_->timings.measuring().cancel();
    parts_->drawing.requestStop();
    return parts_->drawing.waitFor(patience);
}

void Viewer::keepPreferences() { parts_->keepPreferences(); }

void Viewer::setLive(bool live) { parts_->live = live; }
void Viewer::setThumbnails(bool drawn) { parts_->draws_thumbnails = drawn; }
std::size_t Viewer::missingThumbnails() const { return parts_->thumbnails.missing(); }

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

double Viewer::picturesPerSecond() const { return parts_->picturesPerSecond(); }

double Viewer::slowestAnswer() const {
    return parts_->answers.empty() ? 0.0 : std::ranges::max(parts_->answers);
}

std::vector<std::string> Viewer::takeMessages() {
    std::vector<std::string> messages = parts_->device.messages().take();
    std::ranges::move(parts_->scene_device->messages().take(), std::back_inserter(messages));
    return messages;
}

}  // namespace benchmarks::viewer
