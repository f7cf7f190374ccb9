#include "benchmarks/viewer/picture/divider.h"

#include <algorithm>

#include <imgui.h>
#include <imgui_internal.h>  // owners of keys

namespace benchmarks {

namespace {

constexpr float kGrab = 1.0f;   // width of what can be grabbed, in font sizes
constexpr float kStep = 0.01f;  // share that a key moves it
constexpr float kFastStep = 0.1f;

// Taken from all others: else they would move the keyboard's focus, and the camera.
float stepOfKeys() {
    const ImGuiID owner = ImGui::GetItemID();
    const auto pressed = [&](ImGuiKey key) {
        ImGui::SetKeyOwner(key, owner, ImGuiInputFlags_LockThisFrame);
        return ImGui::IsKeyPressed(key, owner, ImGuiInputFlags_Repeat);
    };
    const bool left = pressed(ImGuiKey_LeftArrow), right = pressed(ImGuiKey_RightArrow);
    const float step = ImGui::GetIO().KeyShift ? kFastStep : kStep;
    return (right ? step : 0.0f) - (left ? step : 0.0f);
}

// Light in dark edges, so that it is seen on every picture; a handle in the middle says that it
// moves.
void draw(float x, const PictureRect& rect, ImU32 color) {
    const float font = ImGui::GetFontSize();
    const float top = rect.corner.y, bottom = top + rect.size.y;
    constexpr ImU32 kEdge = IM_COL32(0, 0, 0, 200);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float line = font * 0.06f, edged = font * 0.12f;  // half of their widths
    list.AddRectFilled({x - edged, top}, {x + edged, bottom}, kEdge);
    list.AddRectFilled({x - line, top}, {x + line, bottom}, color);
    const float middle = (top + bottom) / 2, radius = font * 0.7f;
    list.AddCircleFilled({x, middle}, radius, kEdge);
    for (const float way : {-1.0f, 1.0f}) {
        const float from = x + way * radius * 0.2f, to = x + way * radius * 0.75f;
        const float half = radius * 0.4f * way;
        list.AddTriangleFilled({to, middle}, {from, middle + half}, {from, middle - half}, color);
    }
}

}  // namespace

void divider(const char* id, const PictureRect& rect, float& share) {
    const float grab = std::min(ImGui::GetFontSize() * kGrab, rect.size.x);
    if (grab <= 0.0f || rect.size.y <= 0.0f) return;
    const auto at = [&] { return rect.corner.x + share * rect.size.x; };
    // Within the pictures, also where the line is at their edge.
    const float left =
        std::clamp(at() - grab / 2, rect.corner.x, rect.corner.x + rect.size.x - grab);
    ImGui::SetCursorScreenPos({left, rect.corner.y});
    ImGui::InvisibleButton(id, {grab, rect.size.y});
    const bool active = ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool focused = ImGui::IsItemFocused(), hovered = ImGui::IsItemHovered();
    if (active) share = (ImGui::GetMousePos().x - rect.corner.x) / rect.size.x;
    if (focused) share += stepOfKeys();
    share = std::clamp(share, 0.0f, 1.0f);
    if (active || hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (!active)
        ImGui::SetItemTooltip("A is left of it, B right of it. Drag it, or click it and\n"
                              "press the left or right arrow key (Shift: faster).");
    const bool is_marked = active || focused || hovered;
    draw(at(), rect, is_marked ? ImGui::GetColorU32(ImGuiCol_SliderGrabActive) : IM_COL32_WHITE);
}

}  // namespace benchmarks
