#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace benchmarks::viewer {

// Elements [first, last) of a list.
struct ElementRange {
    std::size_t first = 0;
    std::size_t last = 0;
};

// Those of a page: pages count from 0, and one that is past the end is the last.
ElementRange elementsOf(std::size_t page, std::size_t count);

// Those that the user turned to, of a list of `count`; where it has several pages, buttons to turn
// them, within the current window and ID of Dear ImGui.
ElementRange turnPages(std::size_t count);

// A setting's name as people read it: "Field of view" of "field_of_view".
std::string shownName(std::string_view name);

// The same as a search finds it: lower case, spaces for underscores.
std::string searchable(std::string_view text);

// A unit of the settings' tables as people read it, such as "m/s²"; empty for ratios and counts.
std::string shownUnit(const char* unit);

// How Dear ImGui is to write a number with its unit: `conversion` is one of printf's.
std::string numberFormat(const char* conversion, const char* unit);

// What a number changes by where it is dragged by a pixel.
double dragSpeed(double value, double minimum, double maximum);

// A line of text of any length within the current window of Dear ImGui; true where it was changed.
// `hint` stands in an empty one.
bool textInput(const char* label, std::string& text, const char* hint = "");

}  // namespace benchmarks::viewer
