#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Numbers, quantities and tables for a terminal.
namespace benchmarks::report {

// A column of a table on a terminal.
struct Column {
    std::string title;
    bool numeric = true;  // aligned right
    std::vector<std::string> cells{};
};

// Returns one line of the table: row 0 has the titles, the next rows the cells. Each column is as
// wide as its widest cell.
std::string columnsLine(const std::vector<Column>& columns, std::size_t row);

// Returns all lines of the table, as from columnsLine().
std::string columnsText(const std::vector<Column>& columns);

// Quantities in readable form.

// "1,600,000".
std::string countText(std::uint64_t count);

// "1 strand", "1,600,000 strands".
std::string countText(std::uint64_t count, std::string_view what);

// Six significant digits without zeros at the end: "0.01", "16", "1e-07".
std::string plainNumber(double number);

// A unit of length that makes numbers of a certain size easy to read: nm, µm, mm, m, km.
struct LengthUnit {
    std::string_view symbol;
    double metres;
};
LengthUnit readableUnit(double metres);

// "12.3 mm".
std::string lengthText(double metres);

// "1.2 MB", in powers of 1000.
std::string sizeText(std::uint64_t bytes);

// "12.3 %" for a share of 0.123.
std::string shareText(double share);

// About three significant digits, without an exponent from 0.0001 on: "1234", "12.3", "0.0123",
// "2.35e-09".
std::string shortNumber(double number);

}  // namespace benchmarks::report
