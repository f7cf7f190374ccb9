#include "benchmarks/viewer/script/shown_state.h"

#include <nlohmann/json.hpp>

#include "benchmarks/write_settings.h"

namespace benchmarks {

namespace {

Json sideState(const Side& side) {
    const Player& player = side.player();
    return {
        {"frame", player.frame()},
        {"time", player.time()},
        {"preview", player.previews()},
        {"problem", side.problem()},
        {"image_hash", player.played().pictureHash()},
        {"state_hash", player.played().stateHash()},
        {"settings", writeSettings(player.settings())}};
}

Json itemState(const engine::UiItem& item) {
    const engine::UiRect& rect = item.rect;
    Json state{
        {"window", item.window},
        {"label", item.label},
        {"rect", {rect.left, rect.top, rect.right, rect.bottom}},
        {"enabled", item.enabled}};
    if (item.checkable) state["checked"] = item.checked;
    if (item.openable) state["open"] = item.open;
    return state;
}

}  // namespace

Json shownState(const Driver& driver) {
    const Viewer& viewer = driver.viewer;
    const engine::Presenter::Picture picture = viewer.picture();
    Json sides = Json::array();
    for (std::size_t i = 0; i < viewer.sideCount(); ++i) sides.push_back(sideState(viewer.side(i)));
    Json items = Json::array();
    for (const engine::UiItem& item : driver.items.items())
        if (item.visible) items.push_back(itemState(item));
    return {
        {"window", {picture.width, picture.height}},
        {"scale", viewer.scale()},
        {"present_mode", engine::presentModeName(viewer.presentMode())},
        {"message", viewer.message()},
        {"sides", sides},
        {"items", items}};
}

}  // namespace benchmarks
