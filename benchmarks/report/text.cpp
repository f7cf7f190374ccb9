#include "benchmarks/report/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <sstream>

#include "engine/error.h"

namespace benchmarks::report {
namespace {

// ---- Columns of a table -------------------------------------------------------------------------

std::string padded(const std::string& text, std::size_t width, bool right) {
    const std::string space(width - std::min(width, text.size()), ' ');
    return right ? space + text : text + space;
}

}  // namespace

namespace {

std::vector<std::size_t> widthsOf(const std::vector<Column>& columns) {
    std::vector<std::size_t> widths;
    for (const Column& column : columns) {
        widths.push_back(column.title.size());
        for (const std::string& cell : column.cells)
            widths.back() = std::max(widths.back(), cell.size());
    }
    return widths;
}

std::string
lineOf(const std::vector<Column>& columns, std::span<const std::size_t> widths, std::size_t row) {
    std::string text;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::string cell =
            engine::shownText(row == 0 ? columns[i].title : columns[i].cells[row - 1]);
        text += (i == 0 ? "" : "  ") + padded(cell, widths[i], columns[i].numeric);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + '\n';
}

}  // namespace

std::string columnsLine(const std::vector<Column>& columns, std::size_t row) {
    return lineOf(columns, widthsOf(columns), row);
}

std::string columnsText(const std::vector<Column>& columns) {
    const std::vector<std::size_t> widths = widthsOf(columns);
    const std::size_t rows = columns.empty() ? 0 : columns.front().cells.size();
    std::string text;
    for (std::size_t row = 0; row <= rows; ++row) text += lineOf(columns, widths, row);
    return text;
}

// ---- Quantities ---------------------------------------------------------------------------------

std::string shortNumber(double number) {
    const double size = std::abs(number);
    const bool small = size > 0.0 && size < 1e-4;
    int decimals = 0;
    if (size > 0.0 && size < 100.0)
        decimals = small ? 2 : 2 - static_cast<int>(std::floor(std::log10(size)));
    char text[64];
    std::snprintf(text, sizeof text, small ? "%.*e" : "%.*f", decimals, number);
    return text;
}

std::string countText(std::uint64_t count) {
    std::string text = std::to_string(count);
    for (std::size_t from_end = 3; from_end < text.size(); from_end += 4)
        text.insert(text.size() - from_end, 1, ',');
    return text;
}

std::string countText(std::uint64_t count, std::string_view what) {
    return countText(count) + ' ' + std::string(what) + (count == 1 ? "" : "s");
}

std::string plainNumber(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

LengthUnit readableUnit(double metres) {
    constexpr std::array<LengthUnit, 5> kUnits{
        {{"km", 1e3}, {"m", 1.0}, {"mm", 1e-3}, {"µm", 1e-6}, {"nm", 1e-9}}};
    if (metres == 0.0) return kUnits[1];
    for (const LengthUnit& unit : kUnits)
        if (std::abs(metres) >= unit.metres) return unit;
    return kUnits.back();
}

std::string lengthText(double metres) {
    const LengthUnit unit = readableUnit(metres);
    return shortNumber(metres / unit.metres) + ' ' + std::string(unit.symbol);
}

std::string shareText(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", share * 100.0);
    return text;
}

std::string sizeText(std::uint64_t bytes) {
    constexpr std::array<const char*, 4> kUnits{"bytes", "kB", "MB", "GB"};
    std::size_t unit = 0;
    double size = static_cast<double>(bytes);
    for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) size /= 1000.0;
    return (unit == 0 ? std::to_string(bytes) : shortNumber(size)) + ' ' + kUnits[unit];
}

}  // namespace benchmarks::report
