#pragma once

#include <string>
#include <vector>

#include "engine/ui.h"

// Faults in the layout of the last picture of Dear ImGui's current context.
namespace benchmarks::viewer {

// What can't be read, one line each: letters
// that are cut off at the left or right, labels that are wider than their widgets, contents that
// are wider than a window or column that does not scroll sideways, or higher than one that does not
// scroll at all. A field for text scrolls.
std::vector<std::string> clippedText(const engine::UiItems& items);

// What can't be reached, one line each: panels that leave the window or lie on one another, and
// widgets outside of panels that don't scroll. Popups may lie on panels.
std::vector<std::string> outsideItems(const engine::UiItems& items);

}  // namespace benchmarks::viewer
