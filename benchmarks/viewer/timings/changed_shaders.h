#pragma once

#include "benchmarks/report.h"
#include "engine/device.h"

namespace benchmarks {

// Adds a warning where shaders are not those that the program was built with: a report of them is
// none of the build that it names.
void warnOfChangedShaders(const engine::Device& device, Trust& trust);

}  // namespace benchmarks
