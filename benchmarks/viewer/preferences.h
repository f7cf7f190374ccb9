#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/presenter.h"

struct ImGuiStyle;

// Layout, theme and other preferences of the window, and the file that keeps them.

namespace benchmarks::viewer {

// ---- Layout -------------------------------------------------------------------------------------

// A part of the window, in Dear ImGui coordinates.
struct Box {
    float x = 0.0f;
    float y = 0.0f;
    float width = 0.0f;
    float height = 0.0f;

    float right() const { return x + width; }
    float bottom() const { return y + height; }
    bool empty() const { return width <= 0.0f || height <= 0.0f; }
};

// The user's choice for a column of panels beside the picture.
struct Column {
    float width = 20.0f;  // in letter heights, so that it suits any scale
    bool shown = true;

    bool operator==(const Column&) const = default;
};

// Places of the parts of a window. Boxes that are hidden or have no room are empty.
struct Layout {
    Box left;
    Box left_splitter;
    Box picture;
    Box right_splitter;
    Box right;
    Box play;
    Box status;
    bool merged = false;  // the single column has the panels of both
};

// The narrowest column with complete widgets, and the narrowest picture beside two columns, in
// letter heights.
inline constexpr float kNarrowestColumn = 18.0f;
inline constexpr float kNarrowestPicture = 22.0f;

// Returns the layout of a window of this size with a menu that ends at `top`; `em` is the
// height of a letter. The picture has priority over columns, and two columns without enough room
// become one.
Layout
arrange(float width, float height, float top, float em, const Column& left, const Column& right);

// ---- Theme --------------------------------------------------------------------------------------

enum class Theme { dark, light };

const char* themeName(Theme theme);

// Colours and sizes of widgets for letters of `scale` times the normal size.
ImGuiStyle styleOf(Theme theme, float scale);

// ---- Preferences --------------------------------------------------------------------------------

// Settings that the viewer remembers between sessions. None of them affects a scene's picture or
// numbers.
struct Preferences {
    Theme theme = Theme::dark;
    float zoom = 1.0f;  // scale of letters and widgets, relative to the screen's
    Column left{.width = 19.0f};
    Column right{.width = 19.0f};
    std::uint32_t width = 1600;  // of the window, in screen coordinates
    std::uint32_t height = 900;
    engine::PresentMode present_mode = engine::PresentMode::fifo;
    std::vector<std::filesystem::path> recent;  // scenes, the latest first

    bool operator==(const Preferences&) const = default;
};

inline constexpr float kSmallestZoom = 0.5f;
inline constexpr float kLargestZoom = 4.0f;
inline constexpr std::size_t kMostRecent = 10;

// Returns $XDG_CONFIG_HOME/hairbench/viewer.json or, without that variable,
// ~/.config/hairbench/viewer.json; nothing if neither folder is known.
std::optional<std::filesystem::path> usersPreferences();

// Convert preferences to and from JSON text. Missing or out-of-range values are as in
// Preferences{}. Text that is not a JSON object throws engine::Error.
std::string preferencesText(const Preferences& preferences);
Preferences readPreferences(const std::string& text);

// Moves an opened scene to the front of the recent ones.
void remember(Preferences& preferences, const std::filesystem::path& scene);

// The preferences and their file.
class PreferencesFile {
public:
    // With an empty path, reads and writes nothing. If the file cannot be read, sets problem() and
    // uses Preferences{}.
    explicit PreferencesFile(const std::filesystem::path& path);

    Preferences now;

    // Writes the preferences if they have changed. The first failure sets problem(), and later
    // calls write nothing.
    void keep();

    // One line; empty without a problem.
    const std::string& problem() const { return problem_; }

private:
    std::filesystem::path path_;
    Preferences kept_;
    std::string problem_;
};

// Layout elements of the window: panes, splitters, tabs, choice buttons, the status line.

// A press becomes a drag when the mouse has moved away from it by ImGuiIO::MouseDragThreshold.
// Until then it is a click, however unsteady the hand is, and moves nothing.

// Returns the mouse's movement since the window's last picture, px, if a button is down and drags;
// otherwise zero. The movement before a press, and the one that makes a drag of it, do not count.
glm::vec2 dragged();

// Returns the mouse's place, px in the window; the place of the left button's press if that is no
// drag.
glm::vec2 dragPoint();

// Appearance of a part of the window.
enum class Surface {
    panel,
    stage,  // behind the picture
    bar,  // like the menu
    splitter,
};

// A fixed part of the window with the widgets of `body`; does nothing for an empty box.
void pane(const char* name, const Box& box, Surface surface, const std::function<void()>& body);

// Splitters between columns and picture. Dragging them changes the columns' widths.
void splitters(const Layout& layout, Preferences& preferences);

// The panels of the columns.
enum class Tab { scene, files, timings, compare, shaders };

const char* tabName(Tab tab);

// Panels of each column, and of the single column of a narrow window.
std::span<const Tab> leftTabs();
std::span<const Tab> rightTabs();
std::span<const Tab> allTabs();

// The selected panel of each column in wide windows, and of the single column in narrow ones.
struct Tabs {
    Tab left = Tab::scene;
    Tab right = Tab::timings;
    Tab only = Tab::scene;

    // Selects a panel in its column and in the single column.
    void choose(Tab tab);
};

// Shows tab buttons within the current Dear ImGui window, in as many lines as needed. Returns
// whether the choice changed.
bool tabStrip(std::span<const Tab> tabs, Tab& chosen);

// One button of a group; the button of the chosen value looks pressed.
template <class Value>
struct Choice {
    const char* label;
    Value value;
    const char* help;
};

enum class Chosen { no, yes };

// Places the next item on the current line if a button `label` fits there, otherwise on the next
// line.
void sameLineIfItFits(const char* label);
bool choiceButton(const char* label, const char* help, Chosen chosen);

// Shows a button for each choice, in as many lines as needed, and sets `value` to that of a pressed
// button.
template <class Value>
void choiceButtons(std::span<const Choice<Value>> choices, Value& value) {
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const Choice<Value>& choice = choices[i];
        if (i > 0) sameLineIfItFits(choice.label);
        const Chosen chosen = choice.value == value ? Chosen::yes : Chosen::no;
        if (choiceButton(choice.label, choice.help, chosen)) value = choice.value;
    }
}

// Returns a text that fits into `room`, px: shortened, with "..." at its end, if it is longer.
std::string shortened(const std::string& text, float room);

struct StatusText {
    std::string text;  // a message, or a hint
    enum class Tone { hint, message, problem } tone = Tone::hint;
    std::string device;
    std::string picture;  // the picture's size, the frame, and other facts about it
};

// Shows one line within the current Dear ImGui window. Text that does not fit is shortened, and its
// tooltip has all of it.
void statusLine(const StatusText& status);

}  // namespace benchmarks::viewer
