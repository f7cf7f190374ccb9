#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/scene/json.h"
#include "hair/settings.h"

// Axes of a sweep: the fields that it varies and their values.
namespace benchmarks::scene {

inline constexpr std::size_t kMostAxisValues = 10000;
inline constexpr std::size_t kMaximumCases = 100000;  // of a sweep, and values of a range

// A field that a sweep varies, and the fields tied to it.
struct Axis {
    std::string pointer;  // JSON pointer of a field, such as /strands/density
    std::vector<Document> values;  // 64, "lines", [0,0,1]
    std::vector<Axis> tied{};  // each with the same number of values; the i-th values of all belong
                               // together
};

// The value of one axis in one case.
struct AxisValue {
    std::string pointer;
    Document value;
};

// Returns a command-line value: parsed JSON if it is valid, otherwise a string.
Document parseValue(const std::string& text);

// Parses "POINTER=V1,V2" from the command line. Commas inside brackets and quotes belong to the
// value: /camera/position=[0,0,1],[0,0,2] has two values. A range stands for its values:
// /groom/guides=pow2:6:12,86. Throws engine::Error.
Axis parseAxis(std::string_view argument);

// Returns the checked axis. Its pointer must name a field of the settings, and each value must be
// valid for the field and occur once. Otherwise throws engine::Error "<JSON pointer>: <reason>".
// Returns values as reports have them: 64 for 64.0. A value that is an object is merged into its
// group, so that one axis can vary several fields together.
Axis checkedAxis(const Axis& axis, const hair::Settings& settings);

// Returns a short unique name for each pointer: its last token, with as many earlier tokens as it
// takes to tell two apart, and at least one for an index: "density", "wind.strength", "position.2".
std::vector<std::string> axisLabels(const std::vector<std::string>& pointers);

// Returns the value as names and tables show it: a string without its quotes.
std::string valueLabel(const Json& value);

// Excluded cases: those in which each of these fields has one of its listed values.
using Exclusion = std::vector<Axis>;

struct SweepMember {
    std::vector<Axis> axes;
    std::vector<Exclusion> exclusions;
};

// Reads a scene's "sweep" and checks it against the scene's settings:
//   "/strands/density": [16, 64]       an axis
//   "zip": [{"/groom/guides": [10, 86], "/strands/density": [64, 16]}]
//                                      fields that change together: the first values of all, then
//                                      the second ones; each element of the list is one axis
//   "cases": [{"/render/msaa": 4}, {"/render/msaa": 1, "/strands/density": 64}]
//                                      the same by rows: one axis with these values; a field
//                                      that a row leaves out has the scene's value there
//   "exclude": [{"/render/msaa": [4, 8], "/strands/density": [64]}]
//                                      combinations to leave out: those in which every field of an
//                                      element has one of its values
// Throws engine::Error "<JSON pointer>: <reason>".
SweepMember readSweep(const Json& sweep, const hair::Settings& settings);

}  // namespace benchmarks::scene
