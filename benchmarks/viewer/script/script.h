#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/error.h"
#include "engine/ui.h"

struct ImGuiContext;
struct ImGuiContextHook;
struct ImGuiIO;

struct ImGuiContext;
struct ImGuiContextHook;
struct ImGuiIO;

// Scripts that drive the viewer like a user: building blocks for steps (mouse and keyboard, the
// widgets and places that steps name, and JSON values), kinds of steps, and files of steps.
namespace benchmarks::viewer {

// ---- Input and names ----------------------------------------------------------------------------

// A mouse and a keyboard for Dear ImGui's current context. They replace the user's, whose events
// are dropped before widgets see them. Time advances by 1/60 s per picture, so that a double click
// also works on a slow machine. Events between two pictures appear in the second one. Must not
// outlive the context.
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
    bool trickles_ = true;  // the context's previous setting
    std::vector<std::function<void(ImGuiIO&)>> events_;
};

// Returns text in lower case, for comparing names of keys and actions.
std::string lowerCase(std::string text);

// "ctrl+shift+z", "f12", "space", "?" as an ImGuiKeyChord. Names are Dear ImGui's
// (ImGui::GetKeyName) in any case, and the characters on keys. Throws engine::Error
// "<pointer>: ...".
int keyChord(const std::string& text, const std::string& pointer);

// The name of a widget in a script. `item` is its visible label or the part after "##"; empty: the
// window itself. `window` is the panel, or a child such as "Scene/fields"; empty: any.
struct ItemName {
    std::string item;
    std::string window;
};

// Returns the visible widget of that name, if any. Throws engine::Error if there are several.
std::optional<engine::UiItem> findItem(const engine::UiItems& items, const ItemName& name);

// Like findItem(), but throws engine::Error with the existing names if there is none.
engine::UiItem itemNamed(const engine::UiItems& items, const ItemName& name);

// Returns a name for messages: "item \"x\" in Scene".
std::string described(const ItemName& name);

// Reads the members of an object in a script. Errors are "<JSON pointer>: <reason>".
class Members {
public:
    // Throws engine::Error for another type, and for members that are not in `known`.
    Members(
        const scene::Json& object, const std::string& pointer,
        const std::vector<const char*>& known);

    bool has(const char* name) const;
    // Throws engine::Error if the member is absent.
    const scene::Json& at(const char* name) const;

    // Return the member in its type; nothing if it is absent. Throw engine::Error for another type.
    std::optional<std::string> text(const char* name) const;
    std::optional<bool> flag(const char* name) const;
    std::optional<std::uint32_t> count(const char* name) const;
    std::optional<std::array<float, 2>> pair(const char* name) const;

    std::string pointerOf(const char* name) const;

private:
    const scene::Json& object_;
    std::string pointer_;
};

// Return a value in its type. Throw engine::Error "<pointer>: <reason>" for another type.
std::string stringOf(const scene::Json& value, const std::string& pointer);
bool flagOf(const scene::Json& value, const std::string& pointer);
std::uint32_t countOf(const scene::Json& value, const std::string& pointer);
std::array<float, 2> pairOf(const scene::Json& value, const std::string& pointer);
// Accepts a string or an array of strings.
std::vector<std::string> textsOf(const scene::Json& value, const std::string& pointer);

// The viewer and input that steps act on. A step over several pictures of the window queues an
// action before each of them.
class Driver {
public:
    explicit Driver(Viewer& shown) : viewer(shown) {}

    Viewer& viewer;
    engine::UiItems items;
    UserInput input;

    // Queues an action before the next free picture.
    void then(std::function<void()> act);
    // Waits for this many pictures.
    void wait(int pictures);
    // Waits until all changes are visible: settings are applied, then drawn, then shown.
    void settle() { wait(3); }
    // Waits until `holds` is true. Throws engine::Error(`failure`) after `pictures`.
    void until(std::function<bool()> holds, int pictures, const std::string& failure);

    // Runs the action before the next picture; false if none is queued.
    bool goOn();

    // Throws engine::Error if there is no such side.
    const Side& side(std::size_t index) const;

private:
    std::deque<std::function<bool()>> acts_;  // before a picture; return true when done
};

// A point in the window: in a widget, as shares of its size from the top left, or in px.
struct Place {
    std::optional<ItemName> item;
    std::array<float, 2> at{0.5f, 0.5f};
};

// Returns the widget that the members "item" and "window" name; nothing if both are absent.
std::optional<ItemName> itemOf(const Members& members);
// Returns the place that these two and the point `at` name. Without a widget, the point is in px
// from the window's top left corner.
Place placeOf(const Members& members, const char* at);

// Returns a place in px. Throws engine::Error if the widget is hidden or disabled.
std::array<float, 2> pixelsOf(const Driver& driver, const Place& place);

// Faults in the layout of the last picture of Dear ImGui's current context.

// Returns unreadable parts, one per line: letters that are cut off at the left or right, labels
// wider than their widgets, contents wider than a window or column without horizontal scrolling, or
// taller than one without any scrolling. Text fields scroll.
std::vector<std::string> clippedText(const engine::UiItems& items);

// Returns unreachable parts, one per line: panels outside the window or overlapping others, and
// widgets outside panels that do not scroll. Popups may overlap panels.
std::vector<std::string> outsideItems(const engine::UiItems& items);

// ---- Steps --------------------------------------------------------------------------------------

// Runs one step. Throws engine::Error with only the reason.
using Act = std::function<void(Driver&)>;

// Folders of a script: it reads files beside itself and writes files to its "out", relative to the
// current folder.
struct ScriptFolders {
    std::filesystem::path script;
    std::filesystem::path out;
};

// A kind of step.
struct Verb {
    const char* name;
    // `value` is the step's value, at `pointer` in the script. Throws engine::Error
    // "<JSON pointer>: <reason>".
    Act (*read)(const scene::Json& value, const std::string& pointer, const ScriptFolders& folders);
};

// Throws engine::Error for an unknown verb; `pointer` is the step's.
const Verb& verbNamed(const std::string& name, const std::string& pointer);

// A step could not be done, or an expectation was not met.
class ScriptFailure : public engine::Error {
public:
    using engine::Error::Error;
};

// A file of steps that drive the viewer like a user: docs/viewer.md lists them all. Meanwhile the
// user's own mouse and keys do nothing, and each picture of the window is 1/60 s after the previous
// one, however long it took.
class Script {
public:
    // Throws engine::Error "<path>: <JSON pointer>: <reason>".
    explicit Script(const std::filesystem::path& path);
    // Must be destroyed before the viewer that it drives.
    ~Script();
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;

    // Runs the actions before the window's next picture; false when all are done. Throws
    // ScriptFailure "<path>: <JSON pointer of the step>: <reason>".
    bool step(Viewer& viewer);

    // Call this after the window has closed. Throws ScriptFailure if steps remain.
    void finish() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace benchmarks::viewer
