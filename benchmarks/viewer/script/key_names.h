#pragma once

#include <string>

namespace benchmarks {

// "ctrl+shift+z", "f12", "space", "?": an ImGuiKeyChord. Names are Dear ImGui's (ImGui::GetKeyName)
// in any case, and the signs that are on keys. Throws engine::Error "<pointer>: ...".
int keyChord(const std::string& text, const std::string& pointer);

}  // namespace benchmarks
