#pragma once

#include <functional>
#include <string>

namespace benchmarks {

// How a setting's name and widget share a panel.
enum class FieldShape {
    beside,  // the name left of the widget, or above it where the name is long
    below,   // always above: the widget needs the width
    check,   // the widget is a box, and its name is right of it
};

// What there is to say of a setting.
struct FieldText {
    std::string pointer;
    std::string name;  // as people read it
    std::string unit;  // that the widget has no room for; empty: none
    std::string help;
    std::string range;  // empty: none
};

enum class FieldMark { as_in_scene, changed };

// The line of a setting, or two of them, within the current window of Dear ImGui: its name and its
// widget, whose width is set and which is the last item that `widget` makes. A box has its name by
// itself. True where it is to be as it was.
bool fieldLine(
    const FieldText& text, FieldShape shape, FieldMark mark, const std::function<void()>& widget);

}  // namespace benchmarks
