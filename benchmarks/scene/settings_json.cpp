#include "benchmarks/scene/settings_json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "hair/fields.h"

namespace benchmarks::scene {
namespace {

// ---- Reading ------------------------------------------------------------------------------------

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

// Returns " m", or nothing for a plain ratio.
std::string withUnit(std::string_view unit) { return unit == "1" ? "" : ' ' + std::string(unit); }

enum class Numbers { whole, real };

// Throws engine::Error if the number is out of range or, where required, not an integer.
void checkNumber(
    const Json& value, const std::string& pointer, Numbers allowed, const hair::Range& range) {
    const bool whole = allowed == Numbers::whole;
    if (!value.is_number()) throw mismatch(pointer, whole ? "an integer" : "a number", value);
    const double number = value.get<double>();
    if (!std::isfinite(number)) throw engine::Error(pointer, shown(number) + " is not finite");
    if (whole && std::trunc(number) != number)
        throw engine::Error(pointer, shown(number) + " is not an integer");
    checkInRange(pointer, number, range);
}

void readFields(
    const Json& object, const std::string& pointer, hair::SettingsRef settings,
    std::span<const std::string_view> passed_over = {});

void read(
    const Json& value, const std::string& pointer, const hair::Field& field,
    hair::SettingsRef settings);

template <class Value>
void read(
    const Json& value, const std::string& pointer, const hair::Number<Value>& row,
    hair::SettingsRef settings) {
    checkNumber(value, pointer, std::is_integral_v<Value> ? Numbers::whole : Numbers::real, row);
    row.in(settings) = value.get<Value>();
}

void read(
    const Json& value, const std::string& pointer, const hair::Number<glm::vec3>& row,
    hair::SettingsRef settings) {
    if (!value.is_array() || value.size() != 3)
        throw mismatch(pointer, "an array of 3 numbers", value);
    for (int i = 0; i < 3; ++i) {
        const Json& component = value[static_cast<std::size_t>(i)];
        checkNumber(component, pointer + '/' + std::to_string(i), Numbers::real, row);
        row.in(settings)[i] = component.get<float>();
    }
}

void read(
    const Json& value, const std::string& pointer, const hair::OneOf& row,
    hair::SettingsRef settings) {
    std::string known;
    for (const std::uint32_t allowed : row.values) {
        if (value.is_number() && value.get<double>() == allowed) {
            row.in(settings) = allowed;
            return;
        }
        known += (known.empty() ? "" : ", ") + std::to_string(allowed);
    }
    if (!value.is_number()) throw mismatch(pointer, "an integer", value);
    throw engine::Error(
        pointer, shown(value.get<double>()) + " is not one of " + known + withUnit(row.unit));
}

void read(
    const Json& value, const std::string& pointer, const hair::Text& row,
    hair::SettingsRef settings) {
    if (!value.is_string()) throw mismatch(pointer, "a string", value);
    row.in(settings) = value.get<std::string>();
}

void read(
    const Json& value, const std::string& pointer, const hair::Toggle& row,
    hair::SettingsRef settings) {
    if (!value.is_boolean()) throw mismatch(pointer, "true or false", value);
    row.in(settings) = value.get<bool>();
}

void read(
    const Json& value, const std::string& pointer, const hair::Choice& row,
    hair::SettingsRef settings) {
    if (!value.is_string()) throw mismatch(pointer, "a name", value);
    const auto& name = value.get_ref<const std::string&>();
    std::vector<std::string> known;
    for (std::size_t i = 0; i < row.names.size(); ++i) {
        if (row.names[i].name == name) {
            row.choose(settings, i);
            return;
        }
        known.emplace_back(row.names[i].name);
    }
    throw engine::Error(
        pointer, unknownName("unknown name '" + escapedToken(name) + '\'', name, known));
}

void read(
    const Json& value, const std::string& pointer, const hair::ChoiceOrFile& row,
    hair::SettingsRef settings) {
    if (value.is_string()) {
        const auto& name = value.get_ref<const std::string&>();
        if (name.ends_with(hair::ChoiceOrFile::kExtension)) {
            row.chooseFile(settings, name);
            return;
        }
    }
    row.file.in(settings).clear();
    read(value, pointer, static_cast<const hair::Choice&>(row), settings);
}

// The file declares the ranges: extensions.h.
void read(
    const Json& value, const std::string& pointer, const hair::Parameters& row,
    hair::SettingsRef settings) {
    if (!value.is_object()) throw mismatch(pointer, "an object", value);
    constexpr hair::Range kAny{
        std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max(), "1"};
    hair::ExtensionParameters& parameters = row.in(settings);
    parameters = {};
    for (const auto& [name, member] : value.items()) {
        const std::string here = pointer + '/' + escapedToken(name);
        hair::ExtensionValue read{.name = name, .is_vector = member.is_array()};
        if (member.is_array() && member.size() != 3)
            throw mismatch(here, "a number or an array of 3 numbers", member);
        for (int i = 0; i < (read.is_vector ? 3 : 1); ++i) {
            const Json& number = read.is_vector ? member[static_cast<std::size_t>(i)] : member;
            checkNumber(
                number, read.is_vector ? here + '/' + std::to_string(i) : here, Numbers::real,
                kAny);
            read.value[i] = number.get<float>();
        }
        parameters.values.push_back(std::move(read));
    }
}

void read(
    const Json& value, const std::string& pointer, const hair::Group& row,
    hair::SettingsRef settings) {
    readFields(value, pointer, row.in(settings));
}

void read(
    const Json& value, const std::string& pointer, const hair::List& row,
    hair::SettingsRef settings) {
    if (!value.is_array()) throw mismatch(pointer, "an array", value);
    if (value.size() > row.maximum_count)
        throw engine::Error(
            pointer, "has " + std::to_string(value.size()) + " elements; at most " +
                         std::to_string(row.maximum_count) + " are permitted");
    row.resize(settings, 0);  // absent members of an element get a new element's defaults
    row.resize(settings, value.size());
    for (std::size_t i = 0; i < value.size(); ++i)
        readFields(value[i], pointer + '/' + std::to_string(i), row.at(settings, i));
}

void read(
    const Json& value, const std::string& pointer, const hair::Field& field,
    hair::SettingsRef settings) {
    std::visit([&](const auto& row) { read(value, pointer, row, settings); }, field.kind);
}

// Returns null for a name that is passed over. `pointer`: of the name.
const hair::Field* fieldNamed(
    const std::string& name, const std::vector<hair::Field>& fields, const std::string& pointer,
    std::span<const std::string_view> passed_over = {}) {
    const auto found = std::ranges::find(fields, name, &hair::Field::name);
    if (found != fields.end()) return &*found;
    if (std::ranges::find(passed_over, name) != passed_over.end()) return nullptr;
    std::vector<std::string> known;
    for (const hair::Field& field : fields) known.emplace_back(field.name);
    known.insert(known.end(), passed_over.begin(), passed_over.end());
    throw engine::Error(pointer, unknownName("unknown key", name, known));
}

void readFields(
    const Json& object, const std::string& pointer, hair::SettingsRef settings,
    std::span<const std::string_view> passed_over) {
    if (!object.is_object())
        throw mismatch(pointer.empty() ? "the document" : pointer, "an object", object);
    for (const auto& [key, value] : object.items())
        fieldNamed(key, settings.fields(), pointer + '/' + escapedToken(key), passed_over);
    for (const hair::Field& field : settings.fields())
        if (const auto member = object.find(field.name); member != object.end())
            read(*member, pointer + '/' + field.name, field, settings);
}

}  // namespace

hair::Settings readSettings(const Json& document) {
    hair::Settings settings;
    readFields(document, "", settings, kSceneKeys);
    return settings;
}

namespace {

// ---- Writing ------------------------------------------------------------------------------------

// Returns the shortest decimal that reads back as the same float: 0.002, not 0.0020000000949949026.
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

Json writeField(const hair::ChoiceOrFile& row, hair::SettingsView settings) {
    if (const std::string& file = row.file.in(settings); !file.empty()) return file;
    return writeField(static_cast<const hair::Choice&>(row), settings);
}

Json writeField(const hair::Parameters& row, hair::SettingsView settings) {
    Json object = Json::object();
    for (const hair::ExtensionValue& each : row.in(settings).values)
        object[each.name] = each.is_vector ? valueJson(each.value) : valueJson(each.value.x);
    return object;
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
        // Equal numbers can differ in the sign of zero.
        if (sameText(value, fieldJson(field, original))) continue;
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

namespace {

// ---- Fields by pointer --------------------------------------------------------------------------

// The part of settings that a JSON pointer names.
template <class Settings>
struct Part {
    Settings owner;  // has the field, or is the named element of a list
    hair::SettingsView original;  // defaults of `owner`
    const hair::Field* field = nullptr;  // null: an element of a list
    std::string pointer;  // of the field or the element
    std::string rest;  // names a component or a parameter within the field; may be empty
};

// `Settings` is hair::SettingsRef or hair::SettingsView.
template <class Settings>
Part<Settings> partAt(Settings settings, const std::string& pointer) {
    static const hair::Settings defaults;
    Part<Settings> part{.owner = settings, .original = defaults};
    for (const std::string& token : pointerTokens(pointer)) {
        const std::string here = part.pointer + part.rest + '/' + escapedToken(token);
        const hair::Kind* const kind = part.field ? &part.field->kind : nullptr;
        if (const auto* const list = kind ? std::get_if<hair::List>(kind) : nullptr) {
            const std::size_t i = elementNamed(token, list->size(part.owner), here);
            part = {list->at(part.owner, i), list->newElement(), nullptr, here, {}};
            continue;
        }
        if (const auto* const group = kind ? std::get_if<hair::Group>(kind) : nullptr) {
            part = {group->in(part.owner), group->in(part.original), nullptr, {}, {}};
        } else if (kind) {
            part.rest = here.substr(part.pointer.size());
            continue;
        }
        part.field = fieldNamed(token, part.owner.fields(), here);
        part.pointer = here;
    }
    return part;
}

// Returns what `part.rest` names in the field's value.
template <class Settings>
Json& valueIn(Json& whole, const Part<Settings>& part) {
    try {
        return valueAt(whole, part.rest);
    } catch (const engine::Error& error) {
        throw engine::Error(part.pointer + error.what());
    }
}

void merge(
    const Json& object, const std::string& pointer, hair::SettingsRef settings,
    hair::SettingsView original);

void merge(
    const Json& value, const std::string& pointer, const hair::Field& field,
    hair::SettingsRef settings, hair::SettingsView original) {
    const auto* const group = std::get_if<hair::Group>(&field.kind);
    const auto* const parameters = std::get_if<hair::Parameters>(&field.kind);
    if (value.is_object() && group)
        return merge(value, pointer, group->in(settings), group->in(original));
    if (!value.is_object() || !parameters) return read(value, pointer, field, settings);
    Json merged = writeField(*parameters, settings);
    merged.merge_patch(value);
    read(merged, pointer, *parameters, settings);
}

void merge(
    const Json& object, const std::string& pointer, hair::SettingsRef settings,
    hair::SettingsView original) {
    for (const auto& [key, member] : object.items())
        if (!member.is_null())
            fieldNamed(key, settings.fields(), pointer + '/' + escapedToken(key));
    for (const hair::Field& field : settings.fields()) {
        const auto member = object.find(field.name);
        if (member == object.end()) continue;
        if (member->is_null())
            hair::assign(field, settings, original);
        else
            merge(*member, pointer + '/' + field.name, field, settings, original);
    }
}

}  // namespace

void setField(
    hair::Settings& settings, const std::string& pointer, const Json& value, Objects objects) {
    const Part<hair::SettingsRef> part = partAt<hair::SettingsRef>(settings, pointer);
    const bool merges = objects == Objects::merged;
    if (!part.field) {
        if (merges && value.is_object())
            return merge(value, part.pointer, part.owner, part.original);
        hair::assign(part.owner, part.original);
        return readFields(value, part.pointer, part.owner);
    }
    const hair::Field& field = *part.field;
    if (part.rest.empty()) {
        if (merges) return merge(value, part.pointer, field, part.owner, part.original);
        hair::assign(field, part.owner, part.original);
        return read(value, part.pointer, field, part.owner);
    }
    Json whole = fieldJson(field, part.owner);
    if (merges)
        valueIn(whole, part) = value;
    else
        whole[Json::json_pointer(part.rest)] = value;
    read(whole, part.pointer, field, part.owner);
}

Json valueAt(const hair::Settings& settings, const std::string& pointer) {
    const auto part = partAt<hair::SettingsView>(settings, pointer);
    if (!part.field) return writeFields(part.owner);
    Json whole = fieldJson(*part.field, part.owner);
    return part.rest.empty() ? whole : std::move(valueIn(whole, part));
}

void checkInRange(const std::string& pointer, double number, const hair::Range& range) {
    if (number >= range.minimum && number <= range.maximum) return;
    throw engine::Error(
        pointer, shown(number) + " is outside [" + shown(range.minimum) + ", " +
                     shown(range.maximum) + "]" + withUnit(range.unit));
}

Json cleanNumber(double value) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool whole = std::abs(value) < kExact && std::trunc(value) == value;
    if (!whole || (value == 0.0 && std::signbit(value))) return value;
    return static_cast<std::int64_t>(value);
}

}  // namespace benchmarks::scene
