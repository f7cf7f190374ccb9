#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/scene/json.h"

// Axes of a sweep: the fields that it varies and their values.
namespace benchmarks::scene {

inline constexpr std::size_t kMostAxisValues = 10000;

// A field that a sweep varies, with those that change with it.
struct Axis {
    std::string pointer;  // JSON pointer of a field, such as /strands/density
    std::vector<Document> values;  // 64, "lines", [0,0,1]
    std::vector<Axis> tied{};  // as many values each; the i-th ones go together
};

// The value of one axis in one case.
struct AxisValue {
    std::string pointer;
    Document value;
};

// A value of the command line: JSON if it reads as such, otherwise a string.
Document parseValue(const std::string& text);

// "POINTER=V1,V2" of the command line. Commas inside brackets and quotes belong to the value:
// /camera/position=[0,0,1],[0,0,2] has two. Ranges stand for their values:
// /groom/guides=pow2:6:12,86. Throws engine::Error.
Axis parseAxis(std::string_view argument);

// The axis if its pointer names a field of `resolved` (a scene's document with every field) and
// each value is one that the field takes, each once; otherwise engine::Error "<JSON pointer>:
// <reason>". Values come back as the report echoes them: 64 for 64.0. An object is merged into the
// group it is for, so that one axis can vary several fields together.
Axis checkedAxis(const Axis& axis, const Json& resolved);

// A short, distinct name for each pointer: its last token, with tokens before it as far as it takes
// to tell two apart, or for an index: "density", "wind.strength", "position.2".
std::vector<std::string> axisLabels(const std::vector<std::string>& pointers);

// The value as names and tables show it: a string without its quotes.
std::string valueLabel(const Json& value);

// Cases in which each of these fields has one of the values of its axis.
using Exclusion = std::vector<Axis>;

struct SweepMember {
    std::vector<Axis> axes;
    std::vector<Exclusion> exclusions;
};

// A scene's "sweep", checked against a document with every field:
//   "/strands/density": [16, 64]       an axis
//   "zip": [{"/groom/guides": [10, 86], "/strands/density": [64, 16]}]
//                                      fields that change together: the first values of all, then
//                                      the second ones; each element of the list is one axis
//   "cases": [{"/render/msaa": 4}, {"/render/msaa": 1, "/strands/density": 64}]
//                                      the same by rows: one axis whose values are these; a field
//                                      that a row leaves out has the scene's value there
//   "exclude": [{"/render/msaa": [4, 8], "/strands/density": [64]}]
//                                      combinations that are left out: those for which all the
//                                      fields of an element have one of its values
// Throws engine::Error "<JSON pointer>: <reason>".
SweepMember readSweep(const Json& sweep, const Json& resolved);

}  // namespace benchmarks::scene
