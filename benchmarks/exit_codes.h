#pragma once

namespace benchmarks {

// What the program's exit status means. Verdicts keep off 1 and 2: make turns every failure into 2.
inline constexpr int kOk = 0;
inline constexpr int kInternalError = 1;
inline constexpr int kUsageError = 2;  // of the command line, or an invalid scene
inline constexpr int kCheckFailed = 3;  // a gated check of the physics or of doctor did not pass
inline constexpr int kRegressed = 10;  // something became slower
inline constexpr int kInconclusive = 11;  // nothing is known to be slower, but not all is known;
                                          // where --fail-on inconclusive asks for it
inline constexpr int kMismatch = 12;  // pictures or states differ
inline constexpr int kNoBaseline = 13;  // the baseline is missing or of something else
inline constexpr int kNothingRan = 14;  // every case was skipped, failed or filtered out
inline constexpr int kNoDevice = 77;  // no suitable Vulkan device
inline constexpr int kInterrupted = 130;  // Ctrl-C; what was done is saved

}  // namespace benchmarks
