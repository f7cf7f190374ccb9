#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "benchmarks/viewer/preferences.h"

// Layout elements of the window: panes, splitters, tabs, choice buttons, the status line.
namespace benchmarks::viewer {

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
