#pragma once

#include <optional>
#include <string>

#include "engine/ui_items.h"

namespace benchmarks {

// What a script calls a widget. `item` is what people read on it or what its "##" hides; empty: the
// window itself. `window` is the panel, or a child as "Scene/fields"; empty: any.
struct ItemName {
    std::string item;
    std::string window;
};

// Of those that are seen; none where there is none. Throws engine::Error where there are several.
std::optional<engine::UiItem> findItem(const engine::UiItems& items, const ItemName& name);

// Throws engine::Error with what is there instead.
engine::UiItem itemNamed(const engine::UiItems& items, const ItemName& name);

// "item \"x\" in Scene".
std::string described(const ItemName& name);

}  // namespace benchmarks
