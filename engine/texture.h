#pragma once

#include <string>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/pictures.h"

namespace engine {

// Meaning of a picture's red, green and blue. Alpha is always linear.
enum class Texels {
    display_color,  // sRGB-encoded
    data,
};

// Returns the picture and its smaller levels (mipmaps), each half as wide and high as the last,
// rounded down, to one pixel. A pixel is the mean of the area it covers; for colours, the mean of
// their linear light.
std::vector<Pixels> textureLevels(Pixels pixels, Texels texels);

// How shaders read a picture's display colours.
enum class Decoding {
    none,  // unchanged
    linear,  // as linear light
};

// A picture on the device with all its mip levels, in SHADER_READ_ONLY_OPTIMAL.
class Texture {
public:
    // `decoding` is for display colours. Throws Unsupported for sizes that the device lacks.
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
