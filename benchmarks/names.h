#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace benchmarks {

// Insertions, deletions and substitutions that turn `a` into `b` (Levenshtein 1966), in bytes.
std::size_t editDistance(std::string_view a, std::string_view b);

// What to say of a name that is not among `known`, without its final stop:
//   unknown key (did you mean "density"?); known: backend, density
// `what` is the beginning, here "unknown key". The nearest name is suggested if it shares at least
// half.
std::string
unknownName(std::string_view what, std::string_view name, const std::vector<std::string>& known);

}  // namespace benchmarks
