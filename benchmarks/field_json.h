#pragma once

#include <charconv>
#include <cmath>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "benchmarks/json_fwd.h"
#include "hair/fields.h"

// Settings structs as JSON, driven by their field tables.
namespace benchmarks {

// Written without a fraction if it has none, so that 64 stays 64 and a name or a schema reads well.
inline Json cleanNumber(double value) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool whole = std::abs(value) < kExact && std::trunc(value) == value;
    if (!whole || (value == 0.0 && std::signbit(value))) return value;
    return static_cast<std::int64_t>(value);
}

// The shortest decimal that reads back as the same float: 0.002, not 0.0020000000949949026.
inline Json cleanNumber(float value) {
    char text[32];
    const char* const end = std::to_chars(text, text + sizeof text, value).ptr;
    double shortest = 0.0;
    std::from_chars(text, end, shortest);
    return cleanNumber(shortest);
}

template <class Settings>
Json writeFields(const Settings& settings);

template <class Owner, class Value>
Json writeField(const hair::Field<Owner, Value>& row, const Owner& owner) {
    const Value& value = owner.*row.member;
    if constexpr (std::is_same_v<Value, glm::vec3>)
        return Json::array({cleanNumber(value.x), cleanNumber(value.y), cleanNumber(value.z)});
    else if constexpr (std::is_same_v<Value, float>)
        return cleanNumber(value);
    else
        return value;
}

template <class Owner>
Json writeField(const hair::Text<Owner>& row, const Owner& owner) {
    return owner.*row.member;
}

template <class Owner>
Json writeField(const hair::Toggle<Owner>& row, const Owner& owner) {
    return owner.*row.member;
}

template <class Owner, class Enum, std::size_t Count>
Json writeField(const hair::Choice<Owner, Enum, Count>& row, const Owner& owner) {
    for (const auto& named : row.names)
        if (named.value == owner.*row.member) return named.name;
    return nullptr;  // an enumerator without a name: the round-trip test finds it
}

template <class Owner, std::size_t Count>
Json writeField(const hair::OneOf<Owner, Count>& row, const Owner& owner) {
    return owner.*row.member;
}

template <class Owner, class Settings>
Json writeField(const hair::Group<Owner, Settings>& row, const Owner& owner) {
    return writeFields(owner.*row.member);
}

template <class Owner, class Element>
Json writeField(const hair::List<Owner, Element>& row, const Owner& owner) {
    Json list = Json::array();
    for (const Element& element : owner.*row.member) list.push_back(writeFields(element));
    return list;
}

// Every member, in the table's order.
template <class Settings>
Json writeFields(const Settings& settings) {
    Json object = Json::object();
    hair::forEachField<Settings>(
        [&](const auto& row) { object[row.name] = writeField(row, settings); });
    return object;
}

}  // namespace benchmarks
