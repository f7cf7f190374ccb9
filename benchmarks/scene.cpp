#include "benchmarks/scene.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "benchmarks/json_text.h"
#include "benchmarks/merge_patch.h"
#include "benchmarks/pointer.h"
#include "benchmarks/read_settings.h"
#include "benchmarks/screenshot_scene.h"
#include "benchmarks/write_settings.h"
#include "engine/error.h"
#include "engine/png_text.h"
#include "hair/fields.h"

namespace benchmarks {
namespace {

namespace fs = std::filesystem;
using engine::Error;

std::string readFile(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) throw Error(path.string(), "no such file");
    if (fs::is_directory(path, error)) throw Error(path.string(), "is a folder, not a scene file");
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf()).good()) {
        if (file && file.peek() == std::ifstream::traits_type::eof()) return {};  // an empty file
        throw Error(path.string(), "cannot be read");
    }
    return std::move(text).str();
}

// Of a scene file, or of a screenshot that has one in it.
std::string readScene(const fs::path& path) {
    std::string text = readFile(path);
    if (!engine::isPng(text)) return text;
    if (auto scene = sceneOfScreenshot(path)) return *std::move(scene);
    throw Error(path.string(), "is a picture without a scene in it");
}

// Calls `action` and puts the file's name in front of the reasons it throws.
template <class Action>
auto inFile(const fs::path& path, Action&& action) {
    try {
        return action();
    } catch (const Error& error) {
        throw Error(path.string(), error.what());
    }
}

const std::string* stringMember(const Json& document, const char* key) {
    const auto member = document.find(key);
    if (member == document.end()) return nullptr;
    if (!member->is_string())
        throw Error('/' + std::string(key), "expected a string, found " + described(*member));
    return &member->get_ref<const std::string&>();
}

Scene makeScene(const fs::path& path, Json document) {
    Scene scene;
    scene.path = path;
    scene.directory = path.parent_path();
    scene.name = path.stem().string();
    scene.settings = readSettings(document);
    const Json resolved = writeSettings(scene.settings);
    if (const auto member = document.find("sweep"); member != document.end()) {
        SweepMember sweep = readSweep(*member, resolved);
        scene.axes = std::move(sweep.axes);
        scene.exclusions = std::move(sweep.exclusions);
    }
    for (const std::string_view key : kSceneKeys) document.erase(std::string(key));
    scene.document = document.dump();
    scene.resolved = resolved.dump();
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

// File names are relative to the scene that is opened, so a base in another folder has its own
// rewritten, those that it takes from the defaults too.
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

// The document with its bases merged and all of it checked. `opened`: the files that led here.
Json loadDocument(const fs::path& path, std::vector<fs::path> opened) {
    const std::string text = readScene(path);
    Json document = parseJson(text, path.string());
    return inFile(path, [&] {
        if (!document.is_object()) throw Error("expected an object, found " + described(document));
        if (document.contains("suite"))
            throw Error("/suite", "this is a suite of scenes, and one scene is wanted here");
        stringMember(document, "$schema");
        if (const std::string* const base = stringMember(document, "base")) {
            const fs::path base_path = path.parent_path() / *base;
            opened.push_back(fs::weakly_canonical(path));
            if (std::ranges::find(opened, fs::weakly_canonical(base_path)) != opened.end())
                throw Error("/base", base_path.string() + " is built on this file: a cycle");
            Json merged;
            try {
                merged = loadDocument(base_path, opened);
            } catch (const Error& error) {
                throw Error("/base", error.what());
            }
            if (const fs::path folder = fs::path(*base).parent_path(); !folder.empty())
                moveFileNames(merged, folder, readSettings(merged));
            document.erase("base");
            mergePatch(merged, document, everyMember());
            document = std::move(merged);
        }
        makeScene(path, document);
        return document;
    });
}

}  // namespace

Scene loadScene(const fs::path& path) { return makeScene(path, loadDocument(path, {})); }

void setField(Scene& scene, const std::string& pointer, const std::string& value) {
    Json document = Json::parse(scene.document);
    document[Json::json_pointer(pointer)] = Json::parse(value);
    scene.settings = readSettings(document);
    scene.document = document.dump();
    scene.resolved = writeSettings(scene.settings).dump();
}

}  // namespace benchmarks
