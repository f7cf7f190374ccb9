#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/json_fwd.h"

// JSON pointers (RFC 6901) into a document that holds every field.
namespace benchmarks {

// One token as it stands in a pointer: ~ and / are escaped, control characters are shown as '?' so
// that an error stays one line.
std::string escapedToken(std::string_view token);

// "/lod/level" -> {"lod", "level"}. Throws engine::Error if the text is no JSON pointer or is the
// whole document's ("").
std::vector<std::string> pointerTokens(std::string_view pointer);

// The value that the pointer names. An absent one is an engine::Error at the first token that is
// unknown.
Json& valueAt(Json& document, std::string_view pointer);

// Puts a value where the pointer leads, which must exist. An object is merged (RFC 7386) into the
// object that is there, so that members it does not name stay as they are.
void patch(Json& document, std::string_view pointer, const Json& value);

// The type with its article, for errors: "an array", "the string \"x\"", "3".
std::string described(const Json& value);

}  // namespace benchmarks
