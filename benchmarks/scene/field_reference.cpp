#include "benchmarks/scene/field_reference.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "benchmarks/scene/schema.h"
#include "engine/files.h"

namespace benchmarks::scene {
namespace {

constexpr const char* kHead = R"(# Every field of a scene

`hairbench schema --markdown > docs/fields.md` writes this page, and a test compares the two. A field's pointer is its place in a scene file
(`/strands/density` is `{"strands": {"density": …}}`). It also names an axis (`-a /strands/density=16,64`), a field for `--set`, and a
widget of the viewer. [scenes.md](scenes.md#writing-a-scene) explains bases. In a list, `N` stands for an element's index, from 0.

)";

// Pointer of a field, with N for list indices -> the scene that is its example.
using Examples = std::map<std::string, std::string>;

bool isPlace(const std::string& token) {
    return !token.empty() &&
           std::ranges::all_of(token, [](unsigned char c) { return std::isdigit(c) != 0; });
}

// "/shading/lights/1/power" -> "/shading/lights/N/power".
std::string withoutPlaces(const std::string& pointer) {
    std::string all;
    std::istringstream tokens(pointer);
    std::string token;
    std::getline(tokens, token, '/');  // the empty token before the first slash
    while (std::getline(tokens, token, '/')) all += '/' + (isPlace(token) ? "N" : token);
    return all;
}

// Records the scene as an example of every member that its document sets.
void addExamples(
    const Json& document, const std::string& pointer, const std::string& name, Examples& examples) {
    examples.emplace(pointer, name);
    if (document.is_object())
        for (const auto& [key, value] : document.items())
            addExamples(value, pointer + '/' + key, name, examples);
    if (document.is_array())
        for (const Json& value : document) addExamples(value, pointer + "/N", name, examples);
}

Examples examplesIn(const std::filesystem::path& folder) {
    std::vector<std::pair<std::size_t, std::filesystem::path>> scenes;  // shortest first
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
            scenes.emplace_back(entry.file_size(), entry.path());
    std::ranges::sort(scenes);
    Examples examples;
    for (const auto& [size, path] : scenes) {
        Json document = parseJson(engine::readFile(path), path.string());
        const std::string name = path.lexically_relative(folder).generic_string();
        const Json sweep = document.value("sweep", Json::object());
        document.erase("sweep");
        addExamples(document, "", name, examples);
        if (!sweep.is_object()) continue;
        for (const auto& [axis, values] : sweep.items())
            if (axis.starts_with('/')) examples.emplace(withoutPlaces(axis), name);
    }
    return examples;
}

// Escapes text for a table cell.
std::string escaped(const std::string& text) {
    std::string all;
    for (const char c : text) {
        if (c == '|') all += '\\';
        all += c;
    }
    return all;
}

std::string code(const Json& value) { return '`' + escaped(value.dump()) + '`'; }

// "0 to 10", "one of `a`, `b`", "text".
std::string valuesOf(const Json& schema) {
    if (schema.contains("enum")) {
        std::string all;
        for (const Json& each : schema["enum"]) {
            if (each.is_null()) continue;
            all += (all.empty() ? "" : ", ") + code(each);
        }
        return all;
    }
    if (schema.contains("anyOf")) return valuesOf(schema["anyOf"][0]) + ", file";
    const Json type = schema.value("type", Json());
    const std::string name =
        type.is_array() ? type.at(0).get<std::string>() : type.get<std::string>();
    if (name == "array") {
        const Json& items = schema["items"];
        const std::string of = items.contains("properties") ? "objects" : valuesOf(items);
        if (schema.contains("minItems")) return schema["minItems"].dump() + " × " + of;
        return "list of up to " + schema["maxItems"].dump() + ' ' + of;
    }
    if (name == "object") return "by the file";
    if (name == "string") return "text";
    if (name == "boolean") return "`true`, `false`";
    const std::string range = schema["minimum"].dump() + " to " + schema["maximum"].dump();
    return name == "integer" ? range + ", whole" : range;
}

// Splits "… [kg]" into the description and the unit.
std::pair<std::string, std::string> helpAndUnit(const std::string& description) {
    const std::size_t open = description.rfind(" [");
    if (open == std::string::npos || !description.ends_with(']')) return {description, ""};
    return {
        description.substr(0, open), description.substr(open + 2, description.size() - open - 3)};
}

class Page {
public:
    explicit Page(Examples examples) : examples_(std::move(examples)) {}

    // Adds the fields of an object, then the objects in it, each under a heading.
    void add(const Json& members, const std::string& pointer) {
        bool has_table = false;
        for (const auto& [name, schema] : members.items()) {
            if (schema.contains("properties")) continue;
            if (!std::exchange(has_table, true))
                text_ += "| field | values | unit | default | meaning | example |\n"
                         "|---|---|---|---|---|---|\n";
            addRow(pointer + '/' + name, schema);
        }
        if (has_table) text_ += '\n';
        for (const auto& [name, schema] : members.items()) {
            const bool is_list = schema.contains("items") && schema["items"].contains("properties");
            if (!schema.contains("properties") && !is_list) continue;
            const std::string here = pointer + '/' + name + (is_list ? "/N" : "");
            text_ += "## `" + here + "`: " + schema["description"].get<std::string>() + "\n\n";
            add(is_list ? schema["items"]["properties"] : schema["properties"], here);
        }
    }

    std::string text() && { return std::move(text_); }

private:
    void addRow(const std::string& pointer, const Json& schema) {
        const auto [help, unit] = helpAndUnit(schema["description"].get<std::string>());
        const auto example = examples_.find(pointer);
        text_ += "| `" + pointer + "` | " + valuesOf(schema) + " | " + unit + " | " +
                 (schema.contains("default") ? code(schema["default"]) : "") + " | " +
                 escaped(help) + " | ";
        if (example != examples_.end())
            text_ += '[' + example->second + "](../scenes/" + example->second + ')';
        text_ += " |\n";
    }

    Examples examples_;
    std::string text_ = kHead;
};

}  // namespace

std::string fieldReference(const std::filesystem::path& scenes) {
    Json members = Json::parse(sceneSchema()).at("properties");
    for (const char* const own : {"$schema", "base", "sweep", "suite"}) members.erase(own);
    Page page(examplesIn(scenes));
    page.add(members, "");
    std::string text = std::move(page).text();
    text.pop_back();  // one end of a line is enough
    return text;
}

}  // namespace benchmarks::scene
