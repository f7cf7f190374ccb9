#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hair {

// The bytes that base 64 text is of (RFC 4648, section 4), padded to whole groups of 4 characters;
// absent where it is no such text.
std::optional<std::string> decodeBase64(std::string_view text);

}  // namespace hair
