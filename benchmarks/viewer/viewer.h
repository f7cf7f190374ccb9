#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/viewer/shell.h"
#include "engine/presenter.h"
#include "hair/settings.h"

namespace benchmarks::viewer {

enum class Action;  // actions.h
class Side;         // side.h
struct PlayState;   // player.h

// A window that plays a scene and can change everything about it. It responds while pictures of the
// scene are drawn, because another thread draws them.
class Viewer {
public:
    explicit Viewer(const ViewOptions& options);
    // Waits for the picture in progress.
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    // Draws one picture of the window; false if it was closed.
    bool frame();
    // Asks the drawing thread to end; false if that takes longer than `patience`.
    bool finish(std::chrono::milliseconds patience);
    void keepPreferences();  // like the destructor

    // Whether frame() returns while the scene's picture is being drawn. Initially not, for scripts
    // and for windows that close after some pictures: each picture of the window then shows all
    // earlier requests.
    void setLive(bool live);

    // Whether thumbnails of scenes are drawn. Initially not where frame() waits for the scene.
    void setThumbnails(bool drawn);
    // How many scenes in the window's last picture lack a thumbnail.
    std::size_t missingThumbnails() const;

    // User actions, for scripts. Sides are counted from 0; there are two when comparing.
    std::size_t sideCount() const;
    const Side& side(std::size_t index) const;
    void edit(std::size_t index, const hair::Settings& settings);
    void perform(Action action);
    void drop(const std::vector<std::filesystem::path>& files);
    void resize(std::uint32_t width, std::uint32_t height);  // screen coordinates
    PlayState& play();

    // The shown state of the window.
    engine::Presenter::Picture picture() const;
    // Returns the last message or problem; may be empty.
    const std::string& message() const;
    // Returns the maximum ms from reading mouse and keys to handing the picture with their effect
    // to the desktop, over the last 300 pictures.
    double slowestAnswer() const;
    // Pictures of the scene, including previews, over the last 2 s; 0 if there were none.
    double picturesPerSecond() const;
    float scale() const;  // scale of letters and widgets
    engine::PresentMode presentMode() const;

    // Returns the warnings and errors of the validation layer since the last call.
    std::vector<std::string> takeMessages();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace benchmarks::viewer
