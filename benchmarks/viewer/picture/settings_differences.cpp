#include "benchmarks/viewer/picture/settings_differences.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "benchmarks/pointer.h"
#include "benchmarks/write_settings.h"

namespace benchmarks {

namespace {

bool isListOfGroups(const Json& value) {
    return value.is_array() && !value.empty() && value.front().is_object();
}

// A vector has spaces where its line may be broken.
std::string textOf(const Json* value) {
    if (!value) return "";
    if (!value->is_array()) return value->dump();
    std::string text;
    for (const Json& element : *value) text += (text.empty() ? "" : ", ") + element.dump();
    return '[' + text + ']';
}

// Null: there is none.
void compare(
    const std::string& pointer, const Json* a, const Json* b,
    std::vector<SettingDifference>& differences) {
    if (a && b && *a == *b) return;
    if (a && b && a->is_object() && b->is_object()) {
        // Both are written from one table, so they have the same members.
        for (const auto& [key, value] : a->items())
            compare(pointer + '/' + escapedToken(key), &value, &b->at(key), differences);
        return;
    }
    if (a && b && (isListOfGroups(*a) || isListOfGroups(*b))) {
        for (std::size_t i = 0; i < std::max(a->size(), b->size()); ++i) {
            compare(
                pointer + '/' + std::to_string(i), i < a->size() ? &a->at(i) : nullptr,
                i < b->size() ? &b->at(i) : nullptr, differences);
        }
        return;
    }
    differences.push_back({pointer, textOf(a), textOf(b)});
}

}  // namespace

std::vector<SettingDifference>
settingsDifferences(const hair::Settings& a, const hair::Settings& b) {
    const Json a_document = writeSettings(a), b_document = writeSettings(b);
    std::vector<SettingDifference> differences;
    compare("", &a_document, &b_document, differences);
    return differences;
}

}  // namespace benchmarks
