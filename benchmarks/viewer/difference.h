#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "engine/buffer_image.h"
#include "engine/pipeline.h"
#include "engine/ui.h"

namespace engine {
class Commands;
class Image;
}  // namespace engine

// Copies of the drawn pictures for widgets, and the difference of two: as a picture and in figures.
namespace benchmarks::viewer {

// How much two pictures differ, in steps of 1/255 of display colours. Exact.
struct DifferenceFigures {
    std::uint64_t pixels = 0;  // that a picture has
    std::uint64_t different = 0;  // pixels that differ in at least one channel
    std::uint32_t most = 0;  // largest difference of a channel
    std::uint64_t sum = 0;  // sum of differences over red, green and blue of all pixels

    // Mean difference of a channel of a pixel.
    double mean() const { return static_cast<double>(sum) / (3.0 * static_cast<double>(pixels)); }
    // Share of the pixels that differ.
    double share() const { return static_cast<double>(different) / static_cast<double>(pixels); }

    bool operator==(const DifferenceFigures&) const = default;
};

// Makes the picture of the difference of two, and its figures.
class DifferencePass {
public:
    explicit DifferencePass(const engine::Device& device);

    // `a` and `b` are 8-bit RGBA of one size and in SHADER_READ_ONLY_OPTIMAL; `difference` is a
    // storage image of that size and in GENERAL, and gets |a - b| times `gain`. Their alpha does
    // not count. What was written before must be visible to compute.
    void record(
        engine::Commands& commands, const engine::Image& a, const engine::Image& b,
        const engine::Image& difference, std::uint32_t gain);

    // The figures of the pictures recorded last, once the device is done with them.
    DifferenceFigures figures() const;

private:
    engine::ComputePipeline pipeline_;
    engine::Buffer counts_;
    engine::Buffer readback_;
    std::uint64_t pixels_ = 0;
};

// "at most 37 of 255, on average 0.42; 12.3 % of the pixels differ", or "identical".
std::string differenceText(const DifferenceFigures& figures);

// A picture that widgets can show, pixel by pixel as it was drawn, on whichever device that was.
class ShownPicture {
public:
    explicit ShownPicture(const engine::Device& device) : device_(device) {}

    // Records the copy of a picture of the host's, RGBA, top row first, unless it is the one that
    // was copied last, by its number. It is shown as large as `size` says: of a preview it has
    // fewer pixels. The device must be done with the last copy. False where widgets that were made
    // before show the last picture still, which had another size.
    bool copy(
        engine::Commands& commands, std::uint64_t number, std::span<const std::uint8_t> rgba,
        VkExtent2D extent, VkExtent2D size);

    // The image, of that size and with undefined contents, for callers that record into it instead
    // of a copy and leave it in SHADER_READ_ONLY_OPTIMAL. The device must be done with the last
    // picture.
    const engine::Image& renew(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage);

    bool isThere() const { return shown_ != nullptr; }
    const engine::Image& image() const { return shown_->image; }
    ImTextureID id() const { return shown_->texture.id(); }
    VkExtent2D extent() const { return shown_->image.extent(); }
    // px of the picture that it stands for.
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
    // The last picture of another size: widgets that are about to be drawn still show it.
    std::unique_ptr<Texture> retired_;
    VkExtent2D size_{};
    engine::Buffer staging_;
    std::optional<std::uint64_t> number_;  // of the picture that was copied last
};

// The difference of two pictures that are shown, as a picture that can be shown too.
class PictureDifference {
public:
    explicit PictureDifference(const engine::Device& device) : pass_(device), picture_(device) {}

    // Records the difference of pictures of one size whose copies were recorded before. The device
    // must be done with the last difference.
    void record(
        engine::Commands& commands, const ShownPicture& a, const ShownPicture& b,
        std::uint32_t gain);

    // Drops the last difference and its figures.
    void forget();

    bool isThere() const { return recorded_; }
    const ShownPicture& picture() const { return picture_; }
    // The figures of the difference before the last one, which the device is done with.
    const std::optional<DifferenceFigures>& figures() const { return figures_; }

private:
    DifferencePass pass_;
    ShownPicture picture_;
    bool recorded_ = false;
    std::optional<DifferenceFigures> figures_;
};

}  // namespace benchmarks::viewer
