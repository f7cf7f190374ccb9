#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace benchmarks {

// A column of a table on a terminal.
struct Column {
    std::string title;
    bool numeric = true;  // aligned right
    std::vector<std::string> cells{};
};

// One line of the table, wide enough for the widest cell of each column: row 0 the titles, then the
// cells.
std::string columnsLine(const std::vector<Column>& columns, std::size_t row);

}  // namespace benchmarks
