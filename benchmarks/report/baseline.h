#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/scene/json.h"

// Reports that are kept under a name, to compare later ones with.
namespace benchmarks::report {

// Where the report of that name and scene is kept: $HAIRBENCH_BASELINES or
// results/local/baselines, then NAME/SCENE.json. A name that is no plain file name is an
// engine::Error.
std::filesystem::path baselineFile(const std::string& name, const std::string& scene);

// Keeps a copy of a written report, all samples in it, under that name and its scene's. The
// pictures stay where they are.
void saveBaseline(const std::string& name, const std::filesystem::path& report);

// "scenes/thesis.json" -> "thesis": what the report's scene is kept under. Throws engine::Error for
// a report that names none.
std::string sceneNameOf(const scene::Json& report);

}  // namespace benchmarks::report
