#include "benchmarks/viewer/script/input.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include <imgui.h>
#include <imgui_internal.h>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"
#include "engine/error.h"

namespace benchmarks::viewer {
namespace {

constexpr float kPictureTime = 1.0f / 60.0f;  // s

struct Named {
    std::string_view name;
    int key;
};

constexpr Named kModifiers[] = {
    {"ctrl", ImGuiMod_Ctrl},
    {"shift", ImGuiMod_Shift},
    {"alt", ImGuiMod_Alt},
    {"super", ImGuiMod_Super}};

// Names in addition to Dear ImGui's.
constexpr Named kOthers[] = {
    {"left", ImGuiKey_LeftArrow}, {"right", ImGuiKey_RightArrow}, {"up", ImGuiKey_UpArrow},
    {"down", ImGuiKey_DownArrow}, {".", ImGuiKey_Period},         {",", ImGuiKey_Comma},
    {"/", ImGuiKey_Slash},        {"-", ImGuiKey_Minus},          {"=", ImGuiKey_Equal},
    {"[", ImGuiKey_LeftBracket},  {"]", ImGuiKey_RightBracket}};

bool isIn(const std::string& window, const std::string& wanted) {
    return wanted.empty() || window == wanted || window.starts_with(wanted + '/');
}

// Returns the part after "##": "/strands/density" for "##/strands/density".
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

[[noreturn]] void refuse(const std::string& pointer, const char* wanted, const scene::Json& value) {
    throw engine::Error(
        pointer, std::string("expected ") + wanted + ", found " + scene::described(value));
}

}  // namespace

// ---- Mouse and keyboard -------------------------------------------------------------------------

UserInput::UserInput() {
    ImGuiContext* const context = ImGui::GetCurrentContext();
    ImGuiContextHook hook;
    hook.Type = ImGuiContextHookType_NewFramePre;
    hook.Callback = &UserInput::feed;
    hook.UserData = this;
    hook_ = ImGui::AddContextHook(context, &hook);
    // Otherwise Dear ImGui would spread events between two pictures over several pictures.
    trickles_ = std::exchange(ImGui::GetIO().ConfigInputTrickleEventQueue, false);
}

UserInput::~UserInput() {
    ImGui::RemoveContextHook(ImGui::GetCurrentContext(), hook_);
    ImGui::GetIO().ConfigInputTrickleEventQueue = trickles_;
}

// Called after GLFW's back end has added its events, and before Dear ImGui reads them.
void UserInput::feed(ImGuiContext* context, ImGuiContextHook* hook) {
    auto& self = *static_cast<UserInput*>(hook->UserData);
    ImGuiIO& io = context->IO;
    io.ClearEventsQueue();
    io.DeltaTime = kPictureTime;
    for (const auto& event : std::exchange(self.events_, {})) event(io);
}

void UserInput::move(float x, float y) {
    events_.emplace_back([=](ImGuiIO& io) { io.AddMousePosEvent(x, y); });
}

void UserInput::button(int button, Change change) {
    events_.emplace_back(
        [=](ImGuiIO& io) { io.AddMouseButtonEvent(button, change == Change::press); });
}

void UserInput::wheel(float x, float y) {
    events_.emplace_back([=](ImGuiIO& io) { io.AddMouseWheelEvent(x, y); });
}

void UserInput::key(int chord, Change change) {
    const bool down = change == Change::press;
    events_.emplace_back([=](ImGuiIO& io) {
        for (const int modifier : {ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiMod_Alt, ImGuiMod_Super})
            if (chord & modifier) io.AddKeyEvent(static_cast<ImGuiKey>(modifier), down);
        const auto key = static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_);
        if (key != ImGuiKey_None) io.AddKeyEvent(key, down);
    });
}

void UserInput::type(const std::string& text) {
    events_.emplace_back([=](ImGuiIO& io) { io.AddInputCharactersUTF8(text.c_str()); });
}

// ---- Names of keys ------------------------------------------------------------------------------

std::string lowerCase(std::string text) {
    std::ranges::transform(
        text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

int keyChord(const std::string& text, const std::string& pointer) {
    int chord = 0;
    std::string rest = lowerCase(text);
    const auto takeModifier = [&] {
        for (const Named& modifier : kModifiers) {
            const bool with_key = rest.starts_with(std::string(modifier.name) + '+');
            if (!with_key && rest != modifier.name) continue;
            chord |= modifier.key;
            rest.erase(0, modifier.name.size() + (with_key ? 1 : 0));
            return true;
        }
        return false;
    };
    while (takeModifier()) {
    }
    if (rest.empty() && chord != 0) return chord;  // modifiers only, for example for a mouse button
    std::vector<std::string> known;
    for (const Named& other : kOthers) {
        if (other.name == rest) return chord | other.key;
        known.emplace_back(other.name);
    }
    for (int key = ImGuiKey_NamedKey_BEGIN; key < ImGuiKey_GamepadStart; ++key) {
        known.push_back(lowerCase(ImGui::GetKeyName(static_cast<ImGuiKey>(key))));
        if (known.back() == rest) return chord | key;
    }
    throw engine::Error(pointer, scene::unknownName("unknown key", rest, known));
}

// ---- Names of widgets ---------------------------------------------------------------------------

std::string described(const ItemName& name) {
    if (name.item.empty()) return "window '" + name.window + '\'';
    return "item '" + name.item + '\'' + (name.window.empty() ? "" : " in " + name.window);
}

std::optional<engine::UiItem> findItem(const engine::UiItems& items, const ItemName& name) {
    std::optional<engine::UiItem> found;
    for (const engine::UiItem& item : items.items()) {
        if (!item.visible || !isCalled(item, name)) continue;
        if (found && !name.item.empty()) {
            // A panel, its tab and a button may have the same name.
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
    throw engine::Error(scene::unknownName(
        "no " + described(name) + " is visible", wants_window ? name.window : name.item, known));
}

// ---- Values in a script -------------------------------------------------------------------------

Members::Members(
    const scene::Json& object, const std::string& pointer, const std::vector<const char*>& known)
    : object_(object), pointer_(pointer) {
    if (!object.is_object()) refuse(pointer.empty() ? "the whole" : pointer, "an object", object);
    const std::vector<std::string> names(known.begin(), known.end());
    for (const auto& [key, value] : object.items())
        if (std::ranges::find(names, key) == names.end())
            throw engine::Error(
                pointer.empty() ? '/' + scene::escapedToken(key) : pointer,
                scene::unknownName("unknown key", key, names));
}

bool Members::has(const char* name) const { return object_.contains(name); }

const scene::Json& Members::at(const char* name) const {
    if (!has(name))
        throw engine::Error(
            pointer_.empty() ? "/" : pointer_, '\'' + std::string(name) + "' is missing");
    return object_.at(name);
}

std::string Members::pointerOf(const char* name) const { return pointer_ + '/' + name; }

std::optional<std::string> Members::text(const char* name) const {
    if (!has(name)) return std::nullopt;
    return textOf(at(name), pointerOf(name));
}

std::optional<bool> Members::flag(const char* name) const {
    if (!has(name)) return std::nullopt;
    return flagOf(at(name), pointerOf(name));
}

std::optional<std::uint32_t> Members::count(const char* name) const {
    if (!has(name)) return std::nullopt;
    return countOf(at(name), pointerOf(name));
}

std::optional<std::array<float, 2>> Members::pair(const char* name) const {
    if (!has(name)) return std::nullopt;
    return pairOf(at(name), pointerOf(name));
}

std::string textOf(const scene::Json& value, const std::string& pointer) {
    if (!value.is_string()) refuse(pointer, "a string", value);
    return value.get<std::string>();
}

bool flagOf(const scene::Json& value, const std::string& pointer) {
    if (!value.is_boolean()) refuse(pointer, "true or false", value);
    return value.get<bool>();
}

std::uint32_t countOf(const scene::Json& value, const std::string& pointer) {
    const bool counts = value.is_number_unsigned() || (value.is_number_integer() && value >= 0);
    if (!counts || value > std::numeric_limits<std::uint32_t>::max())
        refuse(pointer, "a whole number from 0", value);
    return value.get<std::uint32_t>();
}

std::array<float, 2> pairOf(const scene::Json& value, const std::string& pointer) {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
        refuse(pointer, "two numbers, [x, y]", value);
    return {value[0].get<float>(), value[1].get<float>()};
}

std::vector<std::string> textsOf(const scene::Json& value, const std::string& pointer) {
    if (!value.is_array()) return {textOf(value, pointer)};
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < value.size(); ++i)
        texts.push_back(textOf(value[i], pointer + '/' + std::to_string(i)));
    return texts;
}

// ---- Pictures of the window ---------------------------------------------------------------------

void Driver::then(std::function<void()> act) {
    acts_.emplace_back([act = std::move(act)] {
        act();
        return true;
    });
}

void Driver::wait(int pictures) {
    for (int i = 0; i < pictures; ++i) then([] {});
}

void Driver::until(std::function<bool()> holds, int pictures, const std::string& failure) {
    acts_.emplace_back([=, left = pictures]() mutable {
        if (holds()) return true;
        if (left-- == 0) throw engine::Error(failure);
        return false;
    });
}

bool Driver::goOn() {
    if (acts_.empty()) return false;
    if (acts_.front()()) acts_.pop_front();
    return true;
}

const Side& Driver::side(std::size_t index) const {
    if (index >= viewer.sideCount())
        throw engine::Error(
            "there is no side " + std::to_string(index) + "; the window shows " +
            std::to_string(viewer.sideCount()));
    return viewer.side(index);
}

// ---- Places in the window -----------------------------------------------------------------------

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
            members.pointerOf(at),
            "is missing; without an item it must be a point of the window, px");
    if (point) place.at = *point;
    return place;
}

std::array<float, 2> pixelsOf(const Driver& driver, const Place& place) {
    if (!place.item) return place.at;
    const engine::UiItem item = itemNamed(driver.items, *place.item);
    if (!item.enabled) throw engine::Error(described(*place.item) + " is greyed out");
    return {
        item.rect.left + place.at[0] * item.rect.width(),
        item.rect.top + place.at[1] * item.rect.height()};
}

}  // namespace benchmarks::viewer
