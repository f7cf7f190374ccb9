#include "engine/image_file.h"

#include <cassert>

#include "engine/error.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>

namespace engine {

void writePng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba) {
    assert(rgba.size() == std::size_t{4} * width * height);
    std::error_code error;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
    const int row = static_cast<int>(width) * 4;
    if (!stbi_write_png(
            path.string().c_str(), static_cast<int>(width), static_cast<int>(height), 4,
            rgba.data(), row)) {
        throw Error(path.string(), "can't be written");
    }
}

}  // namespace engine
