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

Scene makeScene(const fs::path& path, const Json& document, const Reach& reach) {
    Scene scene;
    scene.path = path;
    scene.directory = path.parent_path();
    scene.name = engine::shownText(path.stem().string());
    scene.settings = scene.written = readSettings(document);
    loadExtensions(scene.settings, scene.directory, reach);
    if (const auto member = document.find("sweep"); member != document.end()) {
        SweepMember sweep = readSweep(*member, scene.settings);
        scene.axes = std::move(sweep.axes);
        scene.exclusions = std::move(sweep.exclusions);
    }
    scene.resolved = Document(writeSettings(scene.settings));
    return scene;
}

// File names are relative to the opened scene, so file names from a base in another folder are
// rewritten, including its defaults.
void moveFileNames(Json& document, const fs::path& folder, hair::Settings settings) {
    forEachFileName(settings, [&](const std::string& pointer, const fs::path& file) {
        if (file.is_relative())
            document[Json::json_pointer(pointer)] =
                (folder / file).lexically_normal().generic_string();
    });
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
    hair::Settings settings = scene.settings;
    for (const Document& value : axis.values) {
        setField(settings, axis.pointer, value.json());
        checkNamedFiles(settings, axis.pointer, scene.directory, scene.reach);
    }
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
        checkNamedFiles(scene.settings, "", scene.directory, reach);
        for (const Axis& axis : scene.axes) {
            checkValues(scene, axis);
            for (const Axis& other : axis.tied) checkValues(scene, other);
        }
    });
    return scene;
}

void setField(Scene& scene, const std::string& pointer, const Json& value) {
    hair::Settings written = scene.written;
    setField(written, pointer, value, Objects::replaced);
    // Files that the user names may lie anywhere. Another file need not have the parameters of the
    // previous one.
    const auto names = [&](const ExtensionField& field) {
        return (std::string(field.pointer) + '/').starts_with(pointer + '/');
    };
    const bool other = std::ranges::any_of(kExtensionFields, names);
    hair::Settings settings = written;
    loadExtensions(
        settings, scene.directory, {},
        other ? UnknownParameters::dropped : UnknownParameters::refused);
    for (const ExtensionField& field : kExtensionFields)
        std::erase_if(parametersOf(written, field.kind).values, [&](const auto& parameter) {
            return std::ranges::none_of(
                parametersOf(settings, field.kind).values,
                [&](const auto& known) { return known.name == parameter.name; });
        });
    scene.resolved = Document(writeSettings(settings));
    scene.written = std::move(written);
    scene.settings = std::move(settings);
}

}  // namespace benchmarks::scene
