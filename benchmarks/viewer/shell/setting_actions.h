#pragma once

#include <optional>

#include "benchmarks/viewer/shell/action.h"
#include "benchmarks/viewer/tools/orbit_camera.h"
#include "benchmarks/viewer/tools/picture_tools.h"
#include "hair/settings.h"

namespace benchmarks {

// The setting that an action switches on and off; null: it is no such action.
bool* switchOf(Action action, hair::Settings& settings);

// The tool that an action takes up.
std::optional<Tool> toolOf(Action action);

// The preset that an action looks from, which has its name; null: it is no such action.
const CameraPreset* presetOf(Action action);

}  // namespace benchmarks
