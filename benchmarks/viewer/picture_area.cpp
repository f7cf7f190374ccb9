#include "benchmarks/viewer/picture_area.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#include <glm/common.hpp>
#include <imgui.h>
#include <imgui_internal.h>

#include "benchmarks/report/text.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/preferences.h"
#include "engine/commands.h"
#include "engine/device_address.h"

namespace benchmarks::viewer {

// ---- The pass -----------------------------------------------------------------------------------

namespace gpu {
using Address = engine::DeviceAddress;
using uint = std::uint32_t;
#include "shaders/shared/difference_structs.h"
static_assert(sizeof(DifferenceCounts) == 16);
static_assert(offsetof(DifferencePush, gain) == 8);
}  // namespace gpu

DifferencePass::DifferencePass(const engine::Device& device)
    : pipeline_(
          device, {.shader = "post/difference.comp",
                   .push_size = sizeof(gpu::DifferencePush),
                   .sampled_images = 2,
                   .storage_images = 1}),
      counts_(
          device, {.size = sizeof(gpu::DifferenceCounts),
                   .name = "difference counts",
                   .purpose = "window"}),
      readback_(
          device, {.size = sizeof(gpu::DifferenceCounts),
                   .usage = engine::Usage::readback,
                   .name = "difference counts",
                   .purpose = "window"}) {}

void DifferencePass::record(
    engine::Commands& commands, const engine::Image& a, const engine::Image& b,
    const engine::Image& difference, std::uint32_t gain) {
    const auto [width, height] = difference.extent();
    pixels_ = std::uint64_t{width} * height;
    commands.fill(counts_, 0);
    commands.bind(pipeline_, gpu::DifferencePush{.counts = counts_.address(), .gain = gain});
    commands.uses({{counts_, engine::Access::compute_write}});
    commands.images(pipeline_, std::array{&a, &b}, std::array{&difference});
    commands.dispatch(
        (width + gpu::kDifferenceGroupSide - 1) / gpu::kDifferenceGroupSide,
        (height + gpu::kDifferenceGroupSide - 1) / gpu::kDifferenceGroupSide);
    commands.copy(counts_, readback_, sizeof(gpu::DifferenceCounts));
}

DifferenceFigures DifferencePass::figures() const {
    gpu::DifferenceCounts counts;
    std::memcpy(&counts, readback_.mapped().data(), sizeof counts);
    return {
        .pixels = pixels_,
        .different = counts.pixels,
        .most = counts.most,
        .sum = std::uint64_t{counts.carry} << 32 | counts.sum};
}

// ---- Words --------------------------------------------------------------------------------------

std::string differenceText(const DifferenceFigures& figures) {
    if (figures.different == 0) return "identical";
    return "at most " + std::to_string(figures.most) + " of 255, on average " +
           report::shortNumber(figures.mean()) + "; " +
           report::shortNumber(100.0 * figures.share()) + " % of the pixels differ";
}

// ---- Pictures that widgets show -----------------------------------------------------------------

const engine::Image&
ShownPicture::renew(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage) {
    retired_.reset();
    size_ = extent;
    if (shown_ && extent.width == shown_->image.extent().width &&
        extent.height == shown_->image.extent().height)
        return shown_->image;
    retired_ = std::exchange(
        shown_, std::make_unique<Texture>(
                    device_, engine::ImageDescription{
                                 .format = format,
                                 .width = extent.width,
                                 .height = extent.height,
                                 .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT,
                                 .name = "shown picture",
                                 .purpose = "window"}));
    return shown_->image;
}

bool ShownPicture::copy(
    engine::Commands& commands, std::uint64_t number, std::span<const std::uint8_t> rgba,
    VkExtent2D extent, VkExtent2D size) {
    size_ = size;
    if (number_ == number) return true;
    const engine::Image& image =
        renew(VK_FORMAT_R8G8B8A8_UNORM, extent, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    size_ = size;
    number_ = number;
    if (staging_.size() != rgba.size())
        staging_ = engine::Buffer(
            device_, {.size = rgba.size(),
                      .usage = engine::Usage::upload,
                      .name = "shown picture",
                      .purpose = "window"});
    staging_.write(std::as_bytes(rgba));
    commands.transition(image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    commands.copy(staging_, 0, image, 0);
    commands.transition(
        image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    return !retired_;
}

// ---- The difference as a picture ----------------------------------------------------------------

void PictureDifference::record(
    engine::Commands& commands, const ShownPicture& a, const ShownPicture& b, std::uint32_t gain) {
    if (recorded_) figures_ = pass_.figures();
    const engine::Image& image =
        picture_.renew(VK_FORMAT_R8G8B8A8_UNORM, a.extent(), VK_IMAGE_USAGE_STORAGE_BIT);
    commands.transition(image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    pass_.record(commands, a.image(), b.image(), image, gain);
    commands.transition(image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    recorded_ = true;
}

void PictureDifference::forget() {
    recorded_ = false;
    figures_.reset();
}

// ---- The area -----------------------------------------------------------------------------------

namespace {

// ---- Placement of pictures ----------------------------------------------------------------------

enum Axis { kHorizontal, kVertical };

glm::vec2 middleOf(const PictureRect& rect) { return rect.corner + rect.size * 0.5f; }

// Returns the largest scale at which a picture fits the available space.
float fittingScale(glm::vec2 room, glm::vec2 picture) {
    return glm::max(glm::min(room.x / picture.x, room.y / picture.y), 0.0f);
}

// Returns the space that two adjacent pictures take along an axis, without a gap.
glm::vec2 sizeOfBoth(const std::array<glm::vec2, 2>& sizes, Axis along) {
    glm::vec2 size = glm::max(sizes[0], sizes[1]);
    size[along] = sizes[0][along] + sizes[1][along];
    return size;
}

float scaleOfBoth(
    const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap, Axis along) {
    glm::vec2 left = room.size;
    left[along] -= gap;
    return fittingScale(left, sizeOfBoth(pixels, along));
}

// Places two pictures as large as possible, together in the middle. Each fills its pane.
std::array<Placed, 2>
fitted(const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap, Axis along) {
    const float scale = scaleOfBoth(room, pixels, gap, along);
    const std::array sizes{pixels[0] * scale, pixels[1] * scale};
    float next = middleOf(room)[along] - (sizeOfBoth(sizes, along)[along] + gap) * 0.5f;
    std::array<Placed, 2> placed;
    for (std::size_t i = 0; i < 2; ++i) {
        PictureRect rect{middleOf(room) - sizes[i] * 0.5f, sizes[i]};
        rect.corner[along] = next;
        next += sizes[i][along] + gap;
        placed[i] = {rect, rect};
    }
    return placed;
}

// ---- The line between two pictures --------------------------------------------------------------

constexpr float kGrab = 1.0f;  // width of the grab area, in font heights
constexpr float kStep = 0.01f;  // share of the area per key press
constexpr float kFastStep = 0.1f;

// Returns the step from the arrow keys. Takes the keys from all other widgets; otherwise they would
// move the keyboard focus and the camera.
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

// Draws a light line with dark edges, so that it is visible on every picture. A handle in the
// middle shows that it can move.
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

// A vertical line in `rect` that can be dragged, or moved with the left and right keys while it has
// the keyboard focus; faster with Shift. `share` of the rect lies left of it.
void divider(const char* id, const PictureRect& rect, float& share) {
    const float grab = std::min(ImGui::GetFontSize() * kGrab, rect.size.x);
    if (grab <= 0.0f || rect.size.y <= 0.0f) return;
    const auto at = [&] { return rect.corner.x + share * rect.size.x; };
    // Keeps the grab area inside the pictures, even with the line at their edge.
    const float left =
        std::clamp(at() - grab / 2, rect.corner.x, rect.corner.x + rect.size.x - grab);
    ImGui::SetCursorScreenPos({left, rect.corner.y});
    ImGui::InvisibleButton(id, {grab, rect.size.y});
    const bool active = ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool focused = ImGui::IsItemFocused(), hovered = ImGui::IsItemHovered();
    if (active && ImGui::IsMouseDragging(ImGuiMouseButton_Left))
        share = (ImGui::GetMousePos().x - rect.corner.x) / rect.size.x;
    if (focused) share += stepOfKeys();
    share = std::clamp(share, 0.0f, 1.0f);
    if (active || hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (!active)
        ImGui::SetItemTooltip("A is left of it, B right of it. Drag it, or click it and\n"
                              "press the left or right arrow key (Shift: faster).");
    const bool is_marked = active || focused || hovered;
    draw(at(), rect, is_marked ? ImGui::GetColorU32(ImGuiCol_SliderGrabActive) : IM_COL32_WHITE);
}

// ---- Words on a picture -------------------------------------------------------------------------

enum class Corner { top_left, top_right, bottom_left };

// Shows some words in a corner of a picture, readable on every picture. Wraps in a narrow picture,
// and shows nothing without enough room. `rect` is the visible part of the picture.
void pictureTag(const std::string& text, const PictureRect& rect, Corner corner) {
    const float font = ImGui::GetFontSize();
    const float margin = font * 0.4f, padding = font * 0.35f;
    const float widest = rect.size.x - 2 * (margin + padding);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, widest);
    // No text is better than half a word.
    if (widest < 2 * font || size.x > widest || size.y > rect.size.y - 2 * (margin + padding))
        return;
    const float left = corner == Corner::top_right
                           ? rect.corner.x + rect.size.x - margin - 2 * padding - size.x
                           : rect.corner.x + margin;
    const float top = corner == Corner::bottom_left
                          ? rect.corner.y + rect.size.y - margin - 2 * padding - size.y
                          : rect.corner.y + margin;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(
        {left, top}, {left + size.x + 2 * padding, top + size.y + 2 * padding},
        IM_COL32(0, 0, 0, 190), padding);
    list.AddText(
        ImGui::GetFont(), font, {left + padding, top + padding}, IM_COL32_WHITE, text.c_str(),
        nullptr, widest);
}

// ---- Zoom and scroll bars -----------------------------------------------------------------------

using Zoom = std::optional<int>;

constexpr std::array kZooms{
    Choice<Zoom>{"Fit", {}, "Pictures are as large as possible."},
    Choice<Zoom>{"1:1", 1, "A pixel of the picture covers one pixel of the screen."},
    Choice<Zoom>{"2x", 2, "A pixel of the picture covers 2 x 2 pixels of the screen."},
    Choice<Zoom>{"4x", 4, "A pixel of the picture covers 4 x 4 pixels of the screen."},
    Choice<Zoom>{"8x", 8, "A pixel of the picture covers 8 x 8 pixels of the screen."}};

constexpr double kSteps = 1e6;  // resolution of a scroll bar

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

// Buttons for the zoom, in as many lines as needed.
void zoomBar(std::optional<int>& zoom) {
    choiceButtons<Zoom>(kZooms, zoom);
    if (!zoom) return;
    constexpr const char* kHint = "M + drag: move";
    sameLineIfItFits(kHint);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", kHint);
}

// Thickness of a scroll bar.
float scrollBarWidth() { return ImGui::GetStyle().ScrollbarSize; }

// Shows scroll bars below and to the right of `room` for the axes along which only part of a
// picture is visible. They move the point in the middle.
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

// ---- The area -----------------------------------------------------------------------------------

constexpr ImGuiKey kMoveKey = ImGuiKey_M;  // while it is held, the mouse moves magnified pictures

glm::vec2 pixelsOf(const ShownPicture& picture) {
    return {picture.size().width, picture.size().height};
}

std::string sizeOf(const ShownPicture& picture) {
    return std::to_string(picture.size().width) + " × " + std::to_string(picture.size().height) +
           " px";
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

// ---- Placement of pictures ----------------------------------------------------------------------

PictureRect common(const PictureRect& a, const PictureRect& b) {
    const glm::vec2 from = glm::max(a.corner, b.corner);
    const glm::vec2 to = glm::min(a.corner + a.size, b.corner + b.size);
    return {from, glm::max(to - from, glm::vec2(0.0f))};
}

glm::vec2 visibleShare(const Placed& placed) {
    return glm::min(placed.pane.size / placed.picture.size, glm::vec2(1.0f));
}

glm::vec2 reachableFocus(glm::vec2 focus, glm::vec2 visible_share) {
    return glm::clamp(focus, visible_share * 0.5f, 1.0f - visible_share * 0.5f);
}

Placed arrangeOne(const PictureRect& room, glm::vec2 pixels, const Magnification& magnification) {
    const glm::vec2 size =
        pixels * (magnification.scale ? *magnification.scale : fittingScale(room.size, pixels));
    Placed placed{room, {{}, size}};
    const glm::vec2 focus = reachableFocus(magnification.focus, visibleShare(placed));
    placed.picture.corner = middleOf(room) - focus * size;
    // Aligns magnified pixels with the screen's pixels.
    if (magnification.scale) placed.picture.corner = glm::floor(placed.picture.corner);
    return placed;
}

std::array<Placed, 2> arrangeTwo(
    const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap,
    const Magnification& magnification) {
    const bool beside =
        scaleOfBoth(room, pixels, gap, kHorizontal) >= scaleOfBoth(room, pixels, gap, kVertical);
    const Axis along = beside ? kHorizontal : kVertical;
    if (!magnification.scale) return fitted(room, pixels, gap, along);
    std::array<Placed, 2> placed;
    for (std::size_t i = 0; i < 2; ++i) {
        PictureRect half = room;
        half.size[along] = glm::max((room.size[along] - gap) * 0.5f, 1.0f);
        if (i == 1) half.corner[along] += half.size[along] + gap;
        placed[i] = arrangeOne(half, pixels[i], magnification);
    }
    return placed;
}

// ---- The area -----------------------------------------------------------------------------------

PictureArea::PictureArea(const engine::Device& device)
    : a_(device), b_(device), difference_(device) {}

// Sizes also differ if both stand for pictures of one size but only one is a preview.
bool PictureArea::sizesDiffer() const {
    if (!a_.isThere() || !b_.isThere()) return true;
    const VkExtent2D a = a_.extent(), b = b_.extent();
    return pixelsOf(a_) != pixelsOf(b_) || a.width != b.width || a.height != b.height;
}

bool PictureArea::copy(engine::Commands& commands, const viewer::Shown& a, const viewer::Shown* b) {
    const auto copyOf = [&](ShownPicture& picture, const viewer::Shown& shown) {
        if (!shown.isThere()) return true;
        const hair::RenderSettings& render = shown.settings.render;
        return picture.copy(
            commands, shown.number, shown.picture, {shown.width, shown.height},
            {render.width, render.height});
    };
    // No widget shows a new picture yet.
    bool all = a_.isThere() || !a.isThere();
    all &= copyOf(a_, a);
    if (b) all &= copyOf(b_, *b);
    has_b_ = b && b_.isThere();
    if (shownViews() == Views::difference && !sizesDiffer())
        difference_.record(commands, a_, b_, gain);
    else
        difference_.forget();
    return all;
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

// Returns the room without scroll bars. A second pass is needed, because one bar takes room and may
// make the other necessary.
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

std::vector<PictureArea::Shown>
PictureArea::show(const std::array<std::string, 2>& captions, const std::string& note) {
    held_ = -1;
    if (!a_.isThere()) {
        ImGui::TextDisabled("%s", note.c_str());
        return {};
    }
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
    if (!note.empty()) pictureTag(note, common(room, placed[0].picture), Corner::bottom_left);
    const glm::vec2 visible = smallestShare(placed);
    if (zoom) pictureScrollBars(room, visible, focus_);
    focus_ = reachableFocus(focus_, visible);
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy(all);
    return shown;
}

// The item over a picture. The caller handles the mouse on it, except with the move key.
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
        if (held) focus_ -= dragged() / placed.picture.size;
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

// Shows one picture, or both in separate panes.
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

}  // namespace benchmarks::viewer
