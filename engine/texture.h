#pragma once

#include <string>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/pictures.h"

namespace engine {

// What a picture's red, green and blue are; alpha is a plain number.
enum class Texels {
    display_color,  // in sRGB's curve
    data,
};

// The picture and smaller ones of it, each half as wide and high as the one before, rounded down,
// down to one pixel. A pixel is the mean of what it covers, of colours the mean of their light.
std::vector<Pixels> textureLevels(Pixels pixels, Texels texels);

// What shaders read of a picture's display colours.
enum class Decoding {
    none,  // as they are
    linear,  // light
};

// A picture on the device with all its smaller levels, in SHADER_READ_ONLY_OPTIMAL.
class Texture {
public:
    // `decoding` is for display colours. Throws Unsupported for sides that the device hasn't.
    Texture(
        const Device& device, const Pixels& pixels, Texels texels, Decoding decoding,
        const std::string& name);

    const Image& image() const { return image_; }

private:
    Texture(
        const Device& device, const std::vector<Pixels>& levels, VkFormat format,
        const std::string& name);

    Image image_;
};

}  // namespace engine
