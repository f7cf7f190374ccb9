#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <glm/vec3.hpp>

// Descriptions of settings members. One row of a settings struct's `fields()` tuple gives JSON
// reading, range check, JSON Schema, report echo and (later) the UI widget: see settings.h for the
// tables.
namespace hair {

// A number, or a vector of three numbers with the same range per component.
// Value: float, std::uint32_t, std::int32_t, std::uint64_t or glm::vec3.
template <class Owner, class Value>
struct Field {
    const char* name;
    Value Owner::* member;
    double minimum;  // inclusive
    double maximum;  // inclusive
    const char* unit;  // SI symbol, "1" for a ratio, "count" for whole things
    const char* help;
};

template <class Owner>
struct Text {
    const char* name;
    std::string Owner::* member;
    const char* help;
};

// The path of a file, relative to the scene file; empty where there is none.
template <class Owner>
struct FileName : Text<Owner> {};

template <class Owner>
struct Toggle {
    const char* name;
    bool Owner::* member;
    const char* help;
};

// An enum written in JSON by name. Unknown names are an error that lists the known ones.
template <class Enum>
struct Named {
    Enum value;
    const char* name;
};

template <class Owner, class Enum, std::size_t Count>
struct Choice {
    const char* name;
    Enum Owner::* member;
    std::array<Named<Enum>, Count> names;
    const char* help;
};

// A number of which only some values exist, such as a sample count.
template <class Owner, std::size_t Count>
struct OneOf {
    const char* name;
    std::uint32_t Owner::* member;
    std::array<std::uint32_t, Count> values;
    const char* unit;
    const char* help;
};

// A nested settings struct: a JSON object with its own table.
template <class Owner, class Settings>
struct Group {
    const char* name;
    Settings Owner::* member;
    const char* help;
};

// A JSON array of nested settings structs.
template <class Owner, class Element>
struct List {
    const char* name;
    std::vector<Element> Owner::* member;
    std::size_t maximum_count;
    const char* help;
};

// Calls `visit(row)` for every row of Settings' table, in the table's order.
template <class Settings, class Visitor>
void forEachField(Visitor&& visit) {
    std::apply(
        [&](const auto&... row) { (visit(row), ...); },
        fields(static_cast<const Settings*>(nullptr)));
}

}  // namespace hair
