#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "hair/settings.h"

// Rules between settings, and the JSON Schema of scene files.

namespace benchmarks::scene {

// Checks the rules between fields, which the tables cannot express, such as a near plane in front
// of the far plane. Throws engine::Error "<JSON pointer>: <reason>" for a broken rule.
void checkSettings(const hair::Settings& settings);

// The least and greatest number of steps that a frame advances by.
std::pair<std::uint32_t, std::uint32_t> stepsPerFrame(const hair::Settings& settings);

// Returns a warning if frames advance by unequal numbers of steps and are not interpolated, so that
// motion is uneven; otherwise empty.
std::string stepWarning(const hair::Settings& settings);

// Returns the JSON Schema (draft-07) of a scene file, from the tables of hair/settings.h: types,
// ranges, names, units, defaults. Ends with a newline; scenes/scene.schema.json is this text. It
// allows null for a member, because a scene with a base removes members by it.
std::string sceneSchema();

// Writes the page of documentation about every field of a scene.

// Returns Markdown from sceneSchema(): each field's pointer, values, unit, default and meaning,
// with the shortest scene in the folder `scenes` that sets it as an example. docs/fields.md is this
// text, and links are relative to it. Throws engine::Error for a scene that is not JSON.
std::string fieldReference(const std::filesystem::path& scenes);

}  // namespace benchmarks::scene
