#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/ui.h"

struct ImGuiContext;
struct ImGuiContextHook;
struct ImGuiIO;

// What the steps of a script are made from: the mouse and keyboard that they have, the widgets and
// places that they name, their values as JSON.
namespace benchmarks::viewer {

// A mouse and a keyboard for Dear ImGui's current context, in place of the user's, whose events are
// dropped just before widgets would see them. Time advances by 1/60 s from picture to picture, so
// that a double click is one on a slow machine. What is called between two pictures is seen by the
// second. Must not outlive the context.
class UserInput {
public:
    UserInput();
    ~UserInput();
    UserInput(const UserInput&) = delete;
    UserInput& operator=(const UserInput&) = delete;

    // Moves the mouse, in px from the window's top left corner.
    void move(float x, float y);
    enum class Change { press, release };
    void button(int button, Change change);  // ImGuiMouseButton
    void wheel(float x, float y);  // notches; up and left are positive
    void key(int chord, Change change);  // ImGuiKeyChord
    void type(const std::string& text);

private:
    static void feed(ImGuiContext* context, ImGuiContextHook* hook);

    unsigned hook_ = 0;
    bool trickles_ = true;  // the context's setting before
    std::vector<std::function<void(ImGuiIO&)>> events_;
};

// Text in lower case, as names of keys and actions are compared.
std::string lowerCase(std::string text);

// "ctrl+shift+z", "f12", "space", "?": an ImGuiKeyChord. Names are Dear ImGui's (ImGui::GetKeyName)
// in any case, and the signs that are on keys. Throws engine::Error "<pointer>: ...".
int keyChord(const std::string& text, const std::string& pointer);

// What a script calls a widget. `item` is what people read on it or what its "##" hides; empty: the
// window itself. `window` is the panel, or a child as "Scene/fields"; empty: any.
struct ItemName {
    std::string item;
    std::string window;
};

// The widget of a name among those that are seen; none where there is none. Throws engine::Error
// where there are several.
std::optional<engine::UiItem> findItem(const engine::UiItems& items, const ItemName& name);

// findItem(), which must be there. Throws engine::Error with the names that are there instead.
engine::UiItem itemNamed(const engine::UiItems& items, const ItemName& name);

// A name for messages: "item \"x\" in Scene".
std::string described(const ItemName& name);

// The members of an object in a script. Errors are "<JSON pointer>: <reason>".
class Members {
public:
    // Throws engine::Error for what is no object, or has members that are not among `known`.
    Members(
        const scene::Json& object, const std::string& pointer,
        const std::vector<const char*>& known);

    bool has(const char* name) const;
    // Throws engine::Error where the member is absent.
    const scene::Json& at(const char* name) const;

    // The member in its type; none where it is absent. Throw engine::Error for another type.
    std::optional<std::string> text(const char* name) const;
    std::optional<bool> flag(const char* name) const;
    std::optional<std::uint32_t> count(const char* name) const;
    std::optional<std::array<float, 2>> pair(const char* name) const;

    std::string pointerOf(const char* name) const;

private:
    const scene::Json& object_;
    std::string pointer_;
};

// A value in its type. Throw engine::Error "<pointer>: <reason>" for another type.
std::string textOf(const scene::Json& value, const std::string& pointer);
bool flagOf(const scene::Json& value, const std::string& pointer);
std::uint32_t countOf(const scene::Json& value, const std::string& pointer);
std::array<float, 2> pairOf(const scene::Json& value, const std::string& pointer);
// A string, or an array of strings.
std::vector<std::string> textsOf(const scene::Json& value, const std::string& pointer);

// What the steps of a script act on. A step that takes several pictures of the window says what
// comes before each of them.
class Driver {
public:
    explicit Driver(Viewer& shown) : viewer(shown) {}

    Viewer& viewer;
    engine::UiItems items;
    UserInput input;

    // Does something before the next picture that nothing was asked for.
    void then(std::function<void()> act);
    // Waits for pictures.
    void wait(int pictures);
    // Waits until everything has answered: settings are followed, then drawn, then shown.
    void settle() { wait(3); }
    // Waits until `holds` is true. Throws engine::Error(`failure`) after `pictures`.
    void until(std::function<bool()> holds, int pictures, const std::string& failure);

    // Does what comes before the next picture; false where nothing was asked for.
    bool goOn();

    // Throws engine::Error where there is no such side.
    const Side& side(std::size_t index) const;

private:
    std::deque<std::function<bool()>> acts_;  // before a picture; true: it was the last one
};

// A point in the window: of a widget, as shares of its size from its left and top, or in px.
struct Place {
    std::optional<ItemName> item;
    std::array<float, 2> at{0.5f, 0.5f};
};

// The widget that the members "item" and "window" name; none where both are absent.
std::optional<ItemName> itemOf(const Members& members);
// The place that these two and the point `at` name; without a widget the point is in px from the
// window's top left corner.
Place placeOf(const Members& members, const char* at);

// A place in px. Throws engine::Error where the widget is not seen or is disabled.
std::array<float, 2> pixelsOf(const Driver& driver, const Place& place);

}  // namespace benchmarks::viewer
