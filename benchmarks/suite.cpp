#include "benchmarks/suite.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "benchmarks/json_text.h"
#include "benchmarks/pointer.h"
#include "engine/error.h"
#include "engine/read_file.h"

namespace benchmarks {

namespace {

using engine::Error;

// Null where the file is none: loadScene() says what is wrong with it.
Json suiteDocument(const std::filesystem::path& path) {
    if (!std::filesystem::is_regular_file(path)) return nullptr;
    const std::string text = engine::readFile(path);
    // Only a file that has the word can be one, and scenes are not parsed twice.
    if (text.find("\"suite\"") == std::string::npos) return nullptr;
    Json document = parseJson(text, path.string());
    if (!document.is_object() || !document.contains("suite")) return nullptr;
    return document;
}

void checkMembers(const Json& document) {
    for (const auto& [key, value] : document.items()) {
        if (key != "$schema" && key != "description" && key != "suite")
            throw Error('/' + key, "is no member of a suite: $schema, description, suite");
        if (key != "suite" && !value.is_string())
            throw Error('/' + key, "expected a string, found " + described(value));
    }
    const Json& suite = document["suite"];
    if (!suite.is_array() || suite.empty())
        throw Error("/suite", "expected a list of scene files, found " + described(suite));
    for (const Json& file : suite)
        if (!file.is_string())
            throw Error("/suite", "expected names of scene files, found " + described(file));
}

}  // namespace

bool isSuite(const std::filesystem::path& path) { return !suiteDocument(path).is_null(); }

std::vector<Scene> loadScenes(const std::filesystem::path& path) {
    const Json document = suiteDocument(path);
    std::vector<Scene> scenes;
    if (document.is_null()) {
        scenes.push_back(loadScene(path));
        return scenes;
    }
    try {
        checkMembers(document);
        for (const Json& file : document["suite"]) {
            const std::filesystem::path member = path.parent_path() / file.get<std::string>();
            if (isSuite(member)) throw Error("/suite", member.string() + " is a suite itself");
            scenes.push_back(loadScene(member));
            const std::string& name = scenes.back().name;
            if (std::ranges::count(scenes, name, &Scene::name) > 1)
                throw Error("/suite", "two scenes are called " + name);
        }
    } catch (const Error& error) {
        throw Error(path.string(), error.what());
    }
    return scenes;
}

}  // namespace benchmarks
