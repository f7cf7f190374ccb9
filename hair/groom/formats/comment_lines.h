#pragma once

#include <string>
#include <string_view>

namespace hair {

// The comment as lines of a text file, each after `keyword`; nothing for an empty comment.
// Carriage returns, which belong to a line's end, are left out.
std::string commentLines(std::string_view comment, std::string_view keyword);

}  // namespace hair
