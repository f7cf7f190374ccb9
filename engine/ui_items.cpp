#include "engine/ui_items.h"

#include <algorithm>
#include <ranges>

#include <imgui.h>
#include <imgui_internal.h>

namespace engine {

namespace {

UiRect rectOf(const ImRect& rect) { return {rect.Min.x, rect.Min.y, rect.Max.x, rect.Max.y}; }

// A child's name is its parent's, a slash, its own and a number that tells it from its namesakes.
std::string nameOf(const ImGuiWindow& window) {
    std::string name = window.Name;
    if (!(window.Flags & ImGuiWindowFlags_ChildWindow)) return name;
    if (window.Flags & (ImGuiWindowFlags_Popup | ImGuiWindowFlags_Tooltip)) return name;
    const std::size_t underscore = name.rfind('_');
    const std::size_t slash = name.rfind('/');
    if (underscore == std::string::npos || slash == std::string::npos || underscore < slash)
        return name;
    const std::string own = name.substr(slash + 1, underscore - slash - 1);
    return (window.ParentWindow ? nameOf(*window.ParentWindow) : std::string()) + '/' + own;
}

UiItem itemOf(const ImGuiContext& context, ImGuiID id, const ImRect& rect) {
    const ImGuiWindow& window = *context.CurrentWindow;
    UiItem item;
    item.id = id;
    item.window = nameOf(window);
    item.rect = item.whole = rectOf(rect);
    for (const ImGuiWindow* around = &window; around; around = around->ParentWindow)
        item.scrolls |= around->ScrollMax.y > 0.0f;
    item.is_window = id == window.ID;
    // A panel's frame is drawn outside of what its widgets are clipped to.
    item.clip = rectOf(item.is_window ? window.OuterRectClipped : window.ClipRect);
    // Dear ImGui has a window of its own for widgets that are in none.
    item.visible = !window.Hidden && !window.IsFallbackWindow &&
                   rect.Overlaps(item.is_window ? window.Rect() : window.ClipRect);
    return item;
}

}  // namespace

UiItems::UiItems() {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    context.TestEngine = this;
    context.TestEngineHookItems = true;
}

UiItems::~UiItems() {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    context.TestEngineHookItems = false;
    context.TestEngine = nullptr;
}

void UiItems::add(int frame, UiItem item) {
    if (frame != frame_) items_.clear();
    frame_ = frame;
    if (early_.id == item.id) {
        item.label = early_.label;
        early_.id = 0;
    }
    // A number that is being typed is two widgets in the same place.
    if (!find(item.id)) items_.push_back(std::move(item));
}

UiItem& UiItems::early(std::uint32_t id) {
    early_ = {};
    early_.id = id;
    return early_;
}

UiItem* UiItems::find(std::uint32_t id) {
    // What is asked for has nearly always just been made.
    for (UiItem& item : std::views::reverse(items_))
        if (item.id == id) return &item;
    return nullptr;
}

}  // namespace engine

// ---- What Dear ImGui calls where IMGUI_ENABLE_TEST_ENGINE is defined
// -----------------------------

void ImGuiTestEngineHook_ItemAdd(
    ImGuiContext* context, ImGuiID id, const ImRect& rect, const ImGuiLastItemData* data) {
    if (!context->CurrentWindow) return;
    engine::UiItem item = engine::itemOf(*context, id, rect);
    if (data) {
        item.enabled = (data->InFlags & ImGuiItemFlags_Disabled) == 0;
        item.whole = engine::rectOf(data->Rect);
    }
    static_cast<engine::UiItems*>(context->TestEngine)->add(context->FrameCount, std::move(item));
}

void ImGuiTestEngineHook_ItemInfo(
    ImGuiContext* context, ImGuiID id, const char* label, ImGuiItemStatusFlags flags) {
    auto& items = *static_cast<engine::UiItems*>(context->TestEngine);
    engine::UiItem* item = items.find(id);
    if (!item || items.frame() != context->FrameCount) item = &items.early(id);  // a tab
    if (label) item->label = label;
    item->inputable = (flags & ImGuiItemStatusFlags_Inputable) != 0;
    item->checkable = (flags & ImGuiItemStatusFlags_Checkable) != 0;
    item->checked = (flags & ImGuiItemStatusFlags_Checked) != 0;
    item->openable = (flags & ImGuiItemStatusFlags_Openable) != 0;
    item->open = (flags & ImGuiItemStatusFlags_Opened) != 0;
}

void ImGuiTestEngineHook_Log(ImGuiContext*, const char*, ...) {}

const char* ImGuiTestEngine_FindItemDebugLabel(ImGuiContext* context, ImGuiID id) {
    auto* items = static_cast<engine::UiItems*>(context->TestEngine);
    const engine::UiItem* item = items ? items->find(id) : nullptr;
    return item ? item->label.c_str() : nullptr;
}
