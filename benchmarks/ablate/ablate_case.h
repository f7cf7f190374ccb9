#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "benchmarks/ablate/ablation.h"
#include "benchmarks/sweep.h"
#include "engine/device.h"

namespace benchmarks {

// Plays a case to the last frame that `run` measures of it and draws its hair, which then stands
// still, `laps` times up and down the ladder. What the device or the case can't do is in the
// result. Throws Interrupted where the user stopped the program; `result` then has the laps that
// were done.
void ablateCase(
    const engine::Device& device, const CaseSpec& spec, const std::filesystem::path& directory,
    std::uint32_t laps, const std::function<void(const std::string&)>& progress,
    CaseAblation& result);

}  // namespace benchmarks
