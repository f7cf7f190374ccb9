#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "benchmarks/viewer/difference.h"
#include "benchmarks/viewer/picking.h"

// The pictures in the window: their placement, and how one or two are shown.
namespace benchmarks::viewer {

struct Shown;  // player.h

// ---- Placement of pictures: geometry only, in Dear ImGui coordinates ----------------------------

// The visible part of a picture.
struct Magnification {
    std::optional<float>
        scale;  // px of the window per px of the picture; absent: as large as possible
    glm::vec2 focus{0.5f, 0.5f};  // point of the picture, as shares, for the middle of the pane
};

// A picture in its pane. It may be larger than the pane.
struct Placed {
    PictureRect pane;
    PictureRect picture;  // the whole picture
};

// Returns the overlap of two rectangles, of size 0 if they are disjoint.
PictureRect common(const PictureRect& a, const PictureRect& b);

// Centres a picture of `pixels` in the room if it fits; otherwise it fills the whole room.
Placed arrangeOne(const PictureRect& room, glm::vec2 pixels, const Magnification& magnification);

// Places two pictures at one scale, `gap` apart: side by side, or one above the other if that makes
// them larger.
std::array<Placed, 2> arrangeTwo(
    const PictureRect& room, const std::array<glm::vec2, 2>& pixels, float gap,
    const Magnification& magnification);

// Returns the share of a picture that fits its pane, along each axis; 1 if all of it is visible.
glm::vec2 visibleShare(const Placed& placed);

// Returns the nearest focus that can be in the middle of the pane.
glm::vec2 reachableFocus(glm::vec2 focus, glm::vec2 visible_share);

// ---- The area -----------------------------------------------------------------------------------

// Ways to show two pictures.
enum class Views {
    a,
    b,
    side_by_side,
    slider,  // a to the left of a line and b to the right of it
    difference,  // difference of display colours, multiplied by the gain
};

// The pictures of one or two sides in their aspect ratio: as large as possible, or magnified.
class PictureArea {
public:
    explicit PictureArea(const engine::Device& device);

    Views views = Views::a;  // how two pictures are shown
    std::uint32_t gain = 4;  // factor of the difference
    std::optional<int> zoom;  // px of the window per px of a picture; absent: fit
    float divider_share = 0.5f;  // position of the slider in the visible part of the pictures

    // Records copies of the sides' pictures, before the window is rendered; `b` may be null.
    // Returns false if existing widgets do not show all of them yet.
    bool copy(engine::Commands& commands, const viewer::Shown& a, const viewer::Shown* b);

    struct Shown {
        PictureRect rect;  // the whole picture, which may be partly hidden
        int side = 0;  // 0: a, 1: b
        bool hovered = false;
        PictureRect clip;  // visible part of the picture
    };
    // Shows the pictures within the current Dear ImGui window, below a line of zoom buttons; each
    // is an item. `captions` stand beside the letters of two sides. `note` stands in a lower corner
    // of the pictures, or in their place if there are none yet.
    std::vector<Shown>
    show(const std::array<std::string, 2>& captions = {}, const std::string& note = {});
    // Returns the side on whose picture a mouse button is held; -1: none.
    int held() const { return held_; }

    // Returns the figures of the last shown difference; nothing while it is not shown.
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
