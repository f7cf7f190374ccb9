#pragma once

#include <string_view>

#include "engine/pictures.h"

// The formats of readFloatImage, and what all pictures have in common. Errors don't name the file.
namespace engine {

FloatPixels decodeExr(std::string_view file);
FloatPixels decodeHdr(std::string_view file);  // Radiance's RGBE

// Throws Error for a picture of no pixels, or of more than 2^26.
void checkPictureSize(std::int64_t width, std::int64_t height);

}  // namespace engine
