#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

// Text from files, names and other programs, made safe for a terminal.
namespace engine {

// Returns the text as one line without effects on a terminal. Control characters, invisible
// characters, characters that change the writing direction and invalid UTF-8 become '?'; line
// breaks and tabs become spaces. If the result is longer than `longest` bytes, " [...] " replaces
// its middle.
std::string
shownText(std::string_view text, std::size_t longest = std::numeric_limits<std::size_t>::max());

}  // namespace engine
