#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/scene/sweep.h"
#include "engine/presenter.h"
#include "hair/settings.h"

namespace benchmarks::viewer {

enum class Action;  // actions.h
class Side;         // player.h
struct PlayState;   // player.h

struct ViewOptions {
    scene::SceneOptions scene;
    std::uint32_t width = 1600;  // the window's, in screen coordinates
    std::uint32_t height = 900;
    double scale = 0.0;                // scale of letters and widgets; 0: the screen's
    std::uint32_t frames = 0;  // pictures after which the window closes; 0: it stays open
    std::filesystem::path screenshot;  // written of the window's last picture; empty: none
    std::filesystem::path script;  // steps that drive the window; empty: none
    bool live = false;  // though a script or a number of pictures drives it: Viewer::setLive()
    std::filesystem::path shaders;  // folder that is watched; empty: that of the build
    // File of preferences; empty: the user's own, or none where a script drives the window.
    std::filesystem::path preferences;
    std::vector<std::string> command;  // the command line, as reports quote it
    // Called by the thread that draws, with each order before anything is done. For tests, which
    // hold it up there; empty: nothing is.
    std::function<void()> before_drawing{};
};

// A window in which a scene plays, and in which everything about it can be changed. It answers
// while pictures of the scene are drawn: that is another thread's work.
class Viewer {
public:
    explicit Viewer(const ViewOptions& options);
    // Waits for the picture that is being drawn.
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    // Draws one picture of the window; false once it is closed.
    bool frame();
    // Asks whoever draws to end; false where that takes longer.
    bool finish(std::chrono::milliseconds patience);
    void keepPreferences();  // as the destructor does

    // Whether frame() returns while the scene's picture is being drawn. Scripts, and windows that
    // close after some pictures, begin otherwise: then each picture of the window has all that was
    // asked for before it.
    void setLive(bool live);

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
    // ms from when the window looked at mouse and keys until the picture with what they did was
    // handed to the desktop, at most, of its last 300 pictures.
    double slowestAnswer() const;
    // Of the scene, previews among them, in the last 2 s; 0 where none came.
    double picturesPerSecond() const;
    float scale() const;  // scale of letters and widgets
    engine::PresentMode presentMode() const;

    // Warnings and errors of the validation layer, so far.
    std::vector<std::string> takeMessages();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace benchmarks::viewer
