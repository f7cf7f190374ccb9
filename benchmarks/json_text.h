#pragma once

#include <string>
#include <string_view>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// Parses one JSON document. `name` is what the text is called in errors, usually its file:
//   scene.json:3:17: syntax error while parsing value - unexpected '}'; ...
//   scene.json: /strands/density: is there twice
// Stricter than JSON: a member written twice and nesting deeper than 64 are errors. No comments.
Json parseJson(std::string_view text, const std::string& name);

}  // namespace benchmarks
