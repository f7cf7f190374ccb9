#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/viewer/shell/layout.h"
#include "benchmarks/viewer/shell/theme.h"
#include "engine/swapchain.h"

namespace benchmarks {

// What the viewer remembers from one time to the next. Nothing that bears on a picture or a number
// of a scene is in it.
struct Preferences {
    Theme theme = Theme::dark;
    float zoom = 1.0f;  // of letters and widgets, over the screen's
    Column left{.width = 19.0f};
    Column right{.width = 19.0f};
    std::uint32_t width = 1600;  // of the window, screen coordinates
    std::uint32_t height = 900;
    engine::PresentMode present_mode = engine::PresentMode::fifo;
    std::vector<std::filesystem::path> recent;  // scenes, the last one first

    bool operator==(const Preferences&) const = default;
};

inline constexpr float kSmallestZoom = 0.5f;
inline constexpr float kLargestZoom = 4.0f;
inline constexpr std::size_t kMostRecent = 10;

// $XDG_CONFIG_HOME/hairbench/viewer.json, or in ~/.config; none where neither is known.
std::optional<std::filesystem::path> usersPreferences();

// JSON text and back. What a text lacks, or has out of range, is as in Preferences{}; one that is
// no JSON throws engine::Error.
std::string preferencesText(const Preferences& preferences);
Preferences readPreferences(const std::string& text);

// A scene was opened.
void remember(Preferences& preferences, const std::filesystem::path& scene);

}  // namespace benchmarks
