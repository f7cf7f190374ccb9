#include "benchmarks/names.h"

#include <algorithm>
#include <numeric>

namespace benchmarks {

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);  // row[j]: from the read part of a to b[0, j)
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i] == b[j] ? 0u : 1u);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substituted, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

std::string
unknownName(std::string_view what, std::string_view name, const std::vector<std::string>& known) {
    std::string text(what);
    const auto distance = [&](const std::string& other) { return editDistance(name, other); };
    const auto nearest = std::ranges::min_element(known, {}, distance);
    if (nearest != known.end() && 2 * distance(*nearest) <= std::max(name.size(), nearest->size()))
        text += " (did you mean \"" + *nearest + "\"?)";
    text += "; known: ";
    for (const std::string& other : known) text += (&other == &known.front() ? "" : ", ") + other;
    return text;
}

}  // namespace benchmarks
