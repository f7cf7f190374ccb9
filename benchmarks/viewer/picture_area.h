#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "benchmarks/viewer/difference.h"
#include "benchmarks/viewer/picking.h"

// The part of the window with the pictures: where they go, and how one or two are shown.
namespace benchmarks::viewer {

struct Shown;  // player.h

// ---- Where pictures go: geometry only, in Dear ImGui's coordinates ------------------------------

// How much of a picture is to be seen.
struct Magnification {
    std::optional<float>
        scale;  // px of the window per px of the picture; absent: as large as there is room
    glm::vec2 focus{0.5f, 0.5f};  // share of the picture that is in the middle, if it can be
};

// A picture in its pane, which it may be larger than.
struct Placed {
    PictureRect pane;
    PictureRect picture;  // all of it
};

// The overlap of two rectangles; of size 0 where there is none.
PictureRect common(const PictureRect& a, const PictureRect& b);

// Places a picture of `pixels` in the middle of the room where it fits. Where it doesn't, no part
// of the room stays empty.
Placed arrangeOne(const PictureRect& room, glm::vec2 pixels, const Magnification& magnification);

// Places two pictures at one scale, `gap` apart: beside each other or, where they are larger then,
// one above the other.
std::array<Placed, 2> arrangeTwo(
    const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap,
    const Magnification& magnification);

// The share of a picture that its pane has room for, along each axis: 1 where all of it is seen.
glm::vec2 visibleShare(const Placed& placed);

// The nearest focus that can be in the middle of the pane.
glm::vec2 reachableFocus(glm::vec2 focus, glm::vec2 visible_share);

// ---- The area -----------------------------------------------------------------------------------

// How two pictures are shown.
enum class Views {
    a,
    b,
    side_by_side,
    slider,  // a left of a line and b right of it
    difference,  // difference of display colours, times the gain
};

// The pictures of one or two sides, with their own proportions: as large as there is room, or
// magnified.
class PictureArea {
public:
    explicit PictureArea(const engine::Device& device);

    Views views = Views::a;  // how two pictures are shown
    std::uint32_t gain = 4;  // factor of the difference
    std::optional<int> zoom;  // px of the window for a px of a picture; absent: fits
    float divider_share = 0.5f;  // where the slider is in what is seen of the pictures

    // Records copies of what the sides show; `b` may be null. Before the window is rendered.
    // False where widgets that were made before don't show all of them yet.
    bool copy(engine::Commands& commands, const viewer::Shown& a, const viewer::Shown* b);

    struct Shown {
        PictureRect rect;  // the whole picture, which may be partly hidden
        int side = 0;  // 0: a, 1: b
        bool hovered = false;
        PictureRect clip;  // what is seen of the picture
    };
    // Shows the pictures within the current window of Dear ImGui, below a line of zooms; each is an
    // item. `captions` stand beside the letters of two sides, `note` in the lower corner of the
    // pictures, or in their place where there are none yet.
    std::vector<Shown>
    show(const std::array<std::string, 2>& captions = {}, const std::string& note = {});
    // The side whose picture the mouse holds down on; -1: none.
    int held() const { return held_; }

    // The figures of the difference that was shown last; none while it isn't shown.
    const std::optional<DifferenceFigures>& difference() const { return difference_.figures(); }

private:
    Views shownViews() const { return has_b_ ? views : Views::a; }
    bool sizesDiffer() const;
    const ShownPicture& pictureOf(int side) const { return side == 1 ? b_ : a_; }
    std::vector<Placed> arrange(const PictureRect& room) const;
    glm::vec2 roomBesideBars(const PictureRect& room) const;
    Shown item(const Placed& placed, const PictureRect& clip, int side);
    void
    showPicture(std::vector<Shown>& shown, const Placed& placed, const PictureRect& clip, int side);
    void showAlone(
        std::vector<Shown>& shown, const std::vector<Placed>& placed,
        const std::array<std::string, 2>& captions);
    void showSlider(
        std::vector<Shown>& shown, const Placed& placed,
        const std::array<std::string, 2>& captions);
    void showDifference(std::vector<Shown>& shown, const Placed& placed);
    void showSizes(const PictureRect& room) const;

    ShownPicture a_;
    ShownPicture b_;
    PictureDifference difference_;
    bool has_b_ = false;
    int held_ = -1;
    glm::vec2 focus_{0.5f, 0.5f};
};

}  // namespace benchmarks::viewer
