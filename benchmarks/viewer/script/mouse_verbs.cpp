#include <algorithm>
#include <iterator>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/names.h"
#include "benchmarks/viewer/script/key_names.h"
#include "benchmarks/viewer/script/members.h"
#include "benchmarks/viewer/script/place.h"
#include "benchmarks/viewer/script/verbs.h"
#include "engine/error.h"

// Steps of the mouse.
namespace benchmarks {

namespace {

using Change = UserInput::Change;

constexpr int kDragPictures = 6;  // from one end to the other

// In the order of ImGuiMouseButton.
constexpr std::string_view kButtons[] = {"left", "right", "middle"};

int buttonOf(const Members& members) {
    const std::string name = members.text("button").value_or("left");
    const auto found = std::ranges::find(kButtons, name);
    if (found == std::end(kButtons))
        throw engine::Error(
            members.pointerOf("button"),
            unknownName("unknown button", name, {std::begin(kButtons), std::end(kButtons)}));
    return static_cast<int>(found - std::begin(kButtons));
}

// What is held down on the keyboard meanwhile.
int keysOf(const Members& members) {
    const auto keys = members.text("keys");
    return keys ? keyChord(*keys, members.pointerOf("keys")) : 0;
}

void press(Driver& driver, int button, int keys) {
    driver.then([=, &driver] {
        if (keys) driver.input.key(keys, Change::press);
        driver.input.button(button, Change::press);
    });
}

void release(Driver& driver, int button, int keys) {
    driver.then([=, &driver] {
        driver.input.button(button, Change::release);
        if (keys) driver.input.key(keys, Change::release);
    });
}

void moveTo(Driver& driver, std::array<float, 2> to) {
    driver.then([=, &driver] { driver.input.move(to[0], to[1]); });
}

// A label alone is that of an item.
Json asObject(const Json& value) { return value.is_string() ? Json{{"item", value}} : value; }

}  // namespace

Act readMove(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const Json object = asObject(value);
    const Place place = placeOf(Members(object, pointer, {"item", "window", "at"}), "at");
    return [=](Driver& driver) {
        moveTo(driver, pixelsOf(driver, place));
        driver.settle();
    };
}

Act readClick(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const Json object = asObject(value);
    const Members members(object, pointer, {"item", "window", "at", "button", "double", "keys"});
    const Place place = placeOf(members, "at");
    const int button = buttonOf(members), keys = keysOf(members);
    const int clicks = members.flag("double").value_or(false) ? 2 : 1;
    return [=](Driver& driver) {
        moveTo(driver, pixelsOf(driver, place));
        for (int i = 0; i < clicks; ++i) {
            press(driver, button, keys);
            release(driver, button, keys);
        }
        driver.settle();
    };
}

Act readDrag(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const Members members(value, pointer, {"item", "window", "from", "to", "by", "button", "keys"});
    const Place from = placeOf(members, "from");
    const auto to = members.pair("to"), by = members.pair("by");
    if (to.has_value() == by.has_value())
        throw engine::Error(pointer, "needs either \"to\" or \"by\"");
    const int button = buttonOf(members), keys = keysOf(members);
    return [=](Driver& driver) {
        const std::array<float, 2> begin = pixelsOf(driver, from);
        const std::array<float, 2> end = to ? pixelsOf(driver, {.item = from.item, .at = *to})
                                            : std::array{begin[0] + (*by)[0], begin[1] + (*by)[1]};
        moveTo(driver, begin);
        press(driver, button, keys);
        for (int i = 1; i <= kDragPictures; ++i) {
            const float t = static_cast<float>(i) / kDragPictures;
            moveTo(
                driver, {begin[0] + t * (end[0] - begin[0]), begin[1] + t * (end[1] - begin[1])});
        }
        release(driver, button, keys);
        driver.settle();
    };
}

Act readScroll(const Json& value, const std::string& pointer, const ScriptFolders&) {
    const Members members(value, pointer, {"item", "window", "at", "by", "keys"});
    const Place place = placeOf(members, "at");
    const std::array<float, 2> notches = pairOf(members.at("by"), members.pointerOf("by"));
    const int keys = keysOf(members);
    return [=](Driver& driver) {
        moveTo(driver, pixelsOf(driver, place));
        driver.then([=, &driver] {
            if (keys) driver.input.key(keys, Change::press);
            driver.input.wheel(notches[0], notches[1]);
        });
        if (keys) driver.then([=, &driver] { driver.input.key(keys, Change::release); });
        driver.settle();
    };
}

}  // namespace benchmarks
