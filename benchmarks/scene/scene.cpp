#include "benchmarks/scene/scene.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/png_text.h"
#include "hair/fields.h"

namespace benchmarks::scene {
namespace {

namespace fs = std::filesystem;

// ---- Merge patch of a base ----------------------------------------------------------------------

void requireRemovable(
    const Json& target, const Json& known, const std::string& key, const std::string& pointer) {
    if (target.contains(key) || known.contains(key)) return;
    std::vector<std::string> names;
    for (const Json* object : {&known, &target})
        for (const auto& [name, value] : object->items())
            if (object == &known || !known.contains(name)) names.push_back(name);
    throw engine::Error(
        pointer, names.empty() ? "the base has nothing to remove here"
                               : unknownName("nothing to remove", key, names));
}

void merge(Json& target, const Json& patch, const Json& known, const std::string& pointer) {
    if (!target.is_object()) target = Json::object();
    for (const auto& [key, value] : patch.items()) {
        const std::string here = pointer + '/' + escapedToken(key);
        const auto found = known.find(key);
        const bool is_known = found != known.end() && found->is_object();
        if (value.is_null()) {
            requireRemovable(target, known, key, here);
            target.erase(key);
        } else if (value.is_object()) {
            merge(target[key], value, is_known ? *found : Json::object(), here);
        } else {
            target[key] = value;
        }
    }
}

}  // namespace

void mergePatch(Json& target, const Json& patch, const Json& known) {
    merge(target, patch, known, "");
}

// ---- Scene in a screenshot ----------------------------------------------------------------------

std::optional<std::string> sceneOfScreenshot(const std::filesystem::path& path) {
    const std::string file = engine::readFile(path);
    try {
        return engine::pngText(file, kSceneKeyword);
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

namespace {

// ---- Scene file ---------------------------------------------------------------------------------

// Calls `action` and prepends the file's name to its errors.
template <class Action>
auto inFile(const fs::path& path, Action&& action) {
    try {
        return action();
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

// Returns the text of a scene file, or of the scene in a screenshot.
std::string readScene(const fs::path& path) {
    if (std::error_code error; fs::is_directory(path, error))
        throw engine::Error(path.string(), "is a folder, not a scene file");
    constexpr std::size_t kLargestScene = std::size_t{16} << 20;
    std::string text = engine::readFile(path, kLargestSceneFile);
    if (!engine::isPng(text)) {
        if (text.size() > kLargestScene)
            throw engine::Error(
                path.string(),
                "is larger than 16 MiB, the limit of a scene file, and is not a picture");
        return text;
    }
    auto scene = inFile(path, [&] { return engine::pngText(text, kSceneKeyword); });
    if (scene) return *std::move(scene);
    throw engine::Error(path.string(), "is a picture without a scene in it");
}

const std::string* stringMember(const Json& document, const char* key) {
    const auto member = document.find(key);
    if (member == document.end()) return nullptr;
    if (!member->is_string())
        throw engine::Error(
            '/' + std::string(key), "expected a string, found " + described(*member));
    return &member->get_ref<const std::string&>();
}

Scene makeScene(const fs::path& path, Json document, const Reach& reach) {
    Scene scene;
    scene.path = path;
    scene.directory = path.parent_path();
    scene.name = engine::shownText(path.stem().string());
    scene.settings = readSettings(document);
    loadExtensions(scene.settings, scene.directory, reach);
    Json resolved = writeSettings(scene.settings);
    if (const auto member = document.find("sweep"); member != document.end()) {
        SweepMember sweep = readSweep(*member, resolved);
        scene.axes = std::move(sweep.axes);
        scene.exclusions = std::move(sweep.exclusions);
    }
    for (const std::string_view key : kSceneKeys) document.erase(std::string(key));
    scene.document = Document(std::move(document));
    scene.resolved = Document(std::move(resolved));
    return scene;
}

void moveFileNames(Json& object, const fs::path& folder, hair::SettingsView settings);

void moveFileName(Json&, const char*, const fs::path&, const hair::Place&, hair::SettingsView) {}

void moveFileName(
    Json& object, const char* name, const fs::path& folder, const hair::FileName& row,
    hair::SettingsView settings) {
    const fs::path file = row.in(settings);
    if (!file.empty() && file.is_relative())
        object[name] = (folder / file).lexically_normal().string();
}

void moveFileName(
    Json& object, const char* name, const fs::path& folder, const hair::ChoiceOrFile& row,
    hair::SettingsView settings) {
    moveFileName(object, name, folder, hair::FileName{{row.file}}, settings);
}

void moveFileName(
    Json& object, const char* name, const fs::path& folder, const hair::Group& row,
    hair::SettingsView settings) {
    Json member = object.contains(name) ? object[name] : Json::object();
    moveFileNames(member, folder, row.in(settings));
    if (!member.empty()) object[name] = std::move(member);
}

void moveFileName(
    Json& object, const char* name, const fs::path& folder, const hair::List& row,
    hair::SettingsView settings) {
    if (!object.contains(name)) return;  // defaults of lists name no files
    for (std::size_t i = 0; i < row.size(settings); ++i)
        moveFileNames(object[name][i], folder, row.at(settings, i));
}

// File names are relative to the opened scene, so file names from a base in another folder are
// rewritten, including its defaults.
void moveFileNames(Json& object, const fs::path& folder, hair::SettingsView settings) {
    for (const hair::Field& field : settings.fields())
        std::visit(
            [&](const auto& row) { moveFileName(object, field.name, folder, row, settings); },
            field.kind);
}

Json everyMember() {
    Json known = writeSettings({});
    for (const std::string_view key : kSceneKeys) known[std::string(key)] = Json::object();
    return known;
}

struct Loaded {
    Scene scene;
    Json document;  // source of the scene: bases merged, with the scene reader's own members
};

constexpr std::size_t kMostBases = 16;

void checkValues(const Scene& scene, const Axis& axis) {
    for (const Document& value : axis.values)
        checkNamedFiles(value.json(), axis.pointer, scene.directory, scene.reach);
}

// `opened` lists the files that led here.
Loaded load(const fs::path& path, const Reach& reach, std::vector<fs::path> opened) {
    const std::string text = readScene(path);
    Json document = parseJson(text, path.string());
    return inFile(path, [&] {
        if (!document.is_object())
            throw engine::Error("expected an object, found " + described(document));
        if (document.contains("suite"))
            throw engine::Error("/suite", "is a suite of scenes; expected a single scene");
        stringMember(document, "$schema");
        if (const std::string* const base = stringMember(document, "base")) {
            const fs::path base_path = path.parent_path() / *base;
            opened.push_back(fs::weakly_canonical(path));
            if (opened.size() > kMostBases)
                throw engine::Error(
                    "/base",
                    "the chain of bases is longer than " + std::to_string(kMostBases) + " scenes");
            if (std::ranges::find(opened, fs::weakly_canonical(base_path)) != opened.end())
                throw engine::Error(
                    "/base", base_path.string() + " is built on this file: a cycle");
            Loaded loaded;
            try {
                reach.check(base_path);
                loaded = load(base_path, reach, opened);
            } catch (const engine::Error& error) {
                throw engine::Error("/base", error.what());
            }
            Json& merged = loaded.document;
            if (const fs::path folder = fs::path(*base).parent_path(); !folder.empty())
                moveFileNames(merged, folder, loaded.scene.settings);
            document.erase("base");
            mergePatch(merged, document, everyMember());
            document = std::move(merged);
        }
        Scene scene = makeScene(path, document, reach);
        return Loaded{.scene = std::move(scene), .document = std::move(document)};
    });
}

}  // namespace

Scene loadScene(const fs::path& path, Outside outside) {
    return loadScene(path, Reach(path, outside));
}

Scene loadScene(const fs::path& path, const Reach& reach) {
    Scene scene = load(path, reach, {}).scene;
    scene.reach = reach;
    inFile(path, [&] {
        checkNamedFiles(scene.resolved.json(), "", scene.directory, reach);
        for (const Axis& axis : scene.axes) {
            checkValues(scene, axis);
            for (const Axis& other : axis.tied) checkValues(scene, other);
        }
    });
    return scene;
}

namespace {

// Removes parameters that the settings do not have.
void dropParameters(Json& document, const Json& settings) {
    for (const ExtensionField& field : kExtensionFields) {
        const Json::json_pointer pointer(field.parameters);
        if (!document.contains(pointer)) continue;
        const Json written = document[pointer];
        for (const auto& [name, value] : written.items())
            if (!settings.at(pointer).contains(name)) document[pointer].erase(name);
    }
}

}  // namespace

void setField(Scene& scene, const std::string& pointer, const Json& value) {
    Json document = scene.document.json();
    document[Json::json_pointer(pointer)] = value;
    scene.settings = readSettings(document);
    // Files that the user names may lie anywhere. Another file need not have the parameters of the
    // previous one.
    const auto names = [&](const ExtensionField& field) {
        return (std::string(field.pointer) + '/').starts_with(pointer + '/');
    };
    const bool other = std::ranges::any_of(kExtensionFields, names);
    loadExtensions(
        scene.settings, scene.directory, {},
        other ? UnknownParameters::dropped : UnknownParameters::refused);
    if (other) dropParameters(document, writeSettings(scene.settings));
    scene.document = Document(std::move(document));
    scene.resolved = Document(writeSettings(scene.settings));
}

}  // namespace benchmarks::scene
