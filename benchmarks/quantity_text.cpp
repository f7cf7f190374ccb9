#include "benchmarks/quantity_text.h"

#include <array>
#include <cmath>
#include <sstream>

#include "benchmarks/table.h"

namespace benchmarks {

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

std::string sizeText(std::uint64_t bytes) {
    constexpr std::array<const char*, 4> kUnits{"bytes", "kB", "MB", "GB"};
    std::size_t unit = 0;
    double size = static_cast<double>(bytes);
    for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) size /= 1000.0;
    return (unit == 0 ? std::to_string(bytes) : shortNumber(size)) + ' ' + kUnits[unit];
}

}  // namespace benchmarks
