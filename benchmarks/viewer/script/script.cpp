#include "benchmarks/viewer/script/script.h"

#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/script/input.h"
#include "benchmarks/viewer/script/verbs.h"
#include "engine/files.h"

namespace benchmarks::viewer {
namespace {

// Pictures until panels with automatic size have their final size.
constexpr int kFirstPictures = 3;

Act readStep(const scene::Json& step, const std::string& pointer, const ScriptFolders& folders) {
    if (!step.is_object() || step.size() != 1)
        throw engine::Error(pointer, "expected an object with one verb, as in {\"wait\": 2}");
    const auto only = step.begin();
    const Verb& verb = verbNamed(only.key(), pointer);
    return verb.read(only.value(), pointer + '/' + only.key(), folders);
}

}  // namespace

struct Script::Parts {
    std::string path;
    std::vector<Act> steps;
    std::size_t next = 0;
    std::optional<Driver> driver;
};

Script::Script(const std::filesystem::path& path) : parts_(std::make_unique<Parts>()) {
    parts_->path = path.string();
    const scene::Json document = scene::parseJson(engine::readFile(path), path.string());
    try {
        const Members members(document, "", {"description", "out", "steps"});
        members.text("description");
        ScriptFolders folders{.script = path.parent_path(), .out = {}};
        if (const auto out = members.text("out")) folders.out = *out;
        const scene::Json& steps = members.at("steps");
        if (!steps.is_array()) throw engine::Error("/steps", "expected an array");
        for (std::size_t i = 0; i < steps.size(); ++i)
            parts_->steps.push_back(readStep(steps[i], "/steps/" + std::to_string(i), folders));
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

Script::~Script() = default;

bool Script::step(Viewer& viewer) {
    Parts& parts = *parts_;
    try {
        if (!parts.driver) {
            parts.driver.emplace(viewer);
            viewer.play().playing = false;
            parts.driver->wait(kFirstPictures);
        }
        // Steps that need no picture run at once.
        while (!parts.driver->goOn()) {
            if (parts.next == parts.steps.size()) return false;
            parts.steps[parts.next++](*parts.driver);
        }
        return true;
    } catch (const engine::Error& error) {
        const std::size_t step = parts.next > 0 ? parts.next - 1 : 0;
        throw ScriptFailure(parts.path + ": /steps/" + std::to_string(step) + ": " + error.what());
    }
}

void Script::finish() const {
    if (parts_->next < parts_->steps.size())
        throw ScriptFailure(
            parts_->path + ": /steps/" + std::to_string(parts_->next),
            "the window was closed before this step");
}

}  // namespace benchmarks::viewer
