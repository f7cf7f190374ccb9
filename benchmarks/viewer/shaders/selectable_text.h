#pragma once

#include <string>

#include <imgui.h>

namespace benchmarks {

// Text in lines as wide as the window, of which parts can be selected and copied.
void selectableText(const char* id, const std::string& text, const ImVec4& color);

}  // namespace benchmarks
