#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/scene/json.h"

// Reports that are kept under a name, for comparison with later ones.
namespace benchmarks::report {

// Returns the path of the report that is kept under that name for that scene: NAME/SCENE.json in
// $HAIRBENCH_BASELINES or results/local/baselines. Throws engine::Error for a name that is not a
// plain file name.
std::filesystem::path baselineFile(const std::string& name, const std::string& scene);

// Keeps a copy of a written report, with all its samples, under that name and its scene's name.
// Does not copy the pictures.
void saveBaseline(const std::string& name, const std::filesystem::path& report);

// Returns the scene's name, under which the report is kept: "thesis" for "scenes/thesis.json".
// Throws engine::Error for a report without a scene.
std::string sceneNameOf(const scene::Json& report);

}  // namespace benchmarks::report
