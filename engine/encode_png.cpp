#include "engine/encode_png.h"

#include <cassert>

#include "engine/error.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace engine {

std::string
encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba) {
    assert(rgba.size() == std::size_t{4} * width * height);
    std::string bytes;
    const auto append = [](void* to, void* piece, int size) {
        static_cast<std::string*>(to)->append(
            static_cast<const char*>(piece), static_cast<std::size_t>(size));
    };
    if (!stbi_write_png_to_func(
            append, &bytes, static_cast<int>(width), static_cast<int>(height), 4, rgba.data(),
            static_cast<int>(width) * 4)) {
        throw Error("can't be encoded");
    }
    return bytes;
}

}  // namespace engine
