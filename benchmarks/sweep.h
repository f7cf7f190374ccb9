#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/axis.h"
#include "benchmarks/scene.h"

namespace benchmarks {

inline constexpr std::size_t kMaximumCases = 100000;

// One combination of a sweep's values.
struct CaseSpec {
    std::string name;  // "thesis/guides:86/msaa:4", distinct; the scene's name if nothing is swept
    std::vector<AxisValue> axes;  // in the sweep's order
    hair::Settings settings;
};

// The cartesian product of the scene's axes in their written order, the last one fastest, without
// what the scene excludes. An override replaces the values of the axis with its pointer, in place,
// or adds an axis at the end. Throws engine::Error: an override that names no field, a value it
// does not take or a field that is tied to others ("-a: <pointer>: ..."), a field twice or inside
// another, more than kMaximumCases combinations or all of them excluded, a case that breaks a rule
// between fields ("<file>: <case>: <pointer>: ...").
std::vector<CaseSpec> expand(const Scene& scene, std::span<const Axis> overrides = {});

// The scene's resolved document with the values of a case: what the case's settings are read from.
Document caseDocument(const Scene& scene, std::span<const AxisValue> axes);

// Whether the ECMAScript regular expression is found in a name; an empty one is in all. A malformed
// one is an engine::Error.
std::function<bool(const std::string& name)> nameMatcher(const std::string& regex);

}  // namespace benchmarks
