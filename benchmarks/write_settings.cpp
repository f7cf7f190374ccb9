#include "benchmarks/write_settings.h"

#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "hair/fields.h"

namespace benchmarks {
namespace {

// The shortest decimal that reads back as the same float: 0.002, not 0.0020000000949949026.
Json shortestNumber(float value) {
    char text[32];
    const char* const end = std::to_chars(text, text + sizeof text, value).ptr;
    double shortest = 0.0;
    std::from_chars(text, end, shortest);
    return cleanNumber(shortest);
}

Json valueJson(float value) { return shortestNumber(value); }

Json valueJson(const glm::vec3& value) {
    return Json::array({shortestNumber(value.x), shortestNumber(value.y), shortestNumber(value.z)});
}

template <class Value>
Json valueJson(const Value& value) {
    return value;
}

template <class Value>
Json writeField(const hair::Member<Value>& row, hair::SettingsView settings) {
    return valueJson(row.in(settings));
}

Json writeField(const hair::Choice& row, hair::SettingsView settings) {
    const auto chosen = row.chosen(settings);
    if (!chosen) return nullptr;  // an enumerator without a name: the round-trip test finds it
    return row.names[*chosen].name;
}

Json writeField(const hair::Group& row, hair::SettingsView settings) {
    return writeFields(row.in(settings));
}

Json writeField(const hair::List& row, hair::SettingsView settings) {
    Json list = Json::array();
    for (std::size_t i = 0; i < row.size(settings); ++i)
        list.push_back(writeFields(row.at(settings, i)));
    return list;
}

Json fieldJson(const hair::Field& field, hair::SettingsView settings) {
    return std::visit([&](const auto& row) { return writeField(row, settings); }, field.kind);
}

Json changedFields(hair::SettingsView settings, hair::SettingsView original);

Json changedElements(const hair::List& row, hair::SettingsView settings) {
    Json list = Json::array();
    for (std::size_t i = 0; i < row.size(settings); ++i)
        list.push_back(changedFields(row.at(settings, i), row.newElement()));
    return list;
}

Json changedFields(hair::SettingsView settings, hair::SettingsView original) {
    Json object = Json::object();
    for (const hair::Field& field : settings.fields()) {
        Json value = fieldJson(field, settings);
        // As texts: numbers that are equal can differ in the sign of zero.
        if (value.dump() == fieldJson(field, original).dump()) continue;
        if (const auto* const group = std::get_if<hair::Group>(&field.kind))
            value = changedFields(group->in(settings), group->in(original));
        else if (const auto* const list = std::get_if<hair::List>(&field.kind))
            value = changedElements(*list, settings);
        object[field.name] = std::move(value);
    }
    return object;
}

}  // namespace

Json writeSettings(const hair::Settings& settings) { return writeFields(settings); }

Json writeFields(hair::SettingsView settings) {
    Json object = Json::object();
    for (const hair::Field& field : settings.fields())
        object[field.name] = fieldJson(field, settings);
    return object;
}

Json changedFields(const hair::Settings& settings) {
    return changedFields(settings, hair::Settings{});
}

Json cleanNumber(double value) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool whole = std::abs(value) < kExact && std::trunc(value) == value;
    if (!whole || (value == 0.0 && std::signbit(value))) return value;
    return static_cast<std::int64_t>(value);
}

}  // namespace benchmarks
