#pragma once

#include <string>
#include <vector>

#include "engine/ui.h"

// Faults in the layout of the last picture of Dear ImGui's current context.
namespace benchmarks::viewer {

// Returns unreadable parts, one per line: letters that are cut off at the left or right, labels
// wider than their widgets, contents wider than a window or column without horizontal scrolling, or
// taller than one without any scrolling. Text fields scroll.
std::vector<std::string> clippedText(const engine::UiItems& items);

// Returns unreachable parts, one per line: panels outside the window or overlapping others, and
// widgets outside panels that do not scroll. Popups may overlap panels.
std::vector<std::string> outsideItems(const engine::UiItems& items);

}  // namespace benchmarks::viewer
