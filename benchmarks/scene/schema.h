#pragma once

#include <string>

#include "hair/settings.h"

// Rules between settings, and the JSON Schema of scene files.
namespace benchmarks::scene {

// The rules between fields, which no table row can say, such as a near plane in front of the far
// plane. A broken one is an engine::Error "<JSON pointer>: <reason>".
void checkSettings(const hair::Settings& settings);

// JSON Schema (draft-07) of a scene file, from the tables of hair/settings.h: types, ranges, names,
// units, defaults. Ends with a newline; scenes/scene.schema.json is this text. null is allowed for
// a member because a scene with a base takes members away by it.
std::string sceneSchema();

}  // namespace benchmarks::scene
