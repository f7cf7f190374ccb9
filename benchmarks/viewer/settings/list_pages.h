#pragma once

#include <cstddef>

namespace benchmarks {

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

}  // namespace benchmarks
