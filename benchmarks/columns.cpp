#include "benchmarks/columns.h"

#include <algorithm>

namespace benchmarks {

namespace {

std::string padded(const std::string& text, std::size_t width, bool right) {
    const std::string space(width - std::min(width, text.size()), ' ');
    return right ? space + text : text + space;
}

}  // namespace

std::string columnsLine(const std::vector<Column>& columns, std::size_t row) {
    std::string text;
    for (const Column& column : columns) {
        std::size_t width = column.title.size();
        for (const std::string& cell : column.cells) width = std::max(width, cell.size());
        const std::string& cell = row == 0 ? column.title : column.cells[row - 1];
        text += (&column == &columns.front() ? "" : "  ") + padded(cell, width, column.numeric);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + '\n';
}

}  // namespace benchmarks
