#pragma once

#include <cstdint>

// What pictures of bytes and of floats have in common. The unit's own are decodeFloatImage(),
// readFloatImage() and writeExr() of pictures.h.
namespace engine {

// Throws Error, which doesn't name the file, for a picture of no pixels, or of more than 2^26.
void checkPictureSize(std::int64_t width, std::int64_t height);

}  // namespace engine
