#pragma once

#include "benchmarks/viewer/timings/shown_side.h"

namespace benchmarks {

// How fast frames are, and how many are known. `compared` may be null.
void frameFigures(const ShownSide& side, const ShownSide* compared);

// What a frame takes of the CPU and of the device, and what overlap saves.
void splitFigures(const ShownSide& side, const ShownSide* compared);

}  // namespace benchmarks
