#include "benchmarks/read_settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include <nlohmann/json.hpp>

#include "benchmarks/names.h"
#include "benchmarks/pointer.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

engine::Error mismatch(const std::string& pointer, const std::string& expected, const Json& found) {
    return {pointer, "expected " + expected + ", found " + described(found)};
}

std::string shown(double number) {
    char text[64];
    const auto format = std::abs(number) < 1e15 && std::trunc(number) == number
                            ? std::chars_format::fixed
                            : std::chars_format::general;
    return {text, std::to_chars(text, text + sizeof text, number, format).ptr};
}

// " m", but nothing for a plain ratio.
std::string withUnit(std::string_view unit) { return unit == "1" ? "" : ' ' + std::string(unit); }

template <class Value, class Row>
Value readNumber(const Json& value, const std::string& pointer, const Row& row) {
    constexpr bool kWhole = std::is_integral_v<Value>;
    if (!value.is_number()) throw mismatch(pointer, kWhole ? "an integer" : "a number", value);
    const double number = value.get<double>();
    if (!std::isfinite(number)) throw engine::Error(pointer, shown(number) + " is not finite");
    if (kWhole && std::trunc(number) != number)
        throw engine::Error(pointer, shown(number) + " is not an integer");
    if (number < row.minimum || number > row.maximum)
        throw engine::Error(
            pointer, shown(number) + " is outside [" + shown(row.minimum) + ", " +
                         shown(row.maximum) + "]" + withUnit(row.unit));
    return value.get<Value>();
}

template <class Settings>
void readFields(
    const Json& object, const std::string& pointer, Settings& settings,
    std::span<const std::string_view> passed_over = {});

template <class Owner, class Value>
void read(
    const Json& value, const std::string& pointer, const hair::Field<Owner, Value>& row,
    Value& target) {
    if constexpr (std::is_same_v<Value, glm::vec3>) {
        if (!value.is_array() || value.size() != 3)
            throw mismatch(pointer, "an array of 3 numbers", value);
        for (int i = 0; i < 3; ++i)
            target[i] = readNumber<float>(
                value[static_cast<std::size_t>(i)], pointer + '/' + std::to_string(i), row);
    } else {
        target = readNumber<Value>(value, pointer, row);
    }
}

template <class Owner>
void read(
    const Json& value, const std::string& pointer, const hair::Text<Owner>&, std::string& target) {
    if (!value.is_string()) throw mismatch(pointer, "a string", value);
    target = value.get<std::string>();
}

template <class Owner>
void read(const Json& value, const std::string& pointer, const hair::Toggle<Owner>&, bool& target) {
    if (!value.is_boolean()) throw mismatch(pointer, "true or false", value);
    target = value.get<bool>();
}

template <class Owner, class Enum, std::size_t Count>
void read(
    const Json& value, const std::string& pointer, const hair::Choice<Owner, Enum, Count>& row,
    Enum& target) {
    if (!value.is_string()) throw mismatch(pointer, "a name", value);
    const auto& name = value.get_ref<const std::string&>();
    std::vector<std::string> known;
    for (const auto& named : row.names) {
        if (named.name == name) {
            target = named.value;
            return;
        }
        known.emplace_back(named.name);
    }
    throw engine::Error(
        pointer, unknownName("unknown name \"" + escapedToken(name) + '"', name, known));
}

template <class Owner, std::size_t Count>
void read(
    const Json& value, const std::string& pointer, const hair::OneOf<Owner, Count>& row,
    std::uint32_t& target) {
    std::string known;
    for (const std::uint32_t allowed : row.values) {
        if (value.is_number() && value.get<double>() == allowed) {
            target = allowed;
            return;
        }
        known += (known.empty() ? "" : ", ") + std::to_string(allowed);
    }
    if (!value.is_number()) throw mismatch(pointer, "an integer", value);
    throw engine::Error(
        pointer, shown(value.get<double>()) + " is not one of " + known + withUnit(row.unit));
}

template <class Owner, class Settings>
void read(
    const Json& value, const std::string& pointer, const hair::Group<Owner, Settings>&,
    Settings& target) {
    readFields(value, pointer, target);
}

template <class Owner, class Element>
void read(
    const Json& value, const std::string& pointer, const hair::List<Owner, Element>& row,
    std::vector<Element>& target) {
    if (!value.is_array()) throw mismatch(pointer, "an array", value);
    if (value.size() > row.maximum_count)
        throw engine::Error(
            pointer, std::to_string(value.size()) + " elements are more than " +
                         std::to_string(row.maximum_count));
    target.assign(value.size(), {});
    for (std::size_t i = 0; i < value.size(); ++i)
        readFields(value[i], pointer + '/' + std::to_string(i), target[i]);
}

template <class Settings>
void requireKnownKeys(
    const Json& object, const std::string& pointer, std::span<const std::string_view> passed_over) {
    std::vector<std::string> known;
    hair::forEachField<Settings>([&](const auto& row) { known.emplace_back(row.name); });
    known.insert(known.end(), passed_over.begin(), passed_over.end());
    for (const auto& [key, value] : object.items())
        if (std::ranges::find(known, key) == known.end())
            throw engine::Error(
                pointer + '/' + escapedToken(key), unknownName("unknown key", key, known));
}

template <class Settings>
void readFields(
    const Json& object, const std::string& pointer, Settings& settings,
    std::span<const std::string_view> passed_over) {
    if (!object.is_object())
        throw mismatch(pointer.empty() ? "the document" : pointer, "an object", object);
    requireKnownKeys<Settings>(object, pointer, passed_over);
    hair::forEachField<Settings>([&](const auto& row) {
        if (const auto member = object.find(row.name); member != object.end())
            read(*member, pointer + '/' + row.name, row, settings.*row.member);
    });
}

}  // namespace

hair::Settings readSettings(const Json& document) {
    hair::Settings settings;
    readFields(document, "", settings, kSceneKeys);
    return settings;
}

}  // namespace benchmarks
