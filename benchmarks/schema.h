#pragma once

#include <string>

namespace benchmarks {

// JSON Schema (draft-07) of a scene file, from the tables of hair/settings.h: types, ranges, names,
// units, defaults. Ends with a newline; scenes/scene.schema.json is this text. null is allowed for
// a member because a scene with a base takes members away by it.
std::string sceneSchema();

}  // namespace benchmarks
