#pragma once

#include <vector>

#include "engine/image_file.h"

namespace engine {

// What a picture's red, green and blue are; alpha is a plain number.
enum class Texels {
    display_color,  // in sRGB's curve
    data,
};

// The picture and smaller ones of it, each half as wide and high as the one before, rounded down,
// down to one pixel. A pixel is the mean of what it covers, of colours the mean of their light.
std::vector<Pixels> textureLevels(Pixels pixels, Texels texels);

}  // namespace engine
