#include "engine/pictures.h"

#include <cassert>
#include <limits>
#include <memory>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/float_pictures.h"
#include "engine/png_text.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#include <stb/stb_image.h>

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

Pixels decodeImage(std::string_view file) {
    if (file.size() > std::size_t{std::numeric_limits<int>::max()})
        throw Error("is larger than 2 GiB");
    const auto* data = reinterpret_cast<const stbi_uc*>(file.data());
    const int size = static_cast<int>(file.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        throw Error("not a PNG, JPEG, TGA or BMP");
    checkPictureSize(width, height);
    if (isPng(file)) checkPngData(file);
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
    if (!decoded) throw Error(std::string("can't be decoded: ") + stbi_failure_reason());
    return {
        static_cast<std::uint32_t>(width),
        static_cast<std::uint32_t>(height),
        {decoded.get(), decoded.get() + 4 * pixels}};
}

Pixels readImage(const std::filesystem::path& path) {
    const std::string bytes = readFile(path);
    try {
        return decodeImage(bytes);
    } catch (const Error& error) {
        throw Error(path.string(), error.what());
    }
}

void writePng(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba) {
    std::string bytes;
    try {
        bytes = encodePng(width, height, rgba);
    } catch (const Error& error) {
        throw Error(path.string(), error.what());
    }
    writeFileAtomically(path, bytes);
}

}  // namespace engine
