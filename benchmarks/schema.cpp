#include "benchmarks/schema.h"

#include "benchmarks/field_json.h"
#include "hair/settings.h"

namespace benchmarks {
namespace {

// Whether null may stand for a member: not inside a list, whose elements a merge patch replaces as
// a whole.
enum class Removal { possible, impossible };

template <class Settings>
Json objectSchema(const Json& defaults, Removal removal);

std::string helpWithUnit(const char* help, std::string_view unit) {
    return unit == "1" ? help : std::string(help) + " [" + std::string(unit) + ']';
}

template <class Value>
Json numberSchema(double minimum, double maximum) {
    return {
        {"type", std::is_integral_v<Value> ? "integer" : "number"},
        {"minimum", cleanNumber(minimum)},
        {"maximum", cleanNumber(maximum)}};
}

template <class Owner, class Value>
Json fieldSchema(const hair::Field<Owner, Value>& row, const Json&) {
    Json schema = {{"description", helpWithUnit(row.help, row.unit)}};
    if constexpr (std::is_same_v<Value, glm::vec3>)
        schema.update(
            {{"type", "array"},
             {"items", numberSchema<float>(row.minimum, row.maximum)},
             {"minItems", 3},
             {"maxItems", 3}});
    else
        schema.update(numberSchema<Value>(row.minimum, row.maximum));
    return schema;
}

template <class Owner>
Json fieldSchema(const hair::Text<Owner>& row, const Json&) {
    return {{"description", row.help}, {"type", "string"}};
}

template <class Owner>
Json fieldSchema(const hair::Toggle<Owner>& row, const Json&) {
    return {{"description", row.help}, {"type", "boolean"}};
}

template <class Owner, class Enum, std::size_t Count>
Json fieldSchema(const hair::Choice<Owner, Enum, Count>& row, const Json&) {
    Json names = Json::array();
    for (const auto& named : row.names) names.push_back(named.name);
    return {{"description", row.help}, {"enum", names}};
}

template <class Owner, std::size_t Count>
Json fieldSchema(const hair::OneOf<Owner, Count>& row, const Json&) {
    return {{"description", helpWithUnit(row.help, row.unit)}, {"enum", row.values}};
}

template <class Owner, class Settings>
Json fieldSchema(const hair::Group<Owner, Settings>& row, const Json& defaults) {
    Json schema = {{"description", row.help}};
    schema.update(objectSchema<Settings>(defaults, Removal::possible));
    return schema;
}

template <class Owner, class Element>
Json fieldSchema(const hair::List<Owner, Element>& row, const Json&) {
    return {
        {"description", row.help},
        {"type", "array"},
        {"items", objectSchema<Element>(writeFields(Element{}), Removal::impossible)},
        {"maxItems", row.maximum_count}};
}

void allowNull(Json& schema) {
    if (schema.contains("enum"))
        schema["enum"].push_back(nullptr);
    else
        schema["type"] = Json::array({schema["type"], "null"});
}

template <class Settings>
Json objectSchema(const Json& defaults, Removal removal) {
    Json members = Json::object();
    hair::forEachField<Settings>([&](const auto& row) {
        const Json& value = defaults.at(row.name);
        Json schema = fieldSchema(row, value);
        if (removal == Removal::possible) allowNull(schema);
        if (!value.is_object()) schema["default"] = value;
        members[row.name] = std::move(schema);
    });
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
    schema.update(objectSchema<hair::Settings>(writeFields(hair::Settings{}), Removal::possible));
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
