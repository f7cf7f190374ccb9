#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/scene/json.h"

// Numbers, quantities and tables for a terminal.
namespace benchmarks::report {

// A column of a table on a terminal.
struct Column {
    std::string title;
    bool numeric = true;  // aligned right
    std::vector<std::string> cells{};
};

// One line of the table, wide enough for the widest cell of each column: row 0 the titles, then the
// cells.
std::string columnsLine(const std::vector<Column>& columns, std::size_t row);

// All lines of the table, each as columnsLine() has it.
std::string columnsText(const std::vector<Column>& columns);

// Quantities for people.

// "1,600,000".
std::string countText(std::uint64_t count);

// "1 strand", "1,600,000 strands".
std::string countText(std::uint64_t count, std::string_view what);

// Six significant digits without zeros at the end: "0.01", "16", "1e-07".
std::string plainNumber(double number);

// A unit of length in which numbers of a certain size are easy to read: nm, µm, mm, m, km.
struct LengthUnit {
    std::string_view symbol;
    double metres;
};
LengthUnit readableUnit(double metres);

// "12.3 mm".
std::string lengthText(double metres);

// "1.2 MB", in powers of 1000.
std::string sizeText(std::uint64_t bytes);

// A report (reportJson) for a terminal: a line on the device and the scene, then a row per case:
// the axes that vary, FPS, the median of the frame and of every pass, strands, and how it went.
// What is not known is "-".
std::string table(const scene::Json& report);

// The same of a report's header (headerJson) and its cases, which are looked at one by one.
std::string table(const scene::Json& header, const EachCase& each_case);

// About three significant digits without an exponent: "1234", "123", "12.3", "1.23", "0.0123".
std::string shortNumber(double number);

}  // namespace benchmarks::report
