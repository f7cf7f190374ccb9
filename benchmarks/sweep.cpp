#include "benchmarks/sweep.h"

#include <algorithm>
#include <regex>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include "benchmarks/check_settings.h"
#include "benchmarks/pointer.h"
#include "benchmarks/read_settings.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

using engine::Error;

std::vector<Axis>
withOverrides(const Scene& scene, const Json& resolved, std::span<const Axis> overrides) {
    std::vector<Axis> axes = scene.axes;
    for (const Axis& override_axis : overrides) {
        Axis axis;
        try {
            axis = checkedAxis(override_axis, resolved);
        } catch (const Error& error) {
            throw Error("-a", error.what());
        }
        const auto place = std::ranges::find(axes, axis.pointer, &Axis::pointer);
        if (place != axes.end())
            *place = std::move(axis);
        else
            axes.push_back(std::move(axis));
    }
    return axes;
}

void requireIndependent(const std::vector<Axis>& axes) {
    for (const Axis& outer : axes)
        for (const Axis& inner : axes)
            if (inner.pointer.starts_with(outer.pointer + '/'))
                throw Error(inner.pointer, "is inside the axis " + outer.pointer);
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
    std::vector<AxisValue> values(axes.size());
    for (std::size_t i = axes.size(); i-- > 0;) {
        const std::size_t size = axes[i].values.size();
        values[i] = {axes[i].pointer, axes[i].values[index % size]};
        index /= size;
    }
    return values;
}

std::string caseName(
    const std::string& scene, const std::vector<std::string>& labels,
    const std::vector<AxisValue>& values) {
    std::string name = scene;
    for (std::size_t i = 0; i < values.size(); ++i)
        name += '/' + labels[i] + ':' + valueLabel(values[i].value);
    return name;
}

}  // namespace

std::vector<CaseSpec> expand(const Scene& scene, std::span<const Axis> overrides) {
    const Json resolved = Json::parse(scene.resolved);
    const std::vector<Axis> axes = withOverrides(scene, resolved, overrides);
    std::vector<std::string> pointers;
    for (const Axis& axis : axes) pointers.push_back(axis.pointer);
    const std::vector<std::string> labels = axisLabels(pointers);
    std::vector<CaseSpec> cases;
    std::unordered_set<std::string> names;
    std::string context = scene.path.string();
    try {
        requireIndependent(axes);
        const std::size_t count = caseCount(axes);
        for (std::size_t i = 0; i < count; ++i) {
            CaseSpec spec;
            spec.axes = combination(axes, i);
            spec.name = caseName(scene.name, labels, spec.axes);
            context = scene.path.string() + (axes.empty() ? "" : ": " + spec.name);
            Json document = resolved;
            for (const AxisValue& axis : spec.axes)
                patch(document, axis.pointer, Json::parse(axis.value));
            spec.settings = readSettings(document);
            spec.document = document.dump();
            checkSettings(spec.settings);
            if (!names.insert(spec.name).second) throw Error("two cases have this name");
            cases.push_back(std::move(spec));
        }
    } catch (const Error& error) {
        throw Error(context, error.what());
    }
    return cases;
}

std::vector<CaseSpec> keepMatching(std::vector<CaseSpec> cases, const std::string& regex) {
    try {
        const std::regex pattern(regex, std::regex::ECMAScript);
        std::erase_if(
            cases, [&](const CaseSpec& spec) { return !std::regex_search(spec.name, pattern); });
    } catch (const std::regex_error& error) {
        throw Error("--filter " + regex, error.what());
    }
    return cases;
}

}  // namespace benchmarks
