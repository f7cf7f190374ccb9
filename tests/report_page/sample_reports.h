#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"

// Reports with known figures, for tests of pages.
namespace benchmarks::report {

// In the order of the sweep, which is sorted neither by number nor as text.
struct Known {
    int density;
    int msaa;
    double frame_ms;  // median of frame.time; the passes have 20, 70 and 10 % of it
};
inline constexpr Known kKnown[] = {
    {8, 1, 9.5}, {8, 4, 100.0}, {16, 1, 20.0}, {16, 4, 3.25}, {32, 1, 47.0}};
inline constexpr const char* kSkipReason = "the device has no 4-sample images";
inline constexpr const char* kWarning = "timestamps are not trusted";  // for the case 16, 1

// Returns kKnown's cases, each with 60 samples within 1 % of `slower` times the median, and the
// skipped case 32, 4.
Report knownReport(double slower = 1.0);

// Two back ends on 10, 100 and 1,000 guides with 64 strands each, and with 1 and 4 samples per
// pixel: `tessellation` follows kTessellationLaw and `software` kSoftwareLaw, with twice the time
// for 4 samples. FLIP of `software` is 0.01 to tessellation and 0.02 to 64 samples. Cases with 8
// samples are skipped because of kSkipReason.
struct KnownLaw {
    double factor;  // ms
    double exponent;  // of the strand count
};
inline constexpr KnownLaw kTessellationLaw{0.01, 1.1};
inline constexpr KnownLaw kSoftwareLaw{0.05, 0.8};
Report backendReport();

// One case with these axes: a frame takes 1 ms, and its strands 0.5 ms and 0.75 ms of CPU time.
Report oneCaseReport(const std::string& name, std::vector<scene::AxisValue> axes);

// Writes a report, and for each case that ran a picture of one colour, 4 x 2 px.
std::filesystem::path
writeWithPictures(Report report, const std::filesystem::path& file, unsigned char red);

}  // namespace benchmarks::report
