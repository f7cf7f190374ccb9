#include "benchmarks/viewer/picture/picture_area.h"

#include <algorithm>

#include <glm/common.hpp>
#include <imgui.h>

#include "benchmarks/viewer/picture/difference_text.h"
#include "benchmarks/viewer/picture/divider.h"
#include "benchmarks/viewer/picture/picture_tag.h"
#include "benchmarks/viewer/picture/zoom_bar.h"

namespace benchmarks {

namespace {

constexpr ImGuiKey kMoveKey = ImGuiKey_M;  // held, the mouse moves magnified pictures

glm::vec2 pixelsOf(const ShownPicture& picture) {
    return {picture.extent().width, picture.extent().height};
}

std::string sizeOf(const ShownPicture& picture) {
    return std::to_string(picture.extent().width) + " × " +
           std::to_string(picture.extent().height) + " px";
}

void draw(const ShownPicture& picture, const PictureRect& rect, const PictureRect& clip) {
    const glm::vec2 to = rect.corner + rect.size, clip_to = clip.corner + clip.size;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({clip.corner.x, clip.corner.y}, {clip_to.x, clip_to.y}, true);
    list.AddImage(picture.id(), {rect.corner.x, rect.corner.y}, {to.x, to.y});
    list.PopClipRect();
}

std::string tagOf(int side, const std::string& caption) {
    const std::string letter = side == 0 ? "A" : "B";
    return caption.empty() ? letter : letter + "  " + caption;
}

glm::vec2 smallestShare(const std::vector<Placed>& placed) {
    glm::vec2 share(1.0f);
    for (const Placed& one : placed) share = glm::min(share, visibleShare(one));
    return share;
}

bool isMouseDown() {
    return ImGui::IsMouseDown(ImGuiMouseButton_Left) ||
           ImGui::IsMouseDown(ImGuiMouseButton_Right) ||
           ImGui::IsMouseDown(ImGuiMouseButton_Middle);
}

}  // namespace

PictureArea::PictureArea(const engine::Device& device)
    : a_(device), b_(device), difference_(device) {}

bool PictureArea::sizesDiffer() const { return pixelsOf(a_) != pixelsOf(b_); }

void PictureArea::copy(engine::Commands& commands, const engine::Image& a, const engine::Image* b) {
    a_.copy(commands, a);
    if (b) b_.copy(commands, *b);
    has_b_ = b != nullptr;
    if (shownViews() == Views::difference && !sizesDiffer())
        difference_.record(commands, a_, b_, gain);
    else
        difference_.forget();
}

std::vector<Placed> PictureArea::arrange(const PictureRect& room) const {
    const float pixel = 1.0f / std::max(ImGui::GetIO().DisplayFramebufferScale.x, 0.01f);
    Magnification magnification{.focus = focus_};
    if (zoom) magnification.scale = static_cast<float>(*zoom) * pixel;
    const Views views_now = shownViews();
    if (views_now != Views::side_by_side) {
        const ShownPicture& picture = pictureOf(views_now == Views::b ? 1 : 0);
        return {arrangeOne(room, pixelsOf(picture), magnification)};
    }
    const float gap = ImGui::GetFontSize() * 0.5f;
    const auto both = arrangeTwo(room, {pixelsOf(a_), pixelsOf(b_)}, gap, magnification);
    return {both.begin(), both.end()};
}

// A bar takes room, which may make the other one needed.
glm::vec2 PictureArea::roomBesideBars(const PictureRect& room) const {
    PictureRect left = room;
    for (int i = 0; i < 2; ++i) {
        const glm::vec2 visible = smallestShare(arrange(left));
        left.size = room.size;
        if (visible.y < 1.0f) left.size.x -= scrollBarWidth();
        if (visible.x < 1.0f) left.size.y -= scrollBarWidth();
        left.size = glm::max(left.size, glm::vec2(1.0f));
    }
    return left.size;
}

std::vector<PictureArea::Shown> PictureArea::show(const std::array<std::string, 2>& captions) {
    held_ = -1;
    if (!a_.isThere()) return {};
    zoomBar(zoom);
    const ImVec2 corner = ImGui::GetCursorScreenPos(), all = ImGui::GetContentRegionAvail();
    PictureRect room{{corner.x, corner.y}, glm::max(glm::vec2(all.x, all.y), glm::vec2(1.0f))};
    std::vector<Shown> shown;
    if (shownViews() == Views::difference && sizesDiffer()) {
        showSizes(room);
        return shown;
    }
    if (zoom) room.size = roomBesideBars(room);
    const std::vector<Placed> placed = arrange(room);
    switch (shownViews()) {
    case Views::slider:
        showSlider(shown, placed[0], captions);
        break;
    case Views::difference:
        showDifference(shown, placed[0]);
        break;
    default:
        showAlone(shown, placed, captions);
    }
    const glm::vec2 visible = smallestShare(placed);
    if (zoom) pictureScrollBars(room, visible, focus_);
    focus_ = reachableFocus(focus_, visible);
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy(all);
    return shown;
}

// What the mouse does on a picture is its user's, but with the move key.
PictureArea::Shown PictureArea::item(const Placed& placed, const PictureRect& clip, int side) {
    Shown shown{.rect = placed.picture, .side = side, .clip = clip};
    if (clip.size.x <= 0.0f || clip.size.y <= 0.0f) return shown;
    ImGui::SetCursorScreenPos({clip.corner.x, clip.corner.y});
    ImGui::SetNextItemAllowOverlap();
    ImGui::InvisibleButton(
        side == 0 ? "##picture" : "##picture B", {clip.size.x, clip.size.y},
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
            ImGuiButtonFlags_MouseButtonMiddle);
    const bool held = ImGui::IsItemActive() && isMouseDown();
    const bool hovered = ImGui::IsItemHovered();
    const ImGuiIO& io = ImGui::GetIO();
    if (zoom && !io.WantTextInput && ImGui::IsKeyDown(kMoveKey)) {
        if (held || hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
        if (held) focus_ -= glm::vec2(io.MouseDelta.x, io.MouseDelta.y) / placed.picture.size;
        return shown;
    }
    if (held) held_ = side;
    shown.hovered = hovered;
    return shown;
}

void PictureArea::showPicture(
    std::vector<Shown>& shown, const Placed& placed, const PictureRect& clip, int side) {
    draw(pictureOf(side), placed.picture, clip);
    shown.push_back(item(placed, clip, side));
}

// One of them, or both in panes of their own.
void PictureArea::showAlone(
    std::vector<Shown>& shown, const std::vector<Placed>& placed,
    const std::array<std::string, 2>& captions) {
    for (const Placed& one : placed) {
        const bool is_second = shown.size() == 1 || shownViews() == Views::b;
        const PictureRect clip = common(one.pane, one.picture);
        showPicture(shown, one, clip, is_second ? 1 : 0);
        if (has_b_)
            pictureTag(
                is_second ? tagOf(1, captions[1]) : tagOf(0, captions[0]), clip, Corner::top_left);
    }
}

void PictureArea::showSlider(
    std::vector<Shown>& shown, const Placed& placed, const std::array<std::string, 2>& captions) {
    const PictureRect seen = common(placed.pane, placed.picture);
    const float left = seen.size.x * divider_share;
    const PictureRect left_clip{seen.corner, {left, seen.size.y}};
    const PictureRect right_clip{
        {seen.corner.x + left, seen.corner.y}, {seen.size.x - left, seen.size.y}};
    showPicture(shown, placed, left_clip, 0);
    showPicture(shown, placed, right_clip, 1);
    const std::string stretched =
        sizesDiffer() ? "\n" + sizeOf(b_) + " stretched to " + sizeOf(a_) : "";
    pictureTag(tagOf(0, captions[0]), left_clip, Corner::top_left);
    pictureTag(tagOf(1, captions[1]) + stretched, right_clip, Corner::top_right);
    divider("##divider", seen, divider_share);
}

void PictureArea::showDifference(std::vector<Shown>& shown, const Placed& placed) {
    if (!difference_.picture().isThere()) return;
    const PictureRect clip = common(placed.pane, placed.picture);
    draw(difference_.picture(), placed.picture, clip);
    shown.push_back(item(placed, clip, 0));
    const std::string title = "|A - B| × " + std::to_string(gain);
    const auto& figures = difference_.figures();
    pictureTag(figures ? title + ": " + differenceText(*figures) : title, clip, Corner::top_left);
}

void PictureArea::showSizes(const PictureRect& room) const {
    const std::string text = "Pictures of different sizes have no difference: A is " + sizeOf(a_) +
                             ", B " + sizeOf(b_) +
                             ". Give both the same /render/width and /render/height.";
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, room.size.x);
    ImGui::SetCursorScreenPos(
        {room.corner.x + std::max(room.size.x - size.x, 0.0f) / 2,
         room.corner.y + std::max(room.size.y - size.y, 0.0f) / 2});
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
}

}  // namespace benchmarks
