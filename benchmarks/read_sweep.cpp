#include "benchmarks/read_sweep.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "benchmarks/pointer.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

using engine::Error;

// Calls `action` and puts the context in front of the reasons it throws.
template <class Action>
void within(const std::string& context, Action&& action) {
    try {
        action();
    } catch (const Error& error) {
        throw Error(context, error.what());
    }
}

Axis writtenAxis(const std::string& pointer, const Json& values) {
    if (!values.is_array())
        throw Error(pointer, "expected an array of values, found " + described(values));
    Axis axis{.pointer = pointer, .values = {}, .tied = {}};
    for (const Json& value : values) axis.values.emplace_back(value);
    return axis;
}

// Calls `read` with each element of an array of objects that are not empty, within its pointer.
template <class Read>
void readObjects(const std::string& member, const Json& list, Read read) {
    if (!list.is_array())
        throw Error("/sweep/" + member, "expected an array, found " + described(list));
    for (std::size_t i = 0; i < list.size(); ++i)
        within("/sweep/" + member + '/' + std::to_string(i), [&] {
            if (!list[i].is_object() || list[i].empty())
                throw Error("expected an object with fields, found " + described(list[i]));
            read(list[i]);
        });
}

// One axis of several fields: the first, and the others tied to it.
Axis tied(std::vector<Axis> fields) {
    Axis axis = std::move(fields.front());
    axis.tied.assign(
        std::make_move_iterator(fields.begin() + 1), std::make_move_iterator(fields.end()));
    return axis;
}

Axis zipped(const Json& group, const Json& resolved) {
    std::vector<Axis> fields;
    for (const auto& [pointer, values] : group.items()) {
        fields.push_back(echoedAxis(writtenAxis(pointer, values), resolved));
        if (values.size() != fields.front().values.size())
            throw Error(
                pointer, std::to_string(values.size()) + " values, but " + fields.front().pointer +
                             " has " + std::to_string(fields.front().values.size()));
    }
    return tied(std::move(fields));
}

Axis listed(const Json& rows, const Json& resolved) {
    std::vector<Axis> fields;
    readObjects("cases", rows, [&](const Json& row) {
        for (const auto& [pointer, value] : row.items()) {
            echoedAxis({.pointer = pointer, .values = {Document(value)}, .tied = {}}, resolved);
            if (std::ranges::find(fields, pointer, &Axis::pointer) == fields.end())
                fields.push_back({.pointer = pointer, .values = {}, .tied = {}});
        }
    });
    if (fields.empty()) throw Error("/sweep/cases", "a list needs at least one case");
    Json own = resolved;
    for (Axis& field : fields) {
        const Json& scene_value = valueAt(own, field.pointer);
        for (const Json& row : rows)
            field.values.emplace_back(
                row.contains(field.pointer) ? row[field.pointer] : scene_value);
        field = echoedAxis(field, resolved);
    }
    return tied(std::move(fields));
}

Exclusion exclusion(const Json& conditions, const Json& resolved) {
    Exclusion fields;
    for (const auto& [pointer, values] : conditions.items()) {
        fields.push_back(checkedAxis(writtenAxis(pointer, values), resolved));
        if (std::ranges::any_of(values, [](const Json& value) { return value.is_object(); }))
            throw Error(pointer, "a condition is on single fields, not on a group");
    }
    return fields;
}

}  // namespace

SweepMember readSweep(const Json& sweep, const Json& resolved) {
    SweepMember read;
    if (!sweep.is_object()) throw Error("/sweep", "expected an object, found " + described(sweep));
    for (const auto& [key, value] : sweep.items()) {
        if (key == "zip")
            readObjects(key, value, [&](const Json& group) {
                read.axes.push_back(zipped(group, resolved));
            });
        else if (key == "cases")
            read.axes.push_back(listed(value, resolved));
        else if (key == "exclude")
            readObjects(key, value, [&](const Json& conditions) {
                read.exclusions.push_back(exclusion(conditions, resolved));
            });
        else
            within("/sweep", [&] {
                read.axes.push_back(checkedAxis(writtenAxis(key, value), resolved));
            });
    }
    return read;
}

}  // namespace benchmarks
