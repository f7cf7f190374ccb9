#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/commands.h"

// Rendering to images, and the images of an offscreen picture.
namespace engine {

enum class Load { clear, keep };

// An image that is rendered to; color or depth attachment layout.
struct Attachment {
    const Image* image;
    Load load = Load::keep;
    std::array<float, 4> clear{};  // of a color; of depth the first number, see kFarDepth
    // Gets the mean of a color's samples when rendering ends; color attachment layout.
    const Image* resolved = nullptr;
};

// Begins rendering to attachments of one size. The viewport is `area`, by default all of the
// attachments; without attachments it has to be given.
void beginRendering(
    Commands& commands, std::span<const Attachment> colors, const std::optional<Attachment>& depth,
    const std::optional<VkRect2D>& area = std::nullopt);
// Moves the viewport of what is being rendered to a part of the attachments.
void setArea(Commands& commands, const VkRect2D& area);
void endRendering(Commands& commands);

struct TargetDescription {
    std::uint32_t width = 1;   // of the picture, px
    std::uint32_t height = 1;  // of the picture, px
    std::uint32_t msaa = 1;    // samples per rendered pixel
    std::uint32_t ssaa = 1;    // rendered pixels per picture pixel, along each side
    VkFormat color_format = VK_FORMAT_R8G8B8A8_UNORM;  // of what is rendered
    bool sampled_depth = false;  // shaders read the depth of what is rendered
};

// How an output picture comes of what is rendered.
enum class Resolve {
    none,  // it is what is rendered to: display colors with one sample a pixel
    attachment,  // the mean of a pixel's samples, when rendering ends
    compute,  // by a pass of its own
};

Resolve resolveOf(const TargetDescription& description);

// The images that a target is made of.
struct TargetImages {
    std::optional<ImageDescription> color;  // none: the output is
    ImageDescription depth;
    ImageDescription output;
    std::optional<ImageDescription> radiance;  // where color is floats
};

TargetImages imagesOf(const TargetDescription& description);

// Bytes of all of them (imageBytes()).
std::uint64_t targetBytes(const TargetDescription& description);

// The images of an offscreen picture: color and depth that passes render into, the output picture
// (8-bit RGBA, display-referred), which may be the same image as color, and, where color is floats,
// the mean linear light of each of its pixels.
class Target {
public:
    static constexpr VkFormat kOutputFormat = VK_FORMAT_R8G8B8A8_UNORM;
    static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
    static constexpr VkFormat kRadianceFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

    // Throws Unsupported where the device lacks the sample count or the size.
    Target(const Device& device, const TargetDescription& description)
        : Target(device, description, imagesOf(description)) {}

    // Whether a picture is complete when rendering ends, but for Resolve::compute.
    enum class Last { no, yes };
    // What is drawn goes between beginRendering() and endRendering(), which are told the same of
    // `last`; `background` is for Load::clear.
    void beginRendering(
        Commands& commands, Load load, const std::array<float, 3>& background,
        Last last = Last::no) const;
    void endRendering(Commands& commands, Last last = Last::no) const;

    // Bracket dispatches between renderings that read depth(); needs sampled_depth.
    void beginDepthRead(Commands& commands) const;
    void endDepthRead(Commands& commands) const;

    // Bracket a compute pass that reads color() and writes output() and radiance().
    void beginResolve(Commands& commands) const;
    void endResolve(Commands& commands) const;

    Resolve resolve() const { return resolveOf(description_); }

    const TargetDescription& description() const { return description_; }
    const Image& color() const { return color_ ? *color_ : output_; }
    const Image& depth() const { return depth_; }
    const Image& output() const { return output_; }  // TRANSFER_SRC_OPTIMAL once complete
    bool hasRadiance() const { return radiance_.has_value(); }
    const Image& radiance() const {
        return *radiance_;
    }  // TRANSFER_SRC_OPTIMAL once complete; needs hasRadiance()

private:
    Target(const Device& device, const TargetDescription& description, const TargetImages& images);

    TargetDescription description_;
    std::optional<Image> color_;  // none: the output is
    Image depth_;
    Image output_;
    std::optional<Image> radiance_;
};

// The output picture's pixels: [row][column] RGBA, top row first.
std::vector<std::uint8_t> readOutput(const Device& device, const Target& target);

// The mean linear light of the output picture's pixels: [row][column] RGB. Needs hasRadiance().
std::vector<float> readRadiance(const Device& device, const Target& target);

}  // namespace engine
