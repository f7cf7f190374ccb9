#pragma once

#include <functional>

#include "benchmarks/viewer/shell/layout.h"
#include "benchmarks/viewer/shell/preferences.h"

namespace benchmarks {

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

}  // namespace benchmarks
