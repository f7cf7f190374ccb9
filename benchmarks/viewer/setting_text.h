#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// How the settings panel writes names, numbers and units, and turns pages of long lists.
namespace benchmarks::viewer {

// Elements [first, last) of a list.
struct ElementRange {
    std::size_t first = 0;
    std::size_t last = 0;
};

// The elements of a page. Pages count from 0; a page past the end is the last one.
ElementRange elementsOf(std::size_t page, std::size_t count);

// The elements of the page that the user turned to, in a list of `count`. Where there are several
// pages, shows buttons that turn them, within the current window and ID of Dear ImGui.
ElementRange turnPages(std::size_t count);

// A setting's name as people read it: "Field of view" of "field_of_view".
std::string shownName(std::string_view name);

// Text as a search compares it: lower case, spaces for underscores.
std::string searchable(std::string_view text);

// A unit of the settings' tables as people read it, such as "m/s²"; empty for ratios and counts.
std::string shownUnit(const char* unit);

// The format with which Dear ImGui writes a number and its unit; `conversion` is one of printf's.
std::string numberFormat(const char* conversion, const char* unit);

// By how much a number changes when it is dragged by a pixel.
double dragSpeed(double value, double minimum, double maximum);

// A line of text of any length within the current window of Dear ImGui; true where it was changed.
// `hint` stands in an empty field.
bool textInput(const char* label, std::string& text, const char* hint = "");

}  // namespace benchmarks::viewer
