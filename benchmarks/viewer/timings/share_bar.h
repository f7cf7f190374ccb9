#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <imgui.h>

namespace benchmarks {

// A color of its own for each of the first eight, on dark and on light.
ImU32 seriesColor(std::size_t index);

// A thin bar, as long as its share of the room that is left in a line or cell.
void shareBar(double share, ImU32 color);

struct Share {
    std::string name;
    double amount = 0.0;
    ImU32 color = 0;
};
// Shares of a whole in one bar across the window; each tells the mouse its name, amount and part.
void stackedBar(const char* id, std::span<const Share> shares, const char* unit);

}  // namespace benchmarks
