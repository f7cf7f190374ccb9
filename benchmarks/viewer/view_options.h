#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/scene/sweep.h"

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
    // Called on the drawing thread with each order before any work, for tests that delay it; may be
    // empty.
    std::function<void()> before_drawing{};
};

}  // namespace benchmarks::viewer
