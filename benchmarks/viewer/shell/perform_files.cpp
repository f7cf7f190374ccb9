#include <imgui.h>

#include "benchmarks/viewer/files/case_arguments.h"
#include "benchmarks/viewer/files/save_scene.h"
#include "benchmarks/viewer/files/screenshot.h"
#include "benchmarks/viewer/viewer_parts.h"

namespace benchmarks {

namespace {

// What is shown is what these settings make: nothing is being dragged, and nothing was refused.
void bringUpToDate(Side& side) {
    side.settle();
    side.follow();
    if (!side.problem().empty())
        throw engine::Error("what the panel says can't be", side.problem());
}

}  // namespace

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
        const Scene saved = loadScene(scene.file().path);
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

}  // namespace benchmarks
