#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "benchmarks/names.h"
#include "benchmarks/pointer.h"
#include "benchmarks/read_settings.h"
#include "benchmarks/viewer/script/members.h"
#include "benchmarks/viewer/script/verbs.h"
#include "benchmarks/write_settings.h"
#include "engine/error.h"

// Steps about the scene and the window, without mouse and keys.
namespace benchmarks {

namespace {

constexpr int kLongestResize = 200;  // pictures: desktops answer when they like

std::string lowerCase(std::string text) {
    std::ranges::transform(
        text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// "File/Open scene", without the dots that menus have.
std::string fullName(const ActionRow& row) {
    std::string name = std::string(row.menu) + '/' + row.name;
    while (name.ends_with('.') || name.ends_with(' ')) name.pop_back();
    return name;
}

Action actionNamed(const std::string& name, const std::string& pointer) {
    std::vector<std::string> known;
    std::vector<Action> found;
    const std::string wanted = lowerCase(name);
    for (const ActionRow& row : actionTable()) {
        const std::string full = lowerCase(fullName(row));
        known.push_back(fullName(row));
        if (full == wanted || full.substr(full.find('/') + 1) == wanted)
            found.push_back(row.action);
    }
    if (found.size() == 1) return found.front();
    if (found.empty()) throw engine::Error(pointer, unknownName("unknown action", name, known));
    throw engine::Error(pointer, "several menus have a \"" + name + "\"; write <menu>/" + name);
}

}  // namespace

Act readSet(const Json& value, const std::string& pointer, const ScriptFolders&) {
    if (!value.is_object() || value.empty())
        throw engine::Error(
            pointer, "must be an object of settings, as in {\"/strands/density\": 16}");
    std::size_t side = 0;
    std::vector<std::pair<std::string, Json>> fields;
    for (const auto& [field, wanted] : value.items()) {
        if (field == "side") {
            side = countOf(wanted, pointer + "/side");
            continue;
        }
        try {
            pointerTokens(field);
        } catch (const engine::Error& error) {
            throw engine::Error(pointer, error.what());
        }
        fields.emplace_back(field, wanted);
    }
    return [=](Driver& driver) {
        Json document = writeSettings(driver.side(side).wanted());
        for (const auto& [field, wanted] : fields) patch(document, field, wanted);
        driver.viewer.edit(side, readSettings(document));
        driver.settle();
    };
}

Act readPerform(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const Action action = actionNamed(textOf(value, pointer), pointer);
    return [=](Driver& driver) {
        driver.viewer.perform(action);
        driver.settle();
    };
}

Act readDrop(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    std::vector<std::filesystem::path> files;
    for (const std::string& file : textsOf(value, pointer)) files.push_back(folders.script / file);
    return [=](Driver& driver) {
        driver.viewer.drop(files);
        driver.settle();
    };
}

Act readResize(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const auto [width, height] = pairOf(value, pointer);
    if (width < 1.0f || height < 1.0f) throw engine::Error(pointer, "must be 1 or more");
    return [=](Driver& driver) {
        driver.viewer.resize(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
        driver.until(
            [=] {
                const ImVec2 size = ImGui::GetIO().DisplaySize;
                return size.x == width && size.y == height;
            },
            kLongestResize, "the desktop does not give the window that size");
        driver.settle();
    };
}

}  // namespace benchmarks
