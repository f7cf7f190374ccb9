#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "benchmarks/viewer/preferences.h"

// What the window is laid out with: panes, splitters, tabs, buttons to choose from, the status
// line.
namespace benchmarks::viewer {

// What a part of the window looks like.
enum class Surface {
    panel,
    stage,  // behind the picture
    bar,    // as the menu
    splitter,
};

// A fixed part of the window, with what `body` shows in it; nothing for an empty box.
void pane(const char* name, const Box& box, Surface surface, const std::function<void()>& body);

// The bars between columns and picture: what is dragged of them changes the columns' widths.
void splitters(const Layout& layout, Preferences& preferences);

// The panels that columns have.
enum class Tab { scene, files, timings, compare, shaders };

const char* tabName(Tab tab);

// The panels of each column, and those of the one column of a narrow window.
std::span<const Tab> leftTabs();
std::span<const Tab> rightTabs();
std::span<const Tab> allTabs();

// Which panel each column shows, in wide windows and in those with one column.
struct Tabs {
    Tab left = Tab::scene;
    Tab right = Tab::timings;
    Tab only = Tab::scene;

    // Brings a panel to the front, wherever it is.
    void choose(Tab tab);
};

// The names of tabs to choose from, within the current window of Dear ImGui, in as many lines as it
// takes. True where another tab was chosen.
bool tabStrip(std::span<const Tab> tabs, Tab& chosen);

// A button of a group in which one looks pressed: the value that is chosen.
template <class Value>
struct Choice {
    const char* label;
    Value value;
    const char* help;
};

enum class Chosen { no, yes };

// Puts the next item on the line of the last one where it has room for a button `label`, else on
// the next line.
void sameLineIfItFits(const char* label);
bool choiceButton(const char* label, const char* help, Chosen chosen);

// Shows a button for each choice, in one line or as many as they take, and sets `value` to the one
// that is pressed.
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
    std::string picture;  // the picture's size, the frame and what else there is to say of it
};

// One line within the current window of Dear ImGui. What there is no room for is cut, and its
// tooltip has it whole.
void statusLine(const StatusText& status);

}  // namespace benchmarks::viewer
