#pragma once

#include <string>

namespace benchmarks {

// A line of text of any length within the current window of Dear ImGui; true where it was changed.
// `hint` stands in an empty one.
bool textInput(const char* label, std::string& text, const char* hint = "");

}  // namespace benchmarks
