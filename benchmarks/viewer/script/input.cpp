#include "benchmarks/viewer/script/script.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <imgui.h>
#include <imgui_internal.h>
#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace benchmarks::viewer {

// ---- Input and widgets --------------------------------------------------------------------------

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
    return stringOf(at(name), pointerOf(name));
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

std::string stringOf(const scene::Json& value, const std::string& pointer) {
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
    if (!value.is_array()) return {stringOf(value, pointer)};
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < value.size(); ++i)
        texts.push_back(stringOf(value[i], pointer + '/' + std::to_string(i)));
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

// ---- Faults of the layout -----------------------------------------------------------------------

namespace {

// ---- Drawn glyphs ------------------------------------------------------------------------------

// A drawn glyph, px.
struct DrawnGlyph {
    unsigned codepoint = 0;
    float pen = 0.0f;  // start of its advance, slightly left of it
    float left = 0.0f;
    float right = 0.0f;
    float top = 0.0f;
    float bottom = 0.0f;
    bool cut = false;  // on the left or right
};

// Letters extend beyond their advance, and thus beyond a box of their text's width, by fractions of
// a pixel.
constexpr float kTolerance = 1.0f;  // px
// Visible share of its texture rectangle above which a glyph counts as whole.
constexpr float kWhole = 0.999f;

struct Quad {
    ImDrawVert first;  // top left
    ImDrawVert last;  // bottom right
};

// Returns the rectangle of six indices in the order in which Dear ImGui draws glyphs.
std::optional<Quad> quadAt(const ImDrawList& list, const ImDrawCmd& command, unsigned index) {
    const ImDrawIdx* const i = &list.IdxBuffer[static_cast<int>(command.IdxOffset + index)];
    const unsigned v = i[0];
    if (i[1] != v + 1 || i[2] != v + 2 || i[3] != v || i[4] != v + 2 || i[5] != v + 3)
        return std::nullopt;
    const auto vertex = [&](unsigned at) {
        return list.VtxBuffer[static_cast<int>(command.VtxOffset + at)];
    };
    return Quad{vertex(v), vertex(v + 2)};
}

// Returns the glyph at the middle of the texture rectangle; null for a shape.
const ImFontGlyph* glyphOf(const Quad& quad) {
    if (quad.first.uv.x == quad.last.uv.x) return nullptr;  // single colour
    const float u = 0.5f * (quad.first.uv.x + quad.last.uv.x);
    const float v = 0.5f * (quad.first.uv.y + quad.last.uv.y);
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
        for (const ImFontGlyph& glyph : font->Glyphs)
            if (u > glyph.U0 && u < glyph.U1 && v > glyph.V0 && v < glyph.V1) return &glyph;
    return nullptr;
}

bool isSeen(const Quad& quad, const ImVec4& clip) {
    return (quad.first.col & IM_COL32_A_MASK) != 0 && quad.first.pos.y < clip.w &&
           quad.last.pos.y > clip.y && quad.first.pos.x < clip.z && quad.last.pos.x > clip.x;
}

// Returns the share of the glyph in its rectangle.
float shareOf(const Quad& quad, const ImFontGlyph& glyph) {
    return (quad.last.uv.x - quad.first.uv.x) / (glyph.U1 - glyph.U0);
}

float penOf(const Quad& quad, const ImFontGlyph& glyph) {
    const float width = (quad.last.pos.x - quad.first.pos.x) / shareOf(quad, glyph);
    return quad.first.pos.x - glyph.X0 * width / (glyph.X1 - glyph.X0);
}

bool isCut(const Quad& quad, const ImFontGlyph& glyph, const ImVec4& clip) {
    return shareOf(quad, glyph) < kWhole || quad.first.pos.x < clip.x - kTolerance ||
           quad.last.pos.x > clip.z + kTolerance;
}

// Returns the glyphs of a draw list. Dear ImGui cuts glyphs in two ways: it shrinks the glyph's
// rectangle, or lets the device clip it. Cuts at the top or bottom come from scrolling.
std::vector<DrawnGlyph> drawnGlyphs(const ImDrawList& list) {
    std::vector<DrawnGlyph> glyphs;
    const ImTextureID texture = ImGui::GetIO().Fonts->TexID;
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback || command.GetTexID() != texture) continue;
        for (unsigned index = 0; index + 6 <= command.ElemCount;) {
            const std::optional<Quad> quad = quadAt(list, command, index);
            index += quad ? 6 : 3;
            if (!quad || !isSeen(*quad, command.ClipRect)) continue;
            if (const ImFontGlyph* const glyph = glyphOf(*quad))
                glyphs.push_back(
                    {.codepoint = glyph->Codepoint,
                     .pen = penOf(*quad, *glyph),
                     .left = quad->first.pos.x,
                     .right = quad->last.pos.x,
                     .top = quad->first.pos.y,
                     .bottom = quad->last.pos.y,
                     .cut = isCut(*quad, *glyph, command.ClipRect)});
        }
    }
    return glyphs;
}

// ---- Faults -------------------------------------------------------------------------------------

std::string pixels(float number) {
    return std::to_string(static_cast<int>(std::ceil(number))) + " px";
}

bool isShown(const ImGuiWindow& window) { return window.WasActive && !window.Hidden; }

bool scrollsSideways(const ImGuiWindow& window) {
    return (window.Flags & ImGuiWindowFlags_HorizontalScrollbar) != 0;
}

bool neverScrolls(const ImGuiWindow& window) {
    return (window.Flags & ImGuiWindowFlags_NoScrollbar) != 0;
}

bool isPanel(const ImGuiWindow& window) {
    constexpr ImGuiWindowFlags kSpecialWindows =
        ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_Popup;
    return isShown(window) && (window.Flags & kSpecialWindows) == 0 && window.Size.x > kTolerance &&
           window.Size.y > kTolerance && !window.IsFallbackWindow;
}

void addContents(const ImGuiWindow& window, std::vector<std::string>& faults) {
    const ImVec2 end = window.DC.CursorMaxPos;  // of its contents
    const ImVec2 begin = window.DC.CursorStartPos;
    const ImRect& seen = window.InnerClipRect;
    const std::string name = window.Name;
    const float beside = end.x - std::max(seen.Max.x, begin.x);
    if (!scrollsSideways(window) && beside > kTolerance)
        faults.push_back(name + ": its contents are " + pixels(beside) + " too wide");
    const float below = end.y - std::max(seen.Max.y, begin.y);
    if (neverScrolls(window) && below > kTolerance)
        faults.push_back(name + ": its contents are " + pixels(below) + " too high");
}

bool isIn(const DrawnGlyph& glyph, const engine::UiRect& rect) {
    const float middle = 0.5f * (glyph.top + glyph.bottom);
    return glyph.left >= rect.left - kTolerance && glyph.left <= rect.right && middle > rect.top &&
           middle < rect.bottom;
}

// Whether a field's text is too long. Text normally starts one padding from the left, and a number
// that fits is centred. Text that starts at the very left and reaches the right end is too long.
// Scrolled text is cut at the left. Behind hidden fields, glyphs may come from other windows.
bool isTooLong(const engine::UiItem& field, const std::vector<DrawnGlyph>& glyphs) {
    const DrawnGlyph* first = nullptr;
    float right = field.rect.left;
    for (const DrawnGlyph& glyph : glyphs) {
        if (!isIn(glyph, field.rect) || !isIn(glyph, field.clip)) continue;
        if (!first || glyph.left < first->left) first = &glyph;
        right = std::max(right, glyph.right);
    }
    const float narrowest = ImGui::CalcTextSize(".").x;
    return first && !first->cut && first->pen < field.rect.left + 0.5f &&
           right > field.rect.right - narrowest;
}

// The glyphs belong to the window; glyphs of fields below it do not count.
void addFields(
    const std::string& window, const engine::UiItems& items, const std::vector<DrawnGlyph>& glyphs,
    std::vector<std::string>& faults) {
    for (const engine::UiItem& item : items.items())
        if (item.window == window && item.visible && item.inputable && isTooLong(item, glyphs))
            faults.push_back(item.window + ": the text of \"" + item.label + "\" is cut off");
}

bool isInField(const DrawnGlyph& glyph, const engine::UiItems& items) {
    return std::ranges::any_of(items.items(), [&](const engine::UiItem& item) {
        return item.inputable && isIn(glyph, item.rect);
    });
}

void addGlyphs(
    const ImGuiWindow& window, const engine::UiItems& items, std::vector<std::string>& faults) {
    const std::vector<DrawnGlyph> glyphs = drawnGlyphs(*window.DrawList);
    addFields(engine::windowName(window), items, glyphs, faults);
    for (const DrawnGlyph& glyph : glyphs) {
        if (!glyph.cut || isInField(glyph, items)) continue;
        char text[5] = {};
        ImTextCharToUtf8(text, glyph.codepoint);
        faults.push_back(
            std::string(window.Name) + ": the letter '" + text + "' at " + pixels(glyph.left) +
            ", " + pixels(glyph.top) + " is cut off");
    }
}

void addColumns(const ImGuiTable& table, std::vector<std::string>& faults) {
    for (int i = 0; i < table.ColumnsCount; ++i) {
        const ImGuiTableColumn& column = table.Columns[i];
        if (!column.IsEnabled || !column.IsVisibleX) continue;
        const float end = std::max(
            {column.ContentMaxXFrozen, column.ContentMaxXUnfrozen, column.ContentMaxXHeadersIdeal});
        if (end > column.WorkMaxX + table.CellPaddingX + kTolerance)
            faults.push_back(
                std::string(table.OuterWindow->Name) + ": column " + std::to_string(i) +
                " of a table is " + pixels(end - column.WorkMaxX) + " too narrow");
    }
}

void addLabel(const engine::UiItem& item, std::vector<std::string>& faults) {
    const std::string text = item.text();
    if (item.is_window || !item.visible || text.empty()) return;
    // Every widget draws its label inside itself, starting one padding from its left.
    const float needed = ImGui::CalcTextSize(text.c_str()).x + ImGui::GetStyle().FramePadding.x;
    const float has = std::min(item.whole.right, item.clip.right) - item.whole.left;
    if (needed > has + kTolerance)
        faults.push_back(
            item.window + ": \"" + text + "\" needs " + pixels(needed) + " and has " + pixels(has));
}

bool isOutside(const engine::UiItem& item) {
    const engine::UiRect &rect = item.rect, &clip = item.clip;
    if (rect.width() <= 0.0f || rect.height() <= 0.0f) return false;
    // The highlight in a list extends beyond its row by half of the gap between rows.
    const ImVec2 gap = ImGui::GetStyle().ItemSpacing;
    const float x = 0.5f * gap.x + kTolerance, y = 0.5f * gap.y + kTolerance;
    return rect.left < clip.left - x || rect.right > clip.right + x || rect.top < clip.top - y ||
           rect.bottom > clip.bottom + y;
}

ImRect overlap(const ImGuiWindow& a, const ImGuiWindow& b) {
    ImRect rect = a.Rect();
    rect.ClipWith(b.Rect());
    return rect;
}

}  // namespace

std::vector<std::string> clippedText(const engine::UiItems& items) {
    std::vector<std::string> faults;
    ImGuiContext& context = *ImGui::GetCurrentContext();
    for (const ImGuiWindow* window : context.Windows) {
        if (!isShown(*window) || window->SkipItems) continue;
        addContents(*window, faults);
        addGlyphs(*window, items, faults);
    }
    for (int i = 0; i < context.Tables.GetMapSize(); ++i)
        if (const ImGuiTable* table = context.Tables.TryGetMapData(i))
            if (table->LastFrameActive == context.FrameCount) addColumns(*table, faults);
    for (const engine::UiItem& item : items.items()) addLabel(item, faults);
    return faults;
}

std::vector<std::string> outsideItems(const engine::UiItems& items) {
    std::vector<std::string> faults;
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    const ImVec2 size = context.IO.DisplaySize;
    std::vector<const ImGuiWindow*> panels;
    for (const ImGuiWindow* window : context.Windows) {
        if (!isShown(*window)) continue;
        const ImRect rect = window->Rect();
        const bool is_child = (window->Flags & ImGuiWindowFlags_ChildWindow) != 0;
        if (!is_child && (rect.Min.x < -kTolerance || rect.Min.y < -kTolerance ||
                          rect.Max.x > size.x + kTolerance || rect.Max.y > size.y + kTolerance))
            faults.push_back(std::string(window->Name) + " leaves the window");
        if (isPanel(*window)) panels.push_back(window);
    }
    for (std::size_t i = 0; i < panels.size(); ++i)
        for (std::size_t j = i + 1; j < panels.size(); ++j) {
            const ImRect shared = overlap(*panels[i], *panels[j]);
            if (shared.GetWidth() > kTolerance && shared.GetHeight() > kTolerance)
                faults.push_back(
                    std::string(panels[i]->Name) + " and " + panels[j]->Name + " overlap");
        }
    for (const engine::UiItem& item : items.items())
        if (!item.is_window && !item.scrolls && isOutside(item))
            faults.push_back(
                item.window + ": the item \"" + item.label + "\" is not completely inside it");
    return faults;
}

}  // namespace benchmarks::viewer
