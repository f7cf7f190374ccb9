#pragma once

#include <string>

namespace benchmarks {

// A unit of the settings' tables as people read it, such as "m/s²"; empty for ratios and counts.
std::string shownUnit(const char* unit);

// How Dear ImGui is to write a number with its unit: `conversion` is one of printf's.
std::string numberFormat(const char* conversion, const char* unit);

// What a number changes by where it is dragged by a pixel.
double dragSpeed(double value, double minimum, double maximum);

}  // namespace benchmarks
