#pragma once

#include <filesystem>
#include <string>

// Writes the page of documentation about every field of a scene.
namespace benchmarks::scene {

// Returns Markdown from sceneSchema(): each field's pointer, values, unit, default and meaning,
// with the shortest scene in the folder `scenes` that sets it as an example. docs/fields.md is this
// text, and links are relative to it. Throws engine::Error for a scene that is not JSON.
std::string fieldReference(const std::filesystem::path& scenes);

}  // namespace benchmarks::scene
