#pragma once

#include "benchmarks/doctor/facts.h"
#include "benchmarks/measure.h"
#include "engine/device.h"

namespace benchmarks {

// Looks at everything: a second of the idle machine, then some seconds of the doctor's scene.
// Throws Interrupted where the hooks say so.
Facts gatherFacts(
    const engine::Device& device, engine::Validation validation, const MeasureHooks& hooks);

}  // namespace benchmarks
