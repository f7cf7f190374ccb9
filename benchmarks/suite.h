#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/scene.h"

namespace benchmarks {

// A suite is a file that names scenes, each relative to it: {"$schema": ..., "description": ...,
// "suite": ["thesis.json", "msaa.json"]}. Suites of suites are not.
bool isSuite(const std::filesystem::path& path);

// The scene, or all of a suite's in its order. Throws engine::Error: what loadScene() throws, a
// suite that names none or one twice, another member.
std::vector<Scene> loadScenes(const std::filesystem::path& path);

}  // namespace benchmarks
