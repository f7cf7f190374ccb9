#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/picture_area.h"
#include "hair/settings.h"

// The panels of settings: every parameter as a widget, and the comparison of two settings.
namespace benchmarks::viewer {

// ---- Every parameter ----------------------------------------------------------------------------

// Elements [first, last) of a list.
struct ElementRange {
    std::size_t first = 0;
    std::size_t last = 0;
};

// The elements of a page. Pages count from 0; a page past the end is the last one.
ElementRange elementsOf(std::size_t page, std::size_t count);

// Returns the elements of the current page of a list of `count`. With several pages, shows buttons
// to turn them, within Dear ImGui's current window and ID.
ElementRange turnPages(std::size_t count);

// Returns a setting's readable name: "Field of view" for "field_of_view".
std::string shownName(std::string_view name);

// Returns text in its form for searches: lower case, spaces for underscores.
std::string searchable(std::string_view text);

// Returns a unit of the settings' tables in readable form, such as "m/s²"; empty for ratios and
// counts.
std::string shownUnit(const char* unit);

// Returns Dear ImGui's format for a number and its unit; `conversion` is one of printf's.
std::string numberFormat(const char* conversion, const char* unit);

// Returns the change of a number per pixel of a drag.
double dragSpeed(double value, double minimum, double maximum);

// A text field of any length within the current Dear ImGui window. Returns whether the text
// changed. `hint` stands in an empty field.
bool textInput(const char* label, std::string& text, const char* hint = "");

// Shows every parameter as a widget, from the tables of hair/settings.h, within the current Dear
// ImGui window. Shows fields with `search` in their pointer or help, or all if it is empty. Marks
// fields that differ from `original`; they can be reset.
Edit settingsPanel(
    hair::Settings& settings, const hair::Settings& original, const std::string& search);

// ---- Comparison ---------------------------------------------------------------------------------

// The user's request about the two sides.
enum class CompareWish {
    nothing,
    start,  // start a second side, equal to the first
    stop,  // show only a
    swap,
    copy_a_to_b,  // give b the settings of a
};

class ComparePanel {
public:
    int edited = 0;  // the side that the settings panel edits; 0: a, 1: b
    bool same_camera = true;  // mouse and keys move both cameras

    // Shows the panel within the current Dear ImGui window. `b` is null while nothing is compared.
    CompareWish show(PictureArea& area, const hair::Settings& a, const hair::Settings* b);
};

// A field with different values in two settings.
struct SettingDifference {
    std::string pointer;  // JSON pointer: /strands/density
    std::string a;  // JSON on one line; empty if a lacks the field
    std::string b;

    bool operator==(const SettingDifference&) const = default;
};

// Returns the fields that differ, in the order of scene files. A vector counts as one value;
// elements of a list are compared one by one.
std::vector<SettingDifference>
settingsDifferences(const hair::Settings& a, const hair::Settings& b);

}  // namespace benchmarks::viewer
