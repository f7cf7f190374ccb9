#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/viewer/picture/arrange.h"
#include "benchmarks/viewer/picture/picture_difference.h"
#include "benchmarks/viewer/picture/shown_picture.h"
#include "benchmarks/viewer/tools/picture_rect.h"

namespace benchmarks {

// How two pictures are shown.
enum class Views {
    a,
    b,
    side_by_side,
    slider,      // a left of it and b right of it
    difference,  // of display colours, brightened
};

// The pictures of one or two sides, with their own proportions: as large as there is room, or
// magnified.
class PictureArea {
public:
    explicit PictureArea(const engine::Device& device);

    Views views = Views::a;      // while there are two
    std::uint32_t gain = 4;      // of the difference
    std::optional<int> zoom;     // px of the window for a px of a picture; absent: fits
    float divider_share = 0.5f;  // of what is seen of the pictures, left of the slider

    // Records copies of what the sides have drawn; `b` may be null. Before the window is rendered.
    void copy(engine::Commands& commands, const engine::Image& a, const engine::Image* b);

    struct Shown {
        PictureRect rect;  // of the whole picture, which may be partly hidden
        int side = 0;  // 0: a, 1: b
        bool hovered = false;
        PictureRect clip;  // what is seen of it
    };
    // Shows them within the current window of Dear ImGui, below a line of zooms. `captions` stand
    // beside the sides' letters, while there are two. Every picture is an item; the last one that
    // the mouse holds is what ImGui::IsItemActive() is asked about: see `held`.
    std::vector<Shown> show(const std::array<std::string, 2>& captions = {});
    // The side whose picture the mouse holds down on; -1: none.
    int held() const { return held_; }

    // Of the picture of the difference that was shown last; none while it isn't.
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

}  // namespace benchmarks
