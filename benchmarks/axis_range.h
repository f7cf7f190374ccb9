#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "benchmarks/json_text.h"

namespace benchmarks {

// The values that a range of the command line stands for, or nothing if the text is none:
//   pow2:6:12     64, 128 ... 4096; pow2:6:12:2 takes every second one
//   10:50:20      10, 30, 50; 10:12 has steps of 1. Steps begin at the first number, and the last
//                 value is the largest that is not above the second
// Throws engine::Error "<text>: <reason>" for one without values or with more than a sweep may
// have.
std::optional<std::vector<Document>> rangeValues(std::string_view text);

}  // namespace benchmarks
