#pragma once

#include <cstdint>

#include "benchmarks/viewer/play/play_state.h"

namespace benchmarks {

// Pause, single step, restart, speed and seek, in one line within the current window of Dear ImGui.
// `time`: simulated s.
void playPanel(PlayState& state, std::uint32_t frame, double time);

}  // namespace benchmarks
