#include "benchmarks/viewer/shell/preferences.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/json_fwd.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

using engine::PresentMode;

constexpr std::array kPresentModes{PresentMode::fifo, PresentMode::mailbox, PresentMode::immediate};
constexpr std::array kThemes{Theme::dark, Theme::light};

constexpr float kWidestColumn = 200.0f;

std::filesystem::path folderFrom(const char* variable) {
    const char* const value = std::getenv(variable);
    return value ? value : "";
}

// The member, where it is a number in this range.
template <class Number>
void readNumber(
    const Json& object, const char* name, Number minimum, Number maximum, Number& value) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number()) return;
    const double number = found->get<double>();
    if (number >= static_cast<double>(minimum) && number <= static_cast<double>(maximum))
        value = static_cast<Number>(number);
}

// The member, where it is one of these names.
template <class Values, class Value, class Name>
void readName(
    const Json& object, const char* name, const Values& values, Name nameOf, Value& value) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_string()) return;
    for (const Value each : values)
        if (found->get<std::string>() == nameOf(each)) value = each;
}

void readColumn(const Json& object, const char* name, Column& column) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_object()) return;
    readNumber(*found, "width", kNarrowestColumn, kWidestColumn, column.width);
    const auto shown = found->find("shown");
    if (shown != found->end() && shown->is_boolean()) column.shown = shown->get<bool>();
}

Json columnJson(const Column& column) { return {{"width", column.width}, {"shown", column.shown}}; }

}  // namespace

std::optional<std::filesystem::path> usersPreferences() {
    std::filesystem::path folder = folderFrom("XDG_CONFIG_HOME");
    // The specification has paths that are not absolute ignored.
    if (!folder.is_absolute()) {
        folder = folderFrom("HOME");
        if (!folder.is_absolute()) return std::nullopt;
        folder /= ".config";
    }
    return folder / "hairbench" / "viewer.json";
}

std::string preferencesText(const Preferences& preferences) {
    Json recent = Json::array();
    for (const std::filesystem::path& scene : preferences.recent) recent.push_back(scene.string());
    const Json document{
        {"theme", themeName(preferences.theme)},
        {"zoom", preferences.zoom},
        {"left", columnJson(preferences.left)},
        {"right", columnJson(preferences.right)},
        {"window", {{"width", preferences.width}, {"height", preferences.height}}},
        {"present_mode", engine::presentModeName(preferences.present_mode)},
        {"recent", recent}};
    return document.dump(4, ' ', false, Json::error_handler_t::replace) + '\n';
}

Preferences readPreferences(const std::string& text) {
    const Json document = Json::parse(text, nullptr, false);
    if (!document.is_object()) throw engine::Error("they are no JSON object");
    Preferences preferences;
    readName(document, "theme", kThemes, themeName, preferences.theme);
    readNumber(document, "zoom", kSmallestZoom, kLargestZoom, preferences.zoom);
    readColumn(document, "left", preferences.left);
    readColumn(document, "right", preferences.right);
    if (const auto window = document.find("window");
        window != document.end() && window->is_object()) {
        readNumber(*window, "width", 320u, 16384u, preferences.width);
        readNumber(*window, "height", 240u, 16384u, preferences.height);
    }
    readName(
        document, "present_mode", kPresentModes, engine::presentModeName, preferences.present_mode);
    if (const auto recent = document.find("recent");
        recent != document.end() && recent->is_array()) {
        for (const Json& scene : *recent)
            if (scene.is_string() && preferences.recent.size() < kMostRecent)
                preferences.recent.emplace_back(scene.get<std::string>());
    }
    return preferences;
}

void remember(Preferences& preferences, const std::filesystem::path& scene) {
    std::error_code failed;
    std::filesystem::path path = std::filesystem::absolute(scene, failed).lexically_normal();
    if (failed) path = scene;
    std::erase(preferences.recent, path);
    preferences.recent.insert(preferences.recent.begin(), path);
    if (preferences.recent.size() > kMostRecent) preferences.recent.resize(kMostRecent);
}

}  // namespace benchmarks
