#pragma once

#include <string>

#include "engine/image.h"
#include "engine/texture_levels.h"

namespace engine {

// What shaders read of a picture's display colours.
enum class Decoding {
    none,  // as they are
    linear,  // light
};

// A picture on the device with all its smaller levels, in SHADER_READ_ONLY_OPTIMAL.
class Texture {
public:
    // `decoding` is of display colours. Throws Unsupported for sides that the device hasn't.
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
