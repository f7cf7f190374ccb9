#include "benchmarks/viewer/script/find_item.h"

#include <algorithm>
#include <vector>

#include "benchmarks/names.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

bool isIn(const std::string& window, const std::string& wanted) {
    return wanted.empty() || window == wanted || window.starts_with(wanted + '/');
}

// What "##" hides: "##/strands/density" is "/strands/density".
std::string hiddenPart(const std::string& label) {
    const std::size_t at = label.find("##");
    if (at == std::string::npos) return {};
    return label.substr(std::min(label.find_first_not_of('#', at), label.size()));
}

bool isCalled(const engine::UiItem& item, const ItemName& name) {
    if (name.item.empty()) return item.is_window && item.window == name.window;
    if (item.label.empty() || !isIn(item.window, name.window)) return false;
    return item.text() == name.item || item.label == name.item ||
           hiddenPart(item.label) == name.item;
}

}  // namespace

std::string described(const ItemName& name) {
    if (name.item.empty()) return "window \"" + name.window + '"';
    return "item \"" + name.item + '"' + (name.window.empty() ? "" : " in " + name.window);
}

std::optional<engine::UiItem> findItem(const engine::UiItems& items, const ItemName& name) {
    std::optional<engine::UiItem> found;
    for (const engine::UiItem& item : items.items()) {
        if (!item.visible || !isCalled(item, name)) continue;
        if (found && !name.item.empty()) {
            // A panel has its name on it, and so may a button.
            if (item.is_window) continue;
            if (!found->is_window)
                throw engine::Error(
                    "there are several: " + described(name) + ", in " + found->window + " and in " +
                    item.window);
        }
        found = item;
    }
    return found;
}

engine::UiItem itemNamed(const engine::UiItems& items, const ItemName& name) {
    if (const auto item = findItem(items, name)) return *item;
    const bool wants_window = name.item.empty();
    std::vector<std::string> known;
    for (const engine::UiItem& item : items.items()) {
        if (!item.visible || item.is_window != wants_window) continue;
        if (!wants_window && !isIn(item.window, name.window)) continue;
        const std::string text = wants_window          ? item.window
                                 : item.text().empty() ? hiddenPart(item.label)
                                                       : item.text();
        if (!text.empty() && std::ranges::find(known, text) == known.end()) known.push_back(text);
    }
    throw engine::Error(unknownName(
        "no " + described(name) + " is seen", wants_window ? name.window : name.item, known));
}

}  // namespace benchmarks
