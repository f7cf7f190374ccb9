#include "benchmarks/scene/axis.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"

namespace benchmarks::scene {
namespace {

// ---- Ranges -------------------------------------------------------------------------------------

constexpr std::string_view kPowersOfTwo = "pow2:";
constexpr double kLargestExponent = 52.0;  // doubles, and thus JSON readers, are exact up to here

// Returns the numbers between colons; nothing if a part is not a number.
std::optional<std::vector<double>> numbers(std::string_view text) {
    std::vector<double> found;
    for (bool more = true; more;) {
        const std::size_t colon = text.find(':');
        const std::string_view part = text.substr(0, colon);
        double number = 0.0;
        const auto [rest, error] = std::from_chars(part.data(), part.data() + part.size(), number);
        if (error != std::errc{} || rest != part.data() + part.size() || !std::isfinite(number))
            return std::nullopt;
        found.push_back(number);
        more = colon != std::string_view::npos;
        if (more) text.remove_prefix(colon + 1);
    }
    return found;
}

Json wholeIfItIs(double number) {
    const double limit = std::ldexp(1.0, static_cast<int>(kLargestExponent));
    if (number == std::trunc(number) && std::abs(number) <= limit)
        return static_cast<std::int64_t>(number);
    return number;
}

// Returns the values of a command-line range; nothing if the text is not a range:
//   pow2:6:12     64, 128 ... 4096; pow2:6:12:2 takes every second one
//   10:50:20      10, 30, 50; 10:12 has steps of 1. Steps begin at the first number, and the last
//                 value is the largest that is not above the second
// Throws engine::Error "<text>: <reason>" for a range without values or with too many for a sweep.
std::optional<std::vector<Document>> rangeValues(std::string_view text) {
    const bool powers = text.starts_with(kPowersOfTwo);
    const auto parts = numbers(powers ? text.substr(kPowersOfTwo.size()) : text);
    if (!parts || parts->size() < 2 || parts->size() > 3) return std::nullopt;
    const double first = (*parts)[0];
    const double last = (*parts)[1];
    const double step = parts->size() == 3 ? (*parts)[2] : 1.0;
    if (step <= 0.0) throw engine::Error(std::string(text), "the step is not above 0");
    if (last < first) throw engine::Error(std::string(text), "the last value is below the first");
    if (powers && (first < 0.0 || last > kLargestExponent || first != std::trunc(first) ||
                   step != std::trunc(step)))
        throw engine::Error(std::string(text), "exponents must be whole numbers in [0, 52]");
    // The tolerance gives 0:1:0.1 its eleven values although 0.1 * 10 is rounded.
    const double count = std::floor((last - first) / step * (1.0 + 1e-12)) + 1.0;
    if (count > static_cast<double>(kMaximumCases))
        throw engine::Error(
            std::string(text), "has more than " + std::to_string(kMaximumCases) + " values");
    std::vector<Document> values;
    for (double i = 0.0; i < count; ++i)
        values.emplace_back(wholeIfItIs(powers ? std::exp2(first + i * step) : first + i * step));
    return values;
}

// ---- Axes and labels ----------------------------------------------------------------------------

std::vector<std::string> splitAtTopLevelCommas(std::string_view text) {
    std::vector<std::string> parts(1);
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') quoted = !quoted;
        if (!quoted && (c == '[' || c == '{')) ++depth;
        if (!quoted && (c == ']' || c == '}')) --depth;
        if (c == ',' && !quoted && depth <= 0) {
            parts.emplace_back();
            continue;
        }
        parts.back() += c;
        if (quoted && c == '\\' && i + 1 < text.size()) parts.back() += text[++i];
    }
    return parts;
}

std::optional<std::vector<Document>> rangeOf(std::string_view argument, const std::string& text) {
    try {
        return rangeValues(text);
    } catch (const engine::Error& error) {
        throw engine::Error("-a " + std::string(argument), error.what());
    }
}

bool isIndex(std::string_view token) {
    return !token.empty() && token.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string joinedTail(const std::vector<std::string>& tokens, std::size_t count) {
    std::string text;
    for (std::size_t i = tokens.size() - count; i < tokens.size(); ++i)
        text += (text.empty() ? "" : ".") + tokens[i];
    return text;
}

void requireFew(const std::string& axis, std::size_t values) {
    if (values > kMostAxisValues)
        throw engine::Error(
            axis, "has " + std::to_string(values) + " values; at most " +
                      std::to_string(kMostAxisValues) + " are permitted");
}

// Like checkedAxis(), but an axis may have the same value twice, as tied axes do.
Axis echoedAxis(const Axis& axis, hair::Settings settings) {
    if (axis.values.empty()) throw engine::Error(axis.pointer, "an axis needs at least one value");
    requireFew(axis.pointer, axis.values.size());
    Axis echoed{.pointer = axis.pointer};
    for (const Document& value : axis.values) {
        setField(settings, axis.pointer, value.json());
        echoed.values.push_back(
            value.json().is_object() ? value : Document(valueAt(settings, axis.pointer)));
    }
    return echoed;
}

}  // namespace

Document parseValue(const std::string& text) {
    Json value = Json::parse(text, nullptr, false);
    if (!value.is_discarded()) return Document(std::move(value));
    // Settings are UTF-8, but a command line need not be.
    return Document(Json::parse(Document(text).text()));
}

Axis parseAxis(std::string_view argument) {
    const std::size_t equals = argument.find('=');
    if (equals == std::string_view::npos || equals == 0)
        throw engine::Error(
            "-a " + std::string(argument), "expected POINTER=V1,V2, as in /strands/density=16,64");
    Axis axis{.pointer = std::string(argument.substr(0, equals))};
    for (const std::string& text : splitAtTopLevelCommas(argument.substr(equals + 1))) {
        if (text.empty()) throw engine::Error("-a " + std::string(argument), "a value is empty");
        if (const auto values = rangeOf(argument, text)) {
            axis.values.insert(axis.values.end(), values->begin(), values->end());
            continue;
        }
        axis.values.push_back(parseValue(text));
    }
    return axis;
}

Axis checkedAxis(const Axis& axis, const hair::Settings& settings) {
    Axis echoed = echoedAxis(axis, settings);
    std::set<std::string> texts;
    for (const Document& value : echoed.values)
        if (!texts.insert(value.text()).second)
            throw engine::Error(axis.pointer, valueLabel(value.json()) + " appears twice");
    return echoed;
}

std::vector<std::string> axisLabels(const std::vector<std::string>& pointers) {
    std::vector<std::vector<std::string>> tokens;
    for (const std::string& pointer : pointers) tokens.push_back(pointerTokens(pointer));
    std::vector<std::string> labels;
    for (const auto& mine : tokens) {
        std::size_t count = isIndex(mine.back()) && mine.size() > 1 ? 2 : 1;
        const auto shared = [&](const auto& other) {
            return &other != &mine && other.size() >= count &&
                   std::equal(
                       mine.end() - static_cast<std::ptrdiff_t>(count), mine.end(),
                       other.end() - static_cast<std::ptrdiff_t>(count));
        };
        while (count < mine.size() && std::ranges::any_of(tokens, shared)) ++count;
        labels.push_back(joinedTail(mine, count));
    }
    return labels;
}

std::string valueLabel(const Json& value) {
    return value.is_string() ? engine::shownText(value.get<std::string>()) : value.dump();
}

namespace {

// ---- A scene's sweep ----------------------------------------------------------------------------

// Calls `action` and prepends the context to its errors.
template <class Action>
void within(const std::string& context, Action&& action) {
    try {
        action();
    } catch (const engine::Error& error) {
        throw engine::Error(context, error.what());
    }
}

Axis writtenAxis(const std::string& pointer, const Json& values) {
    if (!values.is_array())
        throw engine::Error(pointer, "expected an array of values, found " + described(values));
    Axis axis{.pointer = pointer};
    for (const Json& value : values) axis.values.emplace_back(value);
    return axis;
}

// Calls `read` with each element of an array of non-empty objects; errors name the element's
// pointer.
template <class Read>
void readObjects(const std::string& member, const Json& list, Read read) {
    if (!list.is_array())
        throw engine::Error("/sweep/" + member, "expected an array, found " + described(list));
    for (std::size_t i = 0; i < list.size(); ++i)
        within("/sweep/" + member + '/' + std::to_string(i), [&] {
            if (!list[i].is_object() || list[i].empty())
                throw engine::Error("expected an object with fields, found " + described(list[i]));
            read(list[i]);
        });
}

// Makes one axis of several fields: the first one, with the others tied to it.
Axis tied(std::vector<Axis> fields) {
    Axis axis = std::move(fields.front());
    axis.tied.assign(
        std::make_move_iterator(fields.begin() + 1), std::make_move_iterator(fields.end()));
    return axis;
}

Axis zipped(const Json& group, const hair::Settings& settings) {
    std::vector<Axis> fields;
    for (const auto& [pointer, values] : group.items()) {
        fields.push_back(echoedAxis(writtenAxis(pointer, values), settings));
        if (values.size() != fields.front().values.size())
            throw engine::Error(
                pointer, std::to_string(values.size()) + " values, but " + fields.front().pointer +
                             " has " + std::to_string(fields.front().values.size()));
    }
    return tied(std::move(fields));
}

Axis listed(const Json& rows, const hair::Settings& settings) {
    std::vector<Axis> fields;
    requireFew("/sweep/cases", rows.size());
    readObjects("cases", rows, [&](const Json& row) {
        for (const auto& [pointer, value] : row.items()) {
            echoedAxis({.pointer = pointer, .values = {Document(value)}}, settings);
            if (std::ranges::find(fields, pointer, &Axis::pointer) == fields.end())
                fields.push_back({.pointer = pointer});
        }
    });
    if (fields.empty()) throw engine::Error("/sweep/cases", "a list needs at least one case");
    for (Axis& field : fields) {
        const Json scene_value = valueAt(settings, field.pointer);
        for (const Json& row : rows)
            field.values.emplace_back(
                row.contains(field.pointer) ? row[field.pointer] : scene_value);
        field = echoedAxis(field, settings);
    }
    return tied(std::move(fields));
}

Exclusion exclusion(const Json& conditions, const hair::Settings& settings) {
    Exclusion fields;
    for (const auto& [pointer, values] : conditions.items()) {
        fields.push_back(checkedAxis(writtenAxis(pointer, values), settings));
        if (std::ranges::any_of(values, [](const Json& value) { return value.is_object(); }))
            throw engine::Error(pointer, "a condition must name a single field, not a group");
    }
    return fields;
}

constexpr std::size_t kMostConditions = 100'000;  // values of all fields of /sweep/exclude

void requireFewConditions(const Json& exclude) {
    std::size_t count = 0;
    for (const Json& conditions : exclude)
        if (conditions.is_object())
            for (const Json& values : conditions) count += values.size();
    if (count > kMostConditions)
        throw engine::Error(
            "/sweep/exclude", "has " + std::to_string(count) + " values; at most " +
                                  std::to_string(kMostConditions) + " are permitted");
}

}  // namespace

SweepMember readSweep(const Json& sweep, const hair::Settings& settings) {
    SweepMember read;
    if (!sweep.is_object())
        throw engine::Error("/sweep", "expected an object, found " + described(sweep));
    if (sweep.contains("exclude")) requireFewConditions(sweep["exclude"]);
    for (const auto& [key, value] : sweep.items()) {
        if (key == "zip")
            readObjects(key, value, [&](const Json& group) {
                read.axes.push_back(zipped(group, settings));
            });
        else if (key == "cases")
            read.axes.push_back(listed(value, settings));
        else if (key == "exclude")
            readObjects(key, value, [&](const Json& conditions) {
                read.exclusions.push_back(exclusion(conditions, settings));
            });
        else
            within("/sweep", [&] {
                read.axes.push_back(checkedAxis(writtenAxis(key, value), settings));
            });
    }
    return read;
}

}  // namespace benchmarks::scene
