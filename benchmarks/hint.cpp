#include "benchmarks/hint.h"

namespace benchmarks {

std::string hintOf(const std::string& name, const std::string& unit) {
    // One waits longer where others are faster.
    if (name == "frame.overlap" || name.ends_with(".wait.time")) return {};
    if (unit == "B" || unit == "ms" || name.ends_with(".instructions") || name == "image.rmse" ||
        name == "image.flip")
        return "lower";
    if (unit == "1/s" || unit == "dB" || name == "image.ssim") return "higher";
    return {};
}

}  // namespace benchmarks
