#include "benchmarks/sweep.h"

#include <algorithm>
#include <iterator>
#include <regex>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include "benchmarks/check_settings.h"
#include "benchmarks/pointer.h"
#include "benchmarks/read_settings.h"
#include "benchmarks/write_settings.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

using engine::Error;

// The pointers that change with the axis.
std::vector<std::string> fields(const Axis& axis) {
    std::vector<std::string> pointers{axis.pointer};
    for (const Axis& other : axis.tied) pointers.push_back(other.pointer);
    return pointers;
}

std::vector<Axis> withOverrides(const Scene& scene, std::span<const Axis> overrides) {
    std::vector<Axis> axes = scene.axes;
    for (const Axis& override_axis : overrides) {
        Axis axis;
        try {
            axis = checkedAxis(override_axis, scene.resolved.json());
        } catch (const Error& error) {
            throw Error("-a", error.what());
        }
        const auto place = std::ranges::find_if(
            axes, [&](const Axis& each) { return std::ranges::count(fields(each), axis.pointer); });
        if (place == axes.end())
            axes.push_back(std::move(axis));
        else if (place->tied.empty())
            *place = std::move(axis);
        else
            throw Error("-a", axis.pointer + ": the sweep ties it to other fields");
    }
    return axes;
}

// Every pointer of the sweep, each once and none inside another.
void requireIndependent(const std::vector<std::string>& pointers) {
    for (const std::string& outer : pointers) {
        if (std::ranges::count(pointers, outer) > 1) throw Error(outer, "is swept twice");
        for (const std::string& inner : pointers)
            if (inner.starts_with(outer + '/')) throw Error(inner, "is inside the axis " + outer);
    }
}

std::size_t caseCount(const std::vector<Axis>& axes) {
    std::size_t count = 1;
    for (const Axis& axis : axes) {
        count *= axis.values.size();
        if (count > kMaximumCases)
            throw Error("/sweep", "more than " + std::to_string(kMaximumCases) + " cases");
    }
    return count;
}

// The index-th combination: its axes count like digits, the last one fastest.
std::vector<AxisValue> combination(const std::vector<Axis>& axes, std::size_t index) {
    std::vector<std::size_t> digits(axes.size());
    for (std::size_t i = axes.size(); i-- > 0;) {
        digits[i] = index % axes[i].values.size();
        index /= axes[i].values.size();
    }
    std::vector<AxisValue> values;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        values.push_back({axes[i].pointer, axes[i].values[digits[i]]});
        for (const Axis& other : axes[i].tied)
            values.push_back({other.pointer, other.values[digits[i]]});
    }
    return values;
}

bool isExcluded(const hair::Settings& settings, const std::vector<Exclusion>& exclusions) {
    if (exclusions.empty()) return false;
    Json document = writeSettings(settings);
    const auto meets = [&](const Axis& condition) {
        const Document value(valueAt(document, condition.pointer));
        return std::ranges::count(condition.values, value) > 0;
    };
    return std::ranges::any_of(exclusions, [&](const Exclusion& exclusion) {
        return std::ranges::all_of(exclusion, meets);
    });
}

std::string caseName(
    const std::string& scene, const std::vector<std::string>& labels,
    const std::vector<AxisValue>& values) {
    std::string name = scene;
    for (std::size_t i = 0; i < values.size(); ++i)
        name += '/' + labels[i] + ':' + valueLabel(values[i].value.json());
    return name;
}

Json patched(const Scene& scene, std::span<const AxisValue> axes) {
    Json document = scene.resolved.json();
    for (const AxisValue& axis : axes) patch(document, axis.pointer, axis.value.json());
    return document;
}

}  // namespace

Document caseDocument(const Scene& scene, std::span<const AxisValue> axes) {
    return Document(patched(scene, axes));
}

std::vector<CaseSpec> expand(const Scene& scene, std::span<const Axis> overrides) {
    const std::vector<Axis> axes = withOverrides(scene, overrides);
    std::vector<std::string> pointers;
    for (const Axis& axis : axes) std::ranges::move(fields(axis), std::back_inserter(pointers));
    const std::vector<std::string> labels = axisLabels(pointers);
    std::vector<CaseSpec> cases;
    std::unordered_set<std::string> names;
    std::string context = scene.path.string();
    try {
        requireIndependent(pointers);
        const std::size_t count = caseCount(axes);
        for (std::size_t i = 0; i < count; ++i) {
            CaseSpec spec;
            spec.axes = combination(axes, i);
            spec.name = caseName(scene.name, labels, spec.axes);
            context = scene.path.string() + (axes.empty() ? "" : ": " + spec.name);
            spec.settings = axes.empty() ? scene.settings : readSettings(patched(scene, spec.axes));
            if (!axes.empty() && isExcluded(spec.settings, scene.exclusions)) continue;
            checkSettings(spec.settings);
            if (!names.insert(spec.name).second) throw Error("two cases have this name");
            cases.push_back(std::move(spec));
        }
        context = scene.path.string();
        if (cases.empty()) throw Error("/sweep/exclude", "leaves no case");
    } catch (const Error& error) {
        throw Error(context, error.what());
    }
    return cases;
}

std::function<bool(const std::string& name)> nameMatcher(const std::string& regex) {
    try {
        return [pattern = std::regex(regex, std::regex::ECMAScript)](const std::string& name) {
            return std::regex_search(name, pattern);
        };
    } catch (const std::regex_error& error) {
        throw Error("--filter " + regex, error.what());
    }
}

}  // namespace benchmarks
