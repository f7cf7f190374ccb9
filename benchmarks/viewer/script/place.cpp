#include "benchmarks/viewer/script/place.h"

#include "engine/error.h"

namespace benchmarks {

std::optional<ItemName> itemOf(const Members& members) {
    const auto item = members.text("item"), window = members.text("window");
    if (!item && !window) return std::nullopt;
    return ItemName{item.value_or(""), window.value_or("")};
}

Place placeOf(const Members& members, const char* at) {
    Place place{.item = itemOf(members)};
    const auto point = members.pair(at);
    if (!place.item && !point)
        throw engine::Error(
            members.pointerOf(at), "is missing: without an item it is a point of the window, px");
    if (point) place.at = *point;
    return place;
}

std::array<float, 2> pixelsOf(const Driver& driver, const Place& place) {
    if (!place.item) return place.at;
    const engine::UiItem item = itemNamed(driver.items, *place.item);
    if (!item.enabled) throw engine::Error(described(*place.item) + " is grayed out");
    return {
        item.rect.left + place.at[0] * item.rect.width(),
        item.rect.top + place.at[1] * item.rect.height()};
}

}  // namespace benchmarks
