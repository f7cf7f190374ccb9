#pragma once

#include <array>
#include <optional>
#include <string>

#include "benchmarks/viewer/script/driver.h"
#include "benchmarks/viewer/script/find_item.h"
#include "benchmarks/viewer/script/members.h"

namespace benchmarks {

// A point in the window: of a widget, as shares of its size from its left and top, or in px.
struct Place {
    std::optional<ItemName> item;
    std::array<float, 2> at{0.5f, 0.5f};
};

// A name alone, or an object with "item" and "window", and the point as its member `at`; without an
// item it is in px from the window's top left corner.
std::optional<ItemName> itemOf(const Members& members);
Place placeOf(const Members& members, const char* at);

// px. Throws engine::Error where the widget is not seen; `at` other shares of it.
std::array<float, 2> pixelsOf(const Driver& driver, const Place& place);

}  // namespace benchmarks
