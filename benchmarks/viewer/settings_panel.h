#pragma once

#include <string>

#include "benchmarks/viewer/edit.h"
#include "hair/settings.h"

namespace benchmarks::viewer {

// Every parameter as a widget, made from the tables of hair/settings.h: within the current window
// of Dear ImGui. Fields whose pointer or help has `search` in it are shown, all for an empty one.
// Fields that differ from `original` are marked, and can be set back.
Edit settingsPanel(
    hair::Settings& settings, const hair::Settings& original, const std::string& search);

}  // namespace benchmarks::viewer
