#pragma once

#include <string>
#include <string_view>

namespace hair {

// Whether text is UTF-8, without surrogates and needlessly long forms (RFC 3629).
bool isUtf8(std::string_view text);

// Latin-1 as UTF-8: what files with an 8-bit text of no stated encoding mostly mean.
std::string utf8FromLatin1(std::string_view text);

}  // namespace hair
