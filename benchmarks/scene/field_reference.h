#pragma once

#include <filesystem>
#include <string>

// The page of documentation that names every field of a scene.
namespace benchmarks::scene {

// Markdown, from sceneSchema(): of each field its pointer, values, unit, default, meaning, and the
// shortest scene of the folder `scenes` that sets it as an example. docs/fields.md is this text,
// and links are relative to that. Throws engine::Error for a scene that is no JSON.
std::string fieldReference(const std::filesystem::path& scenes);

}  // namespace benchmarks::scene
