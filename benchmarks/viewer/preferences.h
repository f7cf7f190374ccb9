#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/presenter.h"

struct ImGuiStyle;

// What the user wants of the window and what is kept of it: layout, theme and the file of
// preferences.
namespace benchmarks::viewer {

// ---- Layout -------------------------------------------------------------------------------------

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
    float width = 20.0f;  // in heights of a letter, so that it is right at any scale
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
    bool merged = false;  // the one column that has room has the panels of both
};

// The narrowest column whose widgets are whole, and the narrowest picture beside two columns, in
// heights of a letter.
inline constexpr float kNarrowestColumn = 18.0f;
inline constexpr float kNarrowestPicture = 22.0f;

// The layout of a window of this size whose menu ends at `top`; `letter` is the height of a letter.
// Columns give way to the picture, and where there is no room for two they become one.
Layout arrange(
    float width, float height, float top, float letter, const Column& left, const Column& right);

// ---- Theme --------------------------------------------------------------------------------------

enum class Theme { dark, light };

const char* themeName(Theme theme);

// Colours and sizes of widgets, for letters that are `scale` times as large as usual.
ImGuiStyle styleOf(Theme theme, float scale);

// ---- Preferences --------------------------------------------------------------------------------

// What the viewer remembers from one time to the next. Nothing that bears on a picture or a number
// of a scene is in it.
struct Preferences {
    Theme theme = Theme::dark;
    float zoom = 1.0f;  // scale of letters and widgets, over the screen's
    Column left{.width = 19.0f};
    Column right{.width = 19.0f};
    std::uint32_t width = 1600;  // the window's, in screen coordinates
    std::uint32_t height = 900;
    engine::PresentMode present_mode = engine::PresentMode::fifo;
    std::vector<std::filesystem::path> recent;  // scenes, the last one first

    bool operator==(const Preferences&) const = default;
};

inline constexpr float kSmallestZoom = 0.5f;
inline constexpr float kLargestZoom = 4.0f;
inline constexpr std::size_t kMostRecent = 10;

// $XDG_CONFIG_HOME/hairbench/viewer.json, else ~/.config/hairbench/viewer.json; none where neither
// folder is known.
std::optional<std::filesystem::path> usersPreferences();

// Preferences as JSON text, and read from it. What the text lacks, or has out of range, is as in
// Preferences{}; text that is no JSON object throws engine::Error.
std::string preferencesText(const Preferences& preferences);
Preferences readPreferences(const std::string& text);

// Puts a scene that was opened first among the recent ones.
void remember(Preferences& preferences, const std::filesystem::path& scene);

// The preferences and the file that they are kept in.
class PreferencesFile {
public:
    // With an empty path nothing is read or written. A file that can't be read becomes problem(),
    // and the preferences are Preferences{}.
    explicit PreferencesFile(const std::filesystem::path& path);

    Preferences now;

    // Writes the preferences where they have changed. The first failure becomes problem(), and
    // nothing is written from then on.
    void keep();

    // One line; empty: all is well.
    const std::string& problem() const { return problem_; }

private:
    std::filesystem::path path_;
    Preferences kept_;
    std::string problem_;
};

}  // namespace benchmarks::viewer
