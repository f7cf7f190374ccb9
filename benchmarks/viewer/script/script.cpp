#include "benchmarks/viewer/script/script.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <iterator>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/pattern.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/viewer/actions.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/scene_file.h"
#include "engine/files.h"
#include "engine/pictures.h"

namespace benchmarks::viewer {
namespace {

// ---- Steps that check expectations --------------------------------------------------------------

// Checks one member of "expect" on a side.
using Check = std::function<void(const Driver&, const Side& side)>;

struct Expectation {
    const char* name;
    Check (*read)(
        const scene::Json& value, const std::string& pointer, const ScriptFolders& folders);
};

[[noreturn]] void fail(const std::string& text) { throw engine::Error(text); }

void checkTrue(const scene::Json& value, const std::string& pointer) {
    if (!flagOf(value, pointer)) throw engine::Error(pointer, "expected true");
}

Check readHash(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::string wanted = stringOf(value, pointer);
    return [=](const Driver&, const Side& side) {
        const std::string hash = side.shown().pictureHash();
        if (hash != wanted) fail("the picture's hash is " + hash + ", not " + wanted);
    };
}

// Returns the first side's picture hash from a file written by "state".
std::string hashIn(const std::filesystem::path& file) {
    const scene::Json state = scene::parseJson(engine::readFile(file), file.string());
    const scene::Json::json_pointer place("/sides/0/image_hash");
    if (!state.contains(place)) throw engine::Error(file.string(), "has no /sides/0/image_hash");
    return state.at(place).get<std::string>();
}

Check readSameHash(
    const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const std::filesystem::path file = folders.out / stringOf(value, pointer);
    return [=](const Driver&, const Side& side) {
        const std::string hash = side.shown().pictureHash(), other = hashIn(file);
        if (hash != other)
            fail("the picture's hash is " + hash + ", and " + file.string() + " has " + other);
    };
}

Check readOtherHash(
    const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const std::filesystem::path file = folders.out / stringOf(value, pointer);
    return [=](const Driver&, const Side& side) {
        if (side.shown().pictureHash() == hashIn(file))
            fail("the picture is the same as in " + file.string());
    };
}

Check readFrame(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::uint32_t wanted = countOf(value, pointer);
    return [=](const Driver&, const Side& side) {
        const std::uint32_t frame = side.shown().frame;
        if (frame != wanted)
            fail("it is frame " + std::to_string(frame) + ", not " + std::to_string(wanted));
    };
}

Check readSetting(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    if (!value.is_object())
        throw engine::Error(pointer, "expected an object, as in {\"/strands/density\": 16}");
    return [=](const Driver&, const Side& side) {
        for (const auto& [field, wanted] : value.items()) {
            const scene::Json is = scene::valueAt(side.shown().settings, field);
            if (is != wanted) fail(field + " is " + is.dump() + ", not " + wanted.dump());
        }
    };
}

Check readNoProblem(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    checkTrue(value, pointer);
    return [](const Driver&, const Side& side) {
        if (!side.problem().empty()) fail("there is a problem: " + side.problem());
    };
}

scene::Pattern patternOf(const scene::Json& value, const std::string& pointer) {
    try {
        return scene::Pattern(stringOf(value, pointer));
    } catch (const engine::Error&) {
        throw engine::Error(pointer, "is not a regular expression");
    }
}

void checkText(const char* what, const std::string& text, const scene::Pattern& wanted) {
    if (!wanted.isIn(text)) fail(std::string(what) + " is \"" + text + "\", which does not match");
}

Check readProblem(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    return [wanted = patternOf(value, pointer)](const Driver&, const Side& side) {
        checkText("the problem", side.problem(), wanted);
    };
}

Check readMessage(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    return [wanted = patternOf(value, pointer)](const Driver& driver, const Side&) {
        checkText("the message", driver.viewer.message(), wanted);
    };
}

Check readClipboard(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    return [wanted = patternOf(value, pointer)](const Driver&, const Side&) {
        const char* const text = ImGui::GetClipboardText();
        checkText("the clipboard", text ? text : "", wanted);
    };
}

Check readSides(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::uint32_t wanted = countOf(value, pointer);
    return [=](const Driver& driver, const Side&) {
        if (driver.viewer.sideCount() != wanted)
            fail("the window shows " + std::to_string(driver.viewer.sideCount()) + " sides");
    };
}

void checkFlag(const ItemName& name, const char* what, bool is, std::optional<bool> wanted) {
    if (wanted && is != *wanted) fail(described(name) + (is ? " is " : " is not ") + what);
}

Check readItem(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const scene::Json object = value.is_string() ? scene::Json{{"item", value}} : value;
    const Members members(
        object, pointer, {"item", "window", "seen", "enabled", "checked", "open"});
    const auto name = itemOf(members);
    if (!name) throw engine::Error(pointer, "needs an 'item' or a 'window'");
    const auto seen = members.flag("seen"), enabled = members.flag("enabled"),
               checked = members.flag("checked"), open = members.flag("open");
    return [=](const Driver& driver, const Side&) {
        if (seen == false) {
            if (findItem(driver.items, *name)) fail(described(*name) + " is visible");
            return;
        }
        const engine::UiItem item = itemNamed(driver.items, *name);
        checkFlag(*name, "enabled", item.enabled, enabled);
        checkFlag(*name, "checked", item.checked, checked);
        checkFlag(*name, "open", item.open, open);
    };
}

// Fails if there are faults, and lists the first few.
void checkNone(const std::vector<std::string>& faults) {
    constexpr std::size_t kMost = 5;
    if (faults.empty()) return;
    std::string text;
    for (std::size_t i = 0; i < std::min(faults.size(), kMost); ++i)
        text += (i > 0 ? "; " : "") + faults[i];
    if (faults.size() > kMost) text += "; and " + std::to_string(faults.size() - kMost) + " more";
    fail(text);
}

Check readNothingClipped(
    const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    checkTrue(value, pointer);
    return [](const Driver& driver, const Side&) { checkNone(clippedText(driver.items)); };
}

Check readNothingOutside(
    const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    checkTrue(value, pointer);
    return [](const Driver& driver, const Side&) { checkNone(outsideItems(driver.items)); };
}

constexpr Expectation kExpectations[] = {
    {"hash", readHash},
    {"same_hash_as", readSameHash},
    {"other_hash_than", readOtherHash},
    {"frame", readFrame},
    {"setting", readSetting},
    {"no_problem", readNoProblem},
    {"problem", readProblem},
    {"message", readMessage},
    {"clipboard", readClipboard},
    {"sides", readSides},
    {"item", readItem},
    {"nothing_clipped", readNothingClipped},
    {"nothing_outside", readNothingOutside},
};

Act readExpect(const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    std::vector<const char*> known{"side"};
    for (const Expectation& row : kExpectations) known.push_back(row.name);
    const Members members(value, pointer, known);
    const std::uint32_t side = members.count("side").value_or(0);
    std::vector<Check> checks;
    for (const Expectation& row : kExpectations)
        if (members.has(row.name))
            checks.push_back(row.read(members.at(row.name), members.pointerOf(row.name), folders));
    if (checks.empty()) throw engine::Error(pointer, "expects nothing");
    return [=](Driver& driver) {
        for (const Check& check : checks) check(driver, driver.side(side));
    };
}

// ---- Steps that write files ---------------------------------------------------------------------

scene::Json sideState(const Side& side) {
    const Shown& shown = side.shown();
    return {
        {"frame", shown.frame},
        {"time", shown.time()},
        {"preview", shown.previews},
        {"level", shown.level},
        {"problem", side.problem()},
        {"image_hash", shown.pictureHash()},
        {"state_hash", shown.stateHash()},
        {"settings", scene::writeSettings(shown.settings)}};
}

scene::Json itemState(const engine::UiItem& item) {
    const engine::UiRect& rect = item.rect;
    scene::Json state{
        {"window", item.window},
        {"label", item.label},
        {"rect", {rect.left, rect.top, rect.right, rect.bottom}},
        {"enabled", item.enabled}};
    if (item.checkable) state["checked"] = item.checked;
    if (item.openable) state["open"] = item.open;
    return state;
}

// Returns the window's state: its size in px, the scale of letters, the message, each side's frame,
// hashes and settings, and every widget of the last picture.
scene::Json shownState(const Driver& driver) {
    const Viewer& viewer = driver.viewer;
    const engine::Presenter::Picture picture = viewer.picture();
    scene::Json sides = scene::Json::array();
    for (std::size_t i = 0; i < viewer.sideCount(); ++i) sides.push_back(sideState(viewer.side(i)));
    scene::Json items = scene::Json::array();
    for (const engine::UiItem& item : driver.items.items())
        if (item.visible) items.push_back(itemState(item));
    return {
        {"window", {picture.width, picture.height}},
        {"scale", viewer.scale()},
        {"present_mode", engine::presentModeName(viewer.presentMode())},
        {"message", viewer.message()},
        {"slowest_answer", viewer.slowestAnswer()},
        {"pictures_per_second", viewer.picturesPerSecond()},
        {"sides", sides},
        {"items", items}};
}

struct OneSide {
    std::filesystem::path file;
    std::uint32_t side = 0;
};

// Reads a file name, or an object that also has a side.
OneSide
oneSide(const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    if (value.is_string()) return {folders.out / stringOf(value, pointer)};
    const Members members(value, pointer, {"file", "side"});
    return {
        folders.out / stringOf(members.at("file"), members.pointerOf("file")),
        members.count("side").value_or(0)};
}

Act readScreenshot(
    const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const std::filesystem::path file = folders.out / stringOf(value, pointer);
    return [=](Driver& driver) {
        const engine::Presenter::Picture picture = driver.viewer.picture();
        if (picture.pixels.empty()) throw engine::Error("the window has shown nothing yet");
        engine::writePng(file, picture.width, picture.height, picture.pixels);
    };
}

Act readPicture(
    const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const OneSide wanted = oneSide(value, pointer, folders);
    return [=](Driver& driver) {
        const Shown& shown = driver.side(wanted.side).shown();
        engine::writePng(wanted.file, shown.width, shown.height, shown.picture);
    };
}

Act readSave(const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const OneSide wanted = oneSide(value, pointer, folders);
    return [=](Driver& driver) {
        const Shown& shown = driver.side(wanted.side).shown();
        saveScene(shown.settings, shown.directory, wanted.file);
    };
}

Act readState(const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    const std::filesystem::path file = folders.out / stringOf(value, pointer);
    return [=](Driver& driver) {
        engine::writeFileAtomically(file, readableJson(shownState(driver)));
    };
}

// ---- Steps of the keyboard ----------------------------------------------------------------------

Act readKey(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const int chord = keyChord(stringOf(value, pointer), pointer);
    return [=](Driver& driver) {
        driver.then([=, &driver] { driver.input.key(chord, UserInput::Change::press); });
        driver.then([=, &driver] { driver.input.key(chord, UserInput::Change::release); });
        driver.settle();
    };
}

Act readType(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::string text = stringOf(value, pointer);
    return [=](Driver& driver) {
        driver.then([=, &driver] { driver.input.type(text); });
        driver.settle();
    };
}

// ---- Steps of the mouse -------------------------------------------------------------------------

using Change = UserInput::Change;

constexpr int kDragPictures = 6;  // pictures per drag

// In the order of ImGuiMouseButton.
constexpr std::string_view kButtons[] = {"left", "right", "middle"};

int buttonOf(const Members& members) {
    const std::string name = members.text("button").value_or("left");
    const auto found = std::ranges::find(kButtons, name);
    if (found == std::end(kButtons))
        throw engine::Error(
            members.pointerOf("button"),
            scene::unknownName("unknown button", name, {std::begin(kButtons), std::end(kButtons)}));
    return static_cast<int>(found - std::begin(kButtons));
}

// Returns the keys to hold during a mouse action.
int keysOf(const Members& members) {
    const auto keys = members.text("keys");
    return keys ? keyChord(*keys, members.pointerOf("keys")) : 0;
}

// `at`: a place to move to within the same picture of the window.
void press(
    Driver& driver, int button, int keys, std::optional<std::array<float, 2>> at = std::nullopt) {
    driver.then([=, &driver] {
        if (at) driver.input.move((*at)[0], (*at)[1]);
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

// A bare label names an item.
scene::Json asObject(const scene::Json& value) {
    return value.is_string() ? scene::Json{{"item", value}} : value;
}

Act readMove(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const scene::Json object = asObject(value);
    const Place place = placeOf(Members(object, pointer, {"item", "window", "at"}), "at");
    return [=](Driver& driver) {
        moveTo(driver, pixelsOf(driver, place));
        driver.settle();
    };
}

Act readClick(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const scene::Json object = asObject(value);
    const Members members(
        object, pointer, {"item", "window", "at", "button", "double", "hasty", "keys"});
    const Place place = placeOf(members, "at");
    const int button = buttonOf(members), keys = keysOf(members);
    const int clicks = members.flag("double").value_or(false) ? 2 : 1;
    const bool is_hasty = members.flag("hasty").value_or(false);
    return [=](Driver& driver) {
        const std::array<float, 2> to = pixelsOf(driver, place);
        if (!is_hasty) moveTo(driver, to);
        for (int i = 0; i < clicks; ++i) {
            press(driver, button, keys, is_hasty ? std::optional(to) : std::nullopt);
            release(driver, button, keys);
        }
        driver.settle();
    };
}

Act readDrag(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const Members members(
        value, pointer, {"item", "window", "from", "to", "by", "button", "keys", "holds"});
    const bool holds = members.flag("holds").value_or(false);
    const Place from = placeOf(members, "from");
    const auto to = members.pair("to"), by = members.pair("by");
    if (to.has_value() == by.has_value()) throw engine::Error(pointer, "needs either 'to' or 'by'");
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
        if (!holds) release(driver, button, keys);
        driver.settle();
    };
}

Act readScroll(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
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

// ---- Steps about time ---------------------------------------------------------------------------

Act readWait(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const auto pictures = static_cast<int>(countOf(value, pointer));
    return [=](Driver& driver) { driver.wait(pictures); };
}

Act readFrames(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::uint32_t frames = countOf(value, pointer);
    return [=](Driver& driver) {
        driver.viewer.play().playing = false;
        for (std::uint32_t i = 0; i < frames; ++i)
            driver.then([&driver] { driver.viewer.play().step = true; });
        driver.settle();
    };
}

Act readPlay(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const bool playing = flagOf(value, pointer);
    return [=](Driver& driver) {
        driver.viewer.play().playing = playing;
        if (!playing) driver.settle();
    };
}

Act readLive(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const bool live = flagOf(value, pointer);
    return [=](Driver& driver) { driver.viewer.setLive(live); };
}

constexpr int kLongestThumbnails = 60 * 60;  // s
constexpr std::chrono::milliseconds kThumbnailLook{10};

// Waits until all scenes in sight have their pictures.
Act readThumbnails(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    checkTrue(value, pointer);
    return [](Driver& driver) {
        driver.viewer.setThumbnails(true);
        driver.settle();
        driver.until(
            [&driver] {
                const bool all = driver.viewer.missingThumbnails() == 0;
                if (!all) std::this_thread::sleep_for(kThumbnailLook);
                return all;
            },
            kLongestThumbnails * static_cast<int>(std::chrono::seconds(1) / kThumbnailLook),
            "thumbnails take too long");
        driver.settle();
    };
}

Act readSeek(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const std::uint32_t frame = countOf(value, pointer);
    return [=](Driver& driver) {
        driver.viewer.play().seek = frame;
        driver.settle();
    };
}

// ---- Steps about the scene and the window -------------------------------------------------------

constexpr int kLongestResize = 200;  // pictures; a desktop may take a while to answer

// "File/Open", without the dots of menu items.
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
    if (found.empty())
        throw engine::Error(pointer, scene::unknownName("unknown action", name, known));
    throw engine::Error(pointer, "several menus have a '" + name + "'; write <menu>/" + name);
}

Act readSet(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    if (!value.is_object() || value.empty())
        throw engine::Error(
            pointer, "expected an object of settings, as in {\"/strands/density\": 16}");
    std::size_t side = 0;
    std::vector<std::pair<std::string, scene::Json>> fields;
    for (const auto& [field, wanted] : value.items()) {
        if (field == "side") {
            side = countOf(wanted, pointer + "/side");
            continue;
        }
        try {
            scene::pointerTokens(field);
        } catch (const engine::Error& error) {
            throw engine::Error(pointer, error.what());
        }
        fields.emplace_back(field, wanted);
    }
    return [=](Driver& driver) {
        hair::Settings settings = driver.side(side).wanted();
        for (const auto& [field, wanted] : fields) scene::setField(settings, field, wanted);
        driver.viewer.edit(side, settings);
        driver.settle();
    };
}

Act readPerform(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const Action action = actionNamed(stringOf(value, pointer), pointer);
    return [=](Driver& driver) {
        driver.viewer.perform(action);
        driver.settle();
    };
}

Act readDrop(const scene::Json& value, const std::string& pointer, const ScriptFolders& folders) {
    std::vector<std::filesystem::path> files;
    for (const std::string& file : textsOf(value, pointer)) files.push_back(folders.script / file);
    return [=](Driver& driver) {
        driver.viewer.drop(files);
        driver.settle();
    };
}

Act readResize(const scene::Json& value, const std::string& pointer, const ScriptFolders&) {
    const auto [width, height] = pairOf(value, pointer);
    if (width < 1.0f || height < 1.0f) throw engine::Error(pointer, "expected 1 or more");
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

// ---- The table ----------------------------------------------------------------------------------

constexpr Verb kVerbs[] = {
    {"wait", readWait},       {"frames", readFrames}, {"play", readPlay},
    {"seek", readSeek},       {"set", readSet},       {"perform", readPerform},
    {"drop", readDrop},       {"resize", readResize}, {"move", readMove},
    {"click", readClick},     {"drag", readDrag},     {"scroll", readScroll},
    {"key", readKey},         {"type", readType},     {"screenshot", readScreenshot},
    {"picture", readPicture}, {"save", readSave},     {"state", readState},
    {"live", readLive},       {"expect", readExpect}, {"thumbnails", readThumbnails},
};

}  // namespace

const Verb& verbNamed(const std::string& name, const std::string& pointer) {
    const auto found = std::ranges::find(kVerbs, std::string_view(name), &Verb::name);
    if (found != std::end(kVerbs)) return *found;
    std::vector<std::string> known;
    for (const Verb& verb : kVerbs) known.emplace_back(verb.name);
    throw engine::Error(pointer, scene::unknownName("unknown verb", name, known));
}

// ---- Scripts ------------------------------------------------------------------------------------

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
        ScriptFolders folders{.script = path.parent_path()};
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
