#include "benchmarks/viewer/script/layout_faults.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_internal.h>

#include "benchmarks/viewer/script/drawn_letters.h"

namespace benchmarks {

namespace {

// Dear ImGui puts widgets at whole pixels, but not all of their ends.
constexpr float kTolerance = 1.0f;  // px

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
    constexpr ImGuiWindowFlags kOthers =
        ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_Popup;
    return isShown(window) && (window.Flags & kOthers) == 0 && window.Size.x > kTolerance &&
           window.Size.y > kTolerance && !window.IsFallbackWindow;
}

void addContents(const ImGuiWindow& window, std::vector<std::string>& faults) {
    const ImVec2 end = window.DC.CursorMaxPos;  // of what was put into it
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

bool isIn(const DrawnLetter& letter, const engine::UiRect& rect) {
    const float middle = 0.5f * (letter.top + letter.bottom);
    return letter.left >= rect.left - kTolerance && letter.left <= rect.right &&
           middle > rect.top && middle < rect.bottom;
}

// What a field says begins a padding from its left where it is text, and in the middle where it is
// a number that fits; at the very left there is too much of it, if it goes on to the right end.
// Text that was scrolled is cut at the left.
bool isTooLong(const engine::UiItem& field, const std::vector<DrawnLetter>& letters) {
    const DrawnLetter* first = nullptr;
    float right = field.rect.left;
    for (const DrawnLetter& letter : letters) {
        if (!isIn(letter, field.rect)) continue;
        if (!first || letter.left < first->left) first = &letter;
        right = std::max(right, letter.right);
    }
    const float narrowest = ImGui::CalcTextSize(".").x;
    return first && !first->cut && first->pen < field.rect.left + 0.5f &&
           right > field.rect.right - narrowest;
}

void addFields(
    const engine::UiItems& items, const std::vector<DrawnLetter>& letters,
    std::vector<std::string>& faults) {
    for (const engine::UiItem& item : items.items())
        if (item.visible && item.inputable && isTooLong(item, letters))
            faults.push_back(item.window + ": what \"" + item.label + "\" says is cut off");
}

bool isInField(const DrawnLetter& letter, const engine::UiItems& items) {
    return std::ranges::any_of(items.items(), [&](const engine::UiItem& item) {
        return item.inputable && isIn(letter, item.rect);
    });
}

void addLetters(
    const ImGuiWindow& window, const engine::UiItems& items, std::vector<std::string>& faults) {
    const std::vector<DrawnLetter> letters = drawnLetters(*window.DrawList);
    addFields(items, letters, faults);
    for (const DrawnLetter& letter : letters) {
        if (!letter.cut || isInField(letter, items)) continue;
        char text[5] = {};
        ImTextCharToUtf8(text, letter.codepoint);
        faults.push_back(
            std::string(window.Name) + ": the letter '" + text + "' at " + pixels(letter.left) +
            ", " + pixels(letter.top) + " is cut off");
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
    // Whatever a widget draws, its label begins inside of it, a padding from its left.
    const float needed = ImGui::CalcTextSize(text.c_str()).x + ImGui::GetStyle().FramePadding.x;
    const float has = std::min(item.whole.right, item.clip.right) - item.whole.left;
    if (needed > has + kTolerance)
        faults.push_back(
            item.window + ": \"" + text + "\" needs " + pixels(needed) + " and has " + pixels(has));
}

bool isOutside(const engine::UiItem& item) {
    const engine::UiRect &rect = item.rect, &clip = item.clip;
    if (rect.width() <= 0.0f || rect.height() <= 0.0f) return false;
    // What lights up in a list reaches over its row by half of the gap between rows.
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
        addLetters(*window, items, faults);
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
                    std::string(panels[i]->Name) + " and " + panels[j]->Name +
                    " lie on one another");
        }
    for (const engine::UiItem& item : items.items())
        if (!item.is_window && !item.scrolls && isOutside(item))
            faults.push_back(
                item.window + ": the item \"" + item.label + "\" is not all inside of it");
    return faults;
}

}  // namespace benchmarks
