#pragma once

#include <string>

#include "benchmarks/viewer/edit.h"
#include "hair/settings.h"

namespace benchmarks::viewer {

// Shows every parameter as a widget, from the tables of hair/settings.h, within the current Dear
// ImGui window. Shows fields with `search` in their pointer or help, or all if it is empty. Marks
// fields that differ from `original`; they can be reset.
Edit settingsPanel(
    hair::Settings& settings, const hair::Settings& original, const std::string& search);

}  // namespace benchmarks::viewer
