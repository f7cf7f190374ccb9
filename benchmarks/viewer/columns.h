#pragma once

#include <functional>
#include <span>

#include "benchmarks/viewer/preferences.h"

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

// A panel in a column.
enum class Tab { scene, files, timings, compare, shaders };

const char* tabName(Tab tab);

// The columns' own, and all of them for one that has both's.
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

// Names to choose from within the current window of Dear ImGui, in as many lines as it takes; true
// where another one was.
bool tabStrip(std::span<const Tab> tabs, Tab& chosen);

}  // namespace benchmarks::viewer
