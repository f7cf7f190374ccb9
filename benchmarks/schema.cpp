#include "benchmarks/schema.h"

#include <nlohmann/json.hpp>

#include "benchmarks/write_settings.h"
#include "hair/fields.h"
#include "hair/settings.h"

namespace benchmarks {
namespace {

// Whether null may stand for a member: not inside a list, whose elements a merge patch replaces as
// a whole.
enum class Removal { possible, impossible };

Json objectSchema(hair::SettingsView defaults, Removal removal);

std::string helpWithUnit(const char* help, std::string_view unit) {
    return unit == "1" ? help : std::string(help) + " [" + std::string(unit) + ']';
}

Json numberSchema(const char* type, const hair::Range& range) {
    return {
        {"type", type},
        {"minimum", cleanNumber(range.minimum)},
        {"maximum", cleanNumber(range.maximum)}};
}

template <class Value>
Json fieldSchema(const char* help, const hair::Number<Value>& row, hair::SettingsView) {
    Json schema = {{"description", helpWithUnit(help, row.unit)}};
    schema.update(numberSchema(std::is_integral_v<Value> ? "integer" : "number", row));
    return schema;
}

Json fieldSchema(const char* help, const hair::Number<glm::vec3>& row, hair::SettingsView) {
    return {
        {"description", helpWithUnit(help, row.unit)},
        {"type", "array"},
        {"items", numberSchema("number", row)},
        {"minItems", 3},
        {"maxItems", 3}};
}

Json fieldSchema(const char* help, const hair::OneOf& row, hair::SettingsView) {
    return {{"description", helpWithUnit(help, row.unit)}, {"enum", row.values}};
}

Json fieldSchema(const char* help, const hair::Text&, hair::SettingsView) {
    return {{"description", help}, {"type", "string"}};
}

Json fieldSchema(const char* help, const hair::Toggle&, hair::SettingsView) {
    return {{"description", help}, {"type", "boolean"}};
}

Json fieldSchema(const char* help, const hair::Choice& row, hair::SettingsView) {
    Json names = Json::array();
    for (const auto& named : row.names) names.push_back(named.name);
    return {{"description", help}, {"enum", names}};
}

Json fieldSchema(const char* help, const hair::Group& row, hair::SettingsView defaults) {
    Json schema = {{"description", help}};
    schema.update(objectSchema(row.in(defaults), Removal::possible));
    return schema;
}

Json fieldSchema(const char* help, const hair::List& row, hair::SettingsView) {
    return {
        {"description", help},
        {"type", "array"},
        {"items", objectSchema(row.newElement(), Removal::impossible)},
        {"maxItems", row.maximum_count}};
}

void allowNull(Json& schema) {
    if (schema.contains("enum"))
        schema["enum"].push_back(nullptr);
    else
        schema["type"] = Json::array({schema["type"], "null"});
}

Json objectSchema(hair::SettingsView defaults, Removal removal) {
    const Json values = writeFields(defaults);
    Json members = Json::object();
    for (const hair::Field& field : defaults.fields()) {
        Json schema = std::visit(
            [&](const auto& row) { return fieldSchema(field.help, row, defaults); }, field.kind);
        if (removal == Removal::possible) allowNull(schema);
        const Json& value = values.at(field.name);
        if (!value.is_object()) schema["default"] = value;
        members[field.name] = std::move(schema);
    }
    return {
        {"type", "object"}, {"additionalProperties", false}, {"properties", std::move(members)}};
}

// An axis for every field, so that editors know its values; other pointers (a group, an element)
// are for the scene reader to judge.
void addAxes(
    const Json& members, const std::string& pointer, const std::string& schema_pointer,
    Json& axes) {
    for (const auto& [name, schema] : members.items()) {
        const std::string here = pointer + '/' + name;
        const std::string there = schema_pointer + "/properties/" + name;
        if (schema.contains("properties"))
            addAxes(schema["properties"], here, there, axes);
        else
            axes[here] = {
                {"type", {"array", "null"}},
                {"minItems", 1},
                {"uniqueItems", true},
                {"items", {{"$ref", "#" + there}}}};
    }
}

Json sweepSchema(const Json& members) {
    Json axes = Json::object();
    addAxes(members, "", "", axes);
    const auto rows = [](const char* description, const Json& field) {
        return Json{
            {"description", description},
            {"type", {"array", "null"}},
            {"items",
             {{"type", "object"},
              {"minProperties", 1},
              {"propertyNames", {{"pattern", "^/"}}},
              {"additionalProperties", field}}}};
    };
    const Json values = {{"type", "array"}, {"minItems", 1}};
    axes["zip"] = rows(
        "fields that change together: each object is one axis, whose fields have as many values "
        "each",
        values);
    axes["cases"] = rows("one axis by its rows: the fields' values in each", true);
    axes["exclude"] = rows(
        "combinations that are left out: where all fields of an object have one of its values",
        values);
    return {
        {"description", "what is varied: JSON pointer of a field -> its values; one case for each "
                        "combination, in the "
                        "written order, the last axis fastest"},
        {"type", {"object", "null"}},
        {"propertyNames", {{"pattern", "^(/.*|zip|cases|exclude)$"}}},
        {"properties", std::move(axes)},
        {"additionalProperties", {{"type", {"array", "null"}}, {"minItems", 1}}}};
}

}  // namespace

std::string sceneSchema() {
    Json schema = {
        {"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "hairbench scene"}};
    schema.update(objectSchema(hair::Settings{}, Removal::possible));
    Json sweep = sweepSchema(schema["properties"]);
    Json& members = schema["properties"];
    members["$schema"] = {{"description", "this schema, for editors"}, {"type", "string"}};
    members["base"] = {
        {"description",
         "scene file, relative to this one, to which this document is applied as a JSON merge "
         "patch (RFC 7386): null takes a member of the base away"},
        {"type", "string"}};
    members["sweep"] = std::move(sweep);
    members["suite"] = {
        {"description",
         "scene files, relative to this one, that are run one after another; nothing but $schema "
         "and description is beside it"},
        {"type", "array"},
        {"minItems", 1},
        {"items", {{"type", "string"}}}};
    return schema.dump(2) + '\n';
}

}  // namespace benchmarks
