#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/presenter.h"

namespace benchmarks::viewer {

// A part of the window, in Dear ImGui's coordinates.
struct Box {
    float x = 0.0f;
    float y = 0.0f;
    float width = 0.0f;
    float height = 0.0f;

    float right() const { return x + width; }
    float bottom() const { return y + height; }
    bool empty() const { return width <= 0.0f || height <= 0.0f; }
};

// A column of panels beside the picture, as the user wants it.
struct Column {
    float width = 20.0f;  // heights of a letter, so that it is right at any scale
    bool shown = true;

    bool operator==(const Column&) const = default;
};

// What is where in a window. Boxes that there is no room for, or that are not wanted, are empty.
struct Layout {
    Box left;
    Box left_splitter;
    Box picture;
    Box right_splitter;
    Box right;
    Box play;
    Box status;
    bool merged = false;  // there is room for one column: it has the panels of both
};

// The narrowest column whose widgets are whole, and the picture beside two of them, heights of a
// letter.
inline constexpr float kNarrowestColumn = 18.0f;
inline constexpr float kNarrowestPicture = 22.0f;

// Of a window of this size whose menu ends at `top`; `letter` is the height of a letter. Columns
// give way to the picture, and where there is no room for two they become one.
Layout arrange(
    float width, float height, float top, float letter, const Column& left, const Column& right);

}  // namespace benchmarks::viewer

struct ImGuiStyle;

namespace benchmarks::viewer {

enum class Theme { dark, light };

const char* themeName(Theme theme);

// Colours and sizes of widgets, for letters that are `scale` times as large as usual.
ImGuiStyle styleOf(Theme theme, float scale);

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

// The preferences and the file that they are kept in.
class PreferencesFile {
public:
    // An empty path: nothing is read or written. What can't be read becomes problem(), and the
    // preferences are those of a first time.
    explicit PreferencesFile(const std::filesystem::path& path);

    Preferences now;

    // Writes them where they have changed. After the first time that this fails, which becomes
    // problem(), never again.
    void keep();

    // One line; empty: all is well.
    const std::string& problem() const { return problem_; }

private:
    std::filesystem::path path_;
    Preferences kept_;
    std::string problem_;
};

// Scenes that were open before, within the current window of Dear ImGui; the one that was chosen.
std::optional<std::filesystem::path> recentScenes(std::span<const std::filesystem::path> scenes);

}  // namespace benchmarks::viewer
