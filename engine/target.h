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

// An image to render to, in colour or depth attachment layout.
struct Attachment {
    const Image* image;
    Load load = Load::keep;
    std::array<float, 4> clear{};  // for depth the first number, see kFarDepth
    // Receives the mean of a colour pixel's samples when rendering ends; colour attachment layout.
    const Image* resolved = nullptr;
};

// Begins rendering to attachments of one size. `area` is the viewport, by default all of the
// attachments; required without attachments.
void beginRendering(
    Commands& commands, std::span<const Attachment> colors, const std::optional<Attachment>& depth,
    const std::optional<VkRect2D>& area = std::nullopt);
// Moves the viewport of the current rendering to a part of the attachments.
void setArea(Commands& commands, const VkRect2D& area);
void endRendering(Commands& commands);

struct TargetDescription {
    std::uint32_t width = 1;  // of the picture, px
    std::uint32_t height = 1;  // of the picture, px
    std::uint32_t msaa = 1;  // samples per rendered pixel
    std::uint32_t ssaa = 1;  // rendered pixels per picture pixel, along each side
    VkFormat color_format = VK_FORMAT_R8G8B8A8_UNORM;  // of the rendered image
    bool sampled_depth = false;  // shaders read the rendered depth
};

// How the output picture is made from the rendered image.
enum class Resolve {
    none,  // they are the same image: display colours, one sample per pixel
    attachment,  // mean of a pixel's samples, when rendering ends
    compute,  // in a pass of its own
};

Resolve resolveOf(const TargetDescription& description);

// Descriptions of a target's images.
struct TargetImages {
    std::optional<ImageDescription> color;  // none: the output serves as colour
    ImageDescription depth;
    ImageDescription output;
    std::optional<ImageDescription> radiance;  // if colour is floating-point
};

TargetImages imagesOf(const TargetDescription& description);

MemoryRows targetRows(const TargetDescription& description);

// The images of an offscreen picture: the colour and depth that passes render into; the output
// picture (8-bit RGBA, display-referred), which may be the colour image itself; and, if the colour
// is floating-point, the mean linear light of each output pixel.
class Target {
public:
    static constexpr VkFormat kOutputFormat = VK_FORMAT_R8G8B8A8_UNORM;
    static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
    static constexpr VkFormat kRadianceFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

    // Throws Unsupported if the device lacks the sample count or the size.
    Target(const Device& device, const TargetDescription& description)
        : Target(device, description, imagesOf(description)) {}

    // Whether the picture is complete when rendering ends, except with Resolve::compute.
    enum class Last { no, yes };
    // Draws go between beginRendering() and endRendering(), which get the same `last`. `background`
    // is for Load::clear.
    void beginRendering(
        Commands& commands, Load load, const std::array<float, 3>& background,
        Last last = Last::no) const;
    void endRendering(Commands& commands, Last last = Last::no) const;

    // Bracket dispatches between renderings that read depth(). Need sampled_depth.
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
    std::optional<Image> color_;  // none: the output serves as colour
    Image depth_;
    Image output_;
    std::optional<Image> radiance_;
};

// Returns the output picture's pixels: [row][column] RGBA, top row first.
std::vector<std::uint8_t> readOutput(const Device& device, const Target& target);

// Returns the mean linear light of the output pixels: [row][column] RGB. Needs hasRadiance().
std::vector<float> readRadiance(const Device& device, const Target& target);

}  // namespace engine
