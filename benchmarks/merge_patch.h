#pragma once

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// Applies a scene's document to its base's, as JSON merge patch (RFC 7386): objects are merged,
// null removes, anything else replaces. Stricter in one thing: a null for a member that neither
// `target` nor `known` (every member there can be) has is an engine::Error "<JSON pointer>:
// <reason>", because a misspelt removal would silently remove nothing.
void mergePatch(Json& target, const Json& patch, const Json& known);

}  // namespace benchmarks
