#pragma once

#include <cstdint>

// Shared by byte pictures and float pictures. The .cpp file also holds decodeFloatImage(),
// readFloatImage() and writeExr() of pictures.h.
namespace engine {

// Throws Error, which doesn't name the file, for a picture without pixels or with more than 2^26.
void checkPictureSize(std::int64_t width, std::int64_t height);

}  // namespace engine
