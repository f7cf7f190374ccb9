#pragma once

#include <string>
#include <string_view>

namespace benchmarks {

// A setting's name as people read it: "Field of view" of "field_of_view".
std::string shownName(std::string_view name);

// The same as a search finds it: lower case, spaces for underscores.
std::string searchable(std::string_view text);

}  // namespace benchmarks
