#include <nlohmann/json.hpp>

#include "benchmarks/viewer/files/readable_json.h"
#include "benchmarks/viewer/files/save_scene.h"
#include "benchmarks/viewer/script/members.h"
#include "benchmarks/viewer/script/shown_state.h"
#include "benchmarks/viewer/script/verbs.h"
#include "engine/error.h"
#include "engine/image_file.h"
#include "engine/write_file.h"

// Steps that write files.
namespace benchmarks {

namespace {

struct OneSide {
    std::filesystem::path file;
    std::uint32_t side = 0;
};

// A file's name, or an object that also has the side that it is of.
OneSide oneSide(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    if (value.is_string()) return {folders.out / textOf(value, pointer)};
    const Members members(value, pointer, {"file", "side"});
    return {
        folders.out / textOf(members.at("file"), members.pointerOf("file")),
        members.count("side").value_or(0)};
}

}  // namespace

Act readScreenshot(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const std::filesystem::path file = folders.out / textOf(value, pointer);
    return [=](Driver& driver) {
        const engine::Presenter::Picture picture = driver.viewer.picture();
        if (picture.pixels.empty()) throw engine::Error("the window has shown nothing yet");
        engine::writePng(file, picture.width, picture.height, picture.pixels);
    };
}

Act readPicture(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const OneSide wanted = oneSide(value, pointer, folders);
    return [=](Driver& driver) {
        const Player& player = driver.side(wanted.side).player();
        const hair::RenderSettings& render = player.settings().render;
        engine::writePng(wanted.file, render.width, render.height, player.played().picture());
    };
}

Act readSave(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const OneSide wanted = oneSide(value, pointer, folders);
    return [=](Driver& driver) {
        const Player& player = driver.side(wanted.side).player();
        saveScene(player.settings(), player.directory(), wanted.file);
    };
}

Act readState(const Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const std::filesystem::path file = folders.out / textOf(value, pointer);
    return [=](Driver& driver) {
        engine::writeFileAtomically(file, readableJson(shownState(driver)));
    };
}

}  // namespace benchmarks
