#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Quantities for people.
namespace benchmarks {

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

}  // namespace benchmarks
