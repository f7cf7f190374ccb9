#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <imgui.h>

namespace benchmarks {

// A line through values that are not negative, from 0 at the bottom to their maximum, as an item of
// Dear ImGui. The index of the value that the mouse is at.
std::optional<std::size_t>
sparkline(const char* id, std::span<const double> values, ImVec2 size, ImU32 color);

}  // namespace benchmarks
