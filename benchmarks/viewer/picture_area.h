#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "benchmarks/viewer/gizmo.h"
#include "engine/buffer_image.h"
#include "engine/pipeline.h"
#include "engine/ui.h"

namespace engine {
class Commands;
class Image;
}  // namespace engine

// Copies of drawn pictures for widgets, and the difference of two as a picture and in figures.

namespace benchmarks::viewer {

// Difference of two pictures, in steps of 1/255 of display colours. Exact.
struct DifferenceFigures {
    std::uint64_t pixels = 0;  // in one picture
    std::uint64_t different = 0;  // pixels with a difference in at least one channel
    std::uint32_t most = 0;  // largest difference of a channel
    std::uint64_t sum = 0;  // sum of differences over red, green and blue of all pixels

    // Mean difference of a channel of a pixel.
    double mean() const { return static_cast<double>(sum) / (3.0 * static_cast<double>(pixels)); }
    // Share of the pixels that differ.
    double share() const { return static_cast<double>(different) / static_cast<double>(pixels); }

    bool operator==(const DifferenceFigures&) const = default;
};

// Computes the difference picture of two pictures and its figures.
class DifferencePass {
public:
    explicit DifferencePass(const engine::Device& device);

    // `a` and `b` are 8-bit RGBA of the same size in SHADER_READ_ONLY_OPTIMAL. `difference` is a
    // storage image of that size in GENERAL and receives |a - b| times `gain`. Alpha is ignored.
    // Earlier writes must be visible to compute.
    void record(
        engine::Commands& commands, const engine::Image& a, const engine::Image& b,
        const engine::Image& difference, std::uint32_t gain);

    // Returns the figures of the last recorded pictures; call it after the device has finished
    // them.
    DifferenceFigures figures() const;

private:
    engine::ComputePipeline pipeline_;
    engine::Buffer counts_;
    engine::Buffer readback_;
    std::uint64_t pixels_ = 0;
};

// "at most 37 of 255, on average 0.42; 12.3 % of the pixels differ", or "identical".
std::string differenceText(const DifferenceFigures& figures);

// A picture for widgets, with unchanged pixels. Another device may have drawn it.
class ShownPicture {
public:
    explicit ShownPicture(const engine::Device& device) : device_(device) {}

    // Records a copy of a host picture, RGBA, top row first, unless `number` is that of the last
    // copy. It is shown at the size `size`, which is larger than a preview's pixels. The device
    // must have finished the last copy. Returns false if existing widgets still show the last
    // picture because it had another size.
    bool copy(
        engine::Commands& commands, std::uint64_t number, std::span<const std::uint8_t> rgba,
        VkExtent2D extent, VkExtent2D size);

    // Returns the image, of that size and with undefined contents, for callers that record into it
    // instead of a copy and leave it in SHADER_READ_ONLY_OPTIMAL. The device must have finished the
    // last picture.
    const engine::Image& renew(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage);

    bool isThere() const { return shown_ != nullptr; }
    const engine::Image& image() const { return shown_->image; }
    ImTextureID id() const { return shown_->texture.id(); }
    VkExtent2D extent() const { return shown_->image.extent(); }
    // Size of the whole picture, px, which a preview stands for.
    VkExtent2D size() const { return size_; }

private:
    struct Texture {
        Texture(const engine::Device& device, const engine::ImageDescription& description)
            : image(device, description), texture(device, image) {}
        engine::Image image;
        engine::Ui::Texture texture;
    };

    const engine::Device& device_;
    std::unique_ptr<Texture> shown_;
    // The last picture of another size, which widgets may still show in the next frame.
    std::unique_ptr<Texture> retired_;
    VkExtent2D size_{};
    engine::Buffer staging_;
    std::optional<std::uint64_t> number_;  // of the last copied picture
};

// The difference of two shown pictures, as a picture that can also be shown.
class PictureDifference {
public:
    explicit PictureDifference(const engine::Device& device) : pass_(device), picture_(device) {}

    // Records the difference of two pictures of the same size, after their copies. The device must
    // have finished the last difference.
    void record(
        engine::Commands& commands, const ShownPicture& a, const ShownPicture& b,
        std::uint32_t gain);

    // Drops the last difference and its figures.
    void forget();

    bool isThere() const { return recorded_; }
    const ShownPicture& picture() const { return picture_; }
    // Figures of the previous difference, which the device has finished.
    const std::optional<DifferenceFigures>& figures() const { return figures_; }

private:
    DifferencePass pass_;
    ShownPicture picture_;
    bool recorded_ = false;
    std::optional<DifferenceFigures> figures_;
};

// The pictures in the window: their placement, and how one or two are shown.

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
