#include "benchmarks/axis_range.h"

#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "benchmarks/sweep.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

constexpr std::string_view kPowersOfTwo = "pow2:";
constexpr double kLargestExponent = 52.0;  // doubles, and with them JSON readers, count further

// Numbers between colons; nothing if a part is none.
std::optional<std::vector<double>> numbers(std::string_view text) {
    std::vector<double> found;
    for (bool more = true; more;) {
        const std::size_t colon = text.find(':');
        const std::string_view part = text.substr(0, colon);
        double number = 0.0;
        const auto [rest, error] = std::from_chars(part.data(), part.data() + part.size(), number);
        if (error != std::errc{} || rest != part.data() + part.size() || !std::isfinite(number))
            return std::nullopt;
        found.push_back(number);
        more = colon != std::string_view::npos;
        if (more) text.remove_prefix(colon + 1);
    }
    return found;
}

Json wholeIfItIs(double number) {
    const double limit = std::ldexp(1.0, static_cast<int>(kLargestExponent));
    if (number == std::trunc(number) && std::abs(number) <= limit)
        return static_cast<std::int64_t>(number);
    return number;
}

}  // namespace

std::optional<std::vector<Document>> rangeValues(std::string_view text) {
    const bool powers = text.starts_with(kPowersOfTwo);
    const auto parts = numbers(powers ? text.substr(kPowersOfTwo.size()) : text);
    if (!parts || parts->size() < 2 || parts->size() > 3) return std::nullopt;
    const double first = (*parts)[0];
    const double last = (*parts)[1];
    const double step = parts->size() == 3 ? (*parts)[2] : 1.0;
    if (step <= 0.0) throw engine::Error(std::string(text), "the step is not above 0");
    if (last < first) throw engine::Error(std::string(text), "ends before it begins");
    if (powers && (first < 0.0 || last > kLargestExponent || first != std::trunc(first) ||
                   step != std::trunc(step)))
        throw engine::Error(std::string(text), "exponents are whole numbers in [0, 52]");
    // 0:1:0.1 has eleven values, though 0.1 * 10 rounds.
    const double count = std::floor((last - first) / step * (1.0 + 1e-12)) + 1.0;
    if (count > static_cast<double>(kMaximumCases))
        throw engine::Error(
            std::string(text), "has more than " + std::to_string(kMaximumCases) + " values");
    std::vector<Document> values;
    for (double i = 0.0; i < count; ++i)
        values.emplace_back(wholeIfItIs(powers ? std::exp2(first + i * step) : first + i * step));
    return values;
}

}  // namespace benchmarks
