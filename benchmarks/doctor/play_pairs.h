#pragma once

#include "benchmarks/doctor/facts.h"
#include "benchmarks/measure.h"
#include "engine/device.h"

namespace benchmarks {

// Plays the doctor's scene. Throws Interrupted where the hooks say so.

// How the passes add up, and whether timestamps say what the CPU's clock does.
PassFacts examinePasses(const engine::Device& device, const MeasureHooks& hooks);

// Two cases of the same settings in turns, A B, B A, A B ..., so that a drift of the machine raises
// as many differences as it lowers: 12 pairs, of rounds that each play the same frames.
RepeatFacts examineRepeat(const engine::Device& device, const MeasureHooks& hooks);

}  // namespace benchmarks
