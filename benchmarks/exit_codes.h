#pragma once

namespace benchmarks {

// What the program's exit status means.
inline constexpr int kOk = 0;
inline constexpr int kInternalError = 1;
inline constexpr int kUsageError = 2;  // of the command line, or an invalid scene
inline constexpr int kCheckFailed = 3;  // a gated check of the physics did not pass
inline constexpr int kNothingRan = 14;  // every case was skipped, failed or filtered out
inline constexpr int kNoDevice = 77;    // no suitable Vulkan device
inline constexpr int kInterrupted = 130;  // Ctrl-C; what was done is saved

}  // namespace benchmarks
