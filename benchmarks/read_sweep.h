#pragma once

#include <vector>

#include "benchmarks/axis.h"
#include "benchmarks/json_fwd.h"

namespace benchmarks {

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

}  // namespace benchmarks
