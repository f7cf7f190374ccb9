#pragma once

#include <string>

#include "benchmarks/scene.h"

namespace benchmarks {

// What follows `hairbench run SCENE` on a command line to play these settings and nothing else:
// "-a /strands/density=16 …", quoted for a POSIX shell. Axes of the scene's sweep get the one value
// that the settings have. What would make a case's name long, lists and the description, is a
// --set, and so is a list in which the sweep varies something. Empty where there is nothing to say.
// `scene` is as it is on disk. Throws engine::Error "<file>: <reason>" where a command line can't
// say it: axes that are tied to each other, a combination that the sweep excludes, settings that
// break a rule.
std::string caseArguments(const Scene& scene, const hair::Settings& settings);

}  // namespace benchmarks
