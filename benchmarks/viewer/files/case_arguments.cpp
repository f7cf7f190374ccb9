#include "benchmarks/viewer/files/case_arguments.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "benchmarks/axis.h"
#include "benchmarks/pointer.h"
#include "benchmarks/sweep.h"
#include "benchmarks/write_settings.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

using engine::Error;

struct Argument {
    std::string pointer;
    Json value;
    bool in_name;  // -a, otherwise --set
};

// Whether text is taken for a string as it is: it is no JSON, and has nothing that means something
// to the parser of axes.
bool isPlain(const std::string& text) {
    constexpr std::string_view kFirst = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_./";
    const std::string allowed = std::string(kFirst) + "0123456789-";
    return !text.empty() && kFirst.find(text[0]) != std::string_view::npos &&
           text.find_first_not_of(allowed) == std::string::npos && !Json::accept(text);
}

std::string valueText(const Json& value) {
    if (value.is_string() && isPlain(value.get_ref<const std::string&>()))
        return value.get<std::string>();
    return value.dump();
}

std::string quoted(const std::string& word) {
    const auto safe = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
               std::string_view("_-+=:,./@%").find(c) != std::string_view::npos;
    };
    if (std::ranges::all_of(word, safe)) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + '\'';
}

bool isInside(const std::string& pointer, const std::string& outer) {
    return pointer == outer || pointer.starts_with(outer + '/');
}

// The sweep's axes, each with the one value that it has in the settings.
std::vector<Argument> axisArguments(const Scene& scene, Json& wanted) {
    std::vector<Argument> arguments;
    for (const Axis& axis : scene.axes) {
        if (!axis.tied.empty())
            throw Error(
                "the sweep ties " + axis.pointer +
                " to other fields, which a command line can't take apart; save a scene instead");
        arguments.push_back({axis.pointer, valueAt(wanted, axis.pointer), true});
    }
    return arguments;
}

// Adds what differs and no axis has.
void addChanges(
    const Json& original, const Json& wanted, const std::string& pointer,
    const std::vector<Axis>& axes, std::vector<Argument>& arguments) {
    const auto has_it = [&](const Axis& axis) { return isInside(pointer, axis.pointer); };
    if (std::ranges::any_of(axes, has_it)) return;
    if (wanted.is_object()) {
        for (const auto& [key, value] : wanted.items())
            addChanges(original.at(key), value, pointer + '/' + escapedToken(key), axes, arguments);
        return;
    }
    if (original.dump() == wanted.dump()) return;
    const bool is_list = wanted.is_array() && (wanted.empty() || wanted[0].is_object());
    arguments.push_back({pointer, wanted, !is_list && pointer != "/description"});
}

// Lists without the members that are as in a new element.
void shorten(std::vector<Argument>& arguments, const hair::Settings& settings) {
    const Json changed = changedFields(settings);
    for (Argument& argument : arguments) {
        if (argument.in_name) continue;
        const Json::json_pointer pointer(argument.pointer);
        if (changed.contains(pointer)) argument.value = changed.at(pointer);
    }
}

// What the program makes of the arguments has to be what they were made of.
void check(Scene scene, const std::vector<Argument>& arguments, const Json& wanted) {
    std::vector<Axis> axes;
    for (const Argument& argument : arguments) {
        if (argument.in_name)
            axes.push_back(parseAxis(argument.pointer + '=' + valueText(argument.value)));
        else
            setField(scene, argument.pointer, argument.value);
    }
    const std::vector<CaseSpec> cases = expand(scene, axes);
    if (cases.size() != 1 || writeSettings(cases.front().settings).dump() != wanted.dump())
        throw Error(scene.path.string(), "a command line can't say it; save a scene instead");
}

}  // namespace

std::string caseArguments(const Scene& scene, const hair::Settings& settings) {
    Json wanted = writeSettings(settings);
    std::vector<Argument> arguments;
    try {
        arguments = axisArguments(scene, wanted);
    } catch (const Error& error) {
        throw Error(scene.path.string(), error.what());
    }
    addChanges(writeSettings(scene.settings), wanted, "", scene.axes, arguments);
    shorten(arguments, settings);
    check(scene, arguments, wanted);
    std::string text;
    for (const Argument& argument : arguments)
        text += (text.empty() ? "" : " ") + std::string(argument.in_name ? "-a " : "--set ") +
                quoted(argument.pointer + '=' + valueText(argument.value));
    return text;
}

}  // namespace benchmarks
