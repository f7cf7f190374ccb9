#include "benchmarks/viewer/picture/zoom_bar.h"

#include <array>
#include <cmath>

#include <imgui.h>
#include <imgui_internal.h>  // ScrollbarEx: bars like those of windows

#include "benchmarks/viewer/picture/choice_buttons.h"

namespace benchmarks {

namespace {

using Zoom = std::optional<int>;

constexpr std::array kZooms{
    Choice<Zoom>{"Fit", {}, "Pictures are as large as there is room."},
    Choice<Zoom>{"1:1", 1, "A pixel of the picture is one of the screen."},
    Choice<Zoom>{"2x", 2, "A pixel of the picture is 2 x 2 of the screen's."},
    Choice<Zoom>{"4x", 4, "A pixel of the picture is 4 x 4 of the screen's."},
    Choice<Zoom>{"8x", 8, "A pixel of the picture is 8 x 8 of the screen's."}};

constexpr double kSteps = 1e6;  // that a bar divides a picture into

void scrollBar(const char* id, const ImRect& bar, ImGuiAxis axis, float visible, float& focus) {
    const double first = (double{focus} - double{visible} / 2) * kSteps;
    ImS64 scroll = std::llround(first);
    const ImS64 before = scroll;
    ImGui::ScrollbarEx(
        bar, ImGui::GetID(id), axis, &scroll, std::llround(double{visible} * kSteps),
        static_cast<ImS64>(kSteps), ImDrawFlags_RoundCornersAll);
    if (scroll != before)
        focus = static_cast<float>(static_cast<double>(scroll) / kSteps) + visible / 2;
}

}  // namespace

void zoomBar(std::optional<int>& zoom) {
    choiceButtons<Zoom>(kZooms, zoom);
    if (!zoom) return;
    constexpr const char* kHint = "M + drag: move";
    sameLineIfItFits(kHint);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", kHint);
}

float scrollBarWidth() { return ImGui::GetStyle().ScrollbarSize; }

void pictureScrollBars(const PictureRect& room, glm::vec2 visible_share, glm::vec2& focus) {
    const ImVec2 from{room.corner.x, room.corner.y};
    const ImVec2 to{from.x + room.size.x, from.y + room.size.y};
    const float width = scrollBarWidth();
    if (visible_share.x < 1.0f)
        scrollBar(
            "##across", {{from.x, to.y}, {to.x, to.y + width}}, ImGuiAxis_X, visible_share.x,
            focus.x);
    if (visible_share.y < 1.0f)
        scrollBar(
            "##down", {{to.x, from.y}, {to.x + width, to.y}}, ImGuiAxis_Y, visible_share.y,
            focus.y);
}

}  // namespace benchmarks
