#pragma once

#include <string>

namespace benchmarks {

struct StatusText {
    std::string text;  // a message, or a hint
    enum class Tone { hint, message, problem } tone = Tone::hint;
    std::string device;
    std::string picture;  // its size and what else there is to say of it
};

// One line within the current window of Dear ImGui. What there is no room for is cut, and its
// tooltip has it whole.
void statusLine(const StatusText& status);

}  // namespace benchmarks
