#pragma once

namespace benchmarks {

// A window of Dear ImGui with the keys and the mouse's buttons, over everything else while `open`;
// Escape closes it.
void helpPanel(bool& open);

}  // namespace benchmarks
