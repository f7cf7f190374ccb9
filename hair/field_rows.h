#pragma once

#include <initializer_list>
#include <utility>

#include "hair/fields.h"

// Functions to write the tables of settings structs: one for each kind of row.
namespace hair {

// Returns a default-constructed struct.
template <class Settings>
const Settings& newSettings() {
    static const Settings settings;
    return settings;
}

template <class Settings, class Value>
Place placeOf(Value Settings::* member) {
    const Settings& settings = newSettings<Settings>();
    return {&settings, &(settings.*member)};
}

template <class Settings, class Value>
Field number(
    const char* name, Value Settings::* member, double minimum, double maximum, const char* unit,
    const char* help) {
    return {name, help, Number<Value>{{placeOf(member)}, {minimum, maximum, unit}}};
}

template <class Settings>
Field oneOf(
    const char* name, std::uint32_t Settings::* member, std::vector<std::uint32_t> values,
    const char* unit, const char* help) {
    return {name, help, OneOf{{placeOf(member)}, std::move(values), unit}};
}

template <class Settings>
Field text(const char* name, std::string Settings::* member, const char* help) {
    return {name, help, Text{{placeOf(member)}}};
}

template <class Settings>
Field fileName(const char* name, std::string Settings::* member, const char* help) {
    return {name, help, FileName{{{placeOf(member)}}}};
}

template <class Settings>
Field extensionFile(const char* name, std::string Settings::* member, const char* help) {
    return {name, help, ExtensionFile{{{{placeOf(member)}}}}};
}

template <class Settings>
Field toggle(const char* name, bool Settings::* member, const char* help) {
    return {name, help, Toggle{{placeOf(member)}}};
}

template <class Enum>
inline constexpr Choice::Access kChoiceAccess{
    .get = [](const void* member) { return static_cast<int>(*static_cast<const Enum*>(member)); },
    .set = [](void* member, int value) { *static_cast<Enum*>(member) = static_cast<Enum>(value); }};

template <class Settings, class Enum>
Field choice(
    const char* name, Enum Settings::* member, std::initializer_list<Named<Enum>> names,
    const char* help) {
    std::vector<Named<int>> known;
    for (const Named<Enum>& each : names)
        known.push_back({static_cast<int>(each.value), each.name});
    return {name, help, Choice(placeOf(member), kChoiceAccess<Enum>, std::move(known))};
}

template <class Settings, class Enum>
Field choiceOrFile(
    const char* name, Enum Settings::* member, std::initializer_list<Named<Enum>> names,
    Enum of_file, std::string Settings::* file, const char* help) {
    Field field = choice(name, member, names, help);
    field.kind =
        ChoiceOrFile(std::get<Choice>(field.kind), static_cast<int>(of_file), {placeOf(file)});
    return field;
}

template <class Settings>
Field parameters(const char* name, ExtensionParameters Settings::* member, const char* help) {
    return {name, help, Parameters{{placeOf(member)}}};
}

template <class Settings, class Nested>
Field group(const char* name, Nested Settings::* member, const char* help) {
    return {name, help, Group(placeOf(member), tableOf(&newSettings<Nested>()))};
}

template <class Element>
inline constexpr List::Access kListAccess{
    .size = [](const void* list) { return static_cast<const std::vector<Element>*>(list)->size(); },
    .at = [](const void* list, std::size_t index) -> const void* {
        return &(*static_cast<const std::vector<Element>*>(list))[index];
    },
    .change = [](void* list, std::size_t index) -> void* {
        return &(*static_cast<std::vector<Element>*>(list))[index];
    },
    .resize = [](void* list,
                 std::size_t size) { static_cast<std::vector<Element>*>(list)->resize(size); },
    .erase =
        [](void* list, std::size_t index) {
            auto& elements = *static_cast<std::vector<Element>*>(list);
            elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(index));
        }};

template <class Settings, class Element>
Field list(
    const char* name, std::vector<Element> Settings::* member, std::size_t maximum_count,
    const char* help) {
    return {
        name, help,
        List(
            placeOf(member), kListAccess<Element>, tableOf(&newSettings<Element>()),
            maximum_count)};
}

template <class Settings>
Table tableWith(std::initializer_list<Field> fields) {
    return {&newSettings<Settings>(), fields};
}

}  // namespace hair
