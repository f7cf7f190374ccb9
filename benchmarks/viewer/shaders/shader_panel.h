#pragma once

#include "benchmarks/viewer/shaders/shader_reload.h"

namespace benchmarks {

// What was reloaded and what the compiler says, within the current window of Dear ImGui.
void shaderPanel(const ShaderReload& reload);

}  // namespace benchmarks
