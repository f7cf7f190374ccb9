#pragma once

#include <string>

namespace benchmarks {

// A regex of the times of the frame and of every pass: by the wall clock, CPU time, instructions.
inline constexpr const char* kEveryTime =
    R"(^(frame|pass\.[^.]+)(\.cpu)?\.time$|^(frame|pass\.[^.]+)\.instructions$)";

// "pass.strands.cpu.time" -> "strands"; empty for what is of no pass.
std::string passOf(const std::string& metric);

// A regex of the same quantity of the frame and of all passes: "pass.strands.cpu.time" ->
// "^(frame|pass\.[^.]+)\.cpu\.time$".
std::string sameOfAllPasses(const std::string& metric);

}  // namespace benchmarks
