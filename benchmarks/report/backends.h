#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/report/statistics.h"
#include "benchmarks/scene/json.h"

// Strand back ends of one report held against each other: how their cost grows with the strands,
// and how it compares with that of `tessellation`.
namespace benchmarks::report {

inline constexpr const char* kBackendAxis = "/strands/backend";

// ms, of the passes points and strands: strands.time, or where the report lacks it the sum of the
// two passes' medians, of which no interval is known.
struct BackendTime {
    double median;
    std::optional<double> lower;  // of the median's interval
    std::optional<double> upper;
    double confidence = 0.0;
};

struct BackendPoint {
    std::string name;  // the case's
    double strands;  // drawn
    BackendTime time;
};

// The measured cases of a back end that differ in how many strands there are: in /groom,
// /strands/density and /lod alone.
struct BackendLine {
    std::string backend;
    std::vector<std::pair<std::string, scene::Document>> held;  // the other axes and their values
    std::vector<BackendPoint> points;  // by strands
    // Time over strands, at the level 0.05; absent of fewer than two numbers of strands.
    std::optional<PowerLaw> law;
};

// A case's time over that of the case that differs in the back end alone, `tessellation`.
struct BackendRatio {
    std::string name;  // the case's
    double ratio;
    // Of the two medians' intervals, so that it holds with the sum of their confidences less 1.
    std::optional<double> lower;
    std::optional<double> upper;
    double confidence = 0.0;
};

struct BackendFigures {
    std::vector<BackendLine> lines;  // in the report's order
    std::vector<BackendRatio> ratios;
};

// Absent where the report has fewer than two back ends. Thrown by nlohmann: what is no report.
std::optional<BackendFigures> compareBackends(const scene::Json& report);

scene::Json backendsJson(const BackendFigures& figures);

}  // namespace benchmarks::report
