#include "engine/image_file.h"

#include <cassert>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <string>

#include "engine/error.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#include <stb/stb_image.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>

namespace engine {
namespace {

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 26;

std::string readBytes(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw Error(
            path.string(), std::filesystem::exists(path, error) ? "not a file" : "no such file");
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw Error(path.string(), "can't be read");
    if (bytes.size() > std::size_t{std::numeric_limits<int>::max()})
        throw Error(path.string(), "is larger than 2 GiB");
    return bytes;
}

}  // namespace

Pixels readImage(const std::filesystem::path& path) {
    const std::string bytes = readBytes(path);
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        throw Error(path.string(), "not a PNG, JPEG, TGA or BMP");
    const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (width <= 0 || height <= 0 || pixels > kMostPixels) {
        throw Error(
            path.string(), std::to_string(width) + " by " + std::to_string(height) +
                               " pixels are outside [1, 2^26] in all");
    }
    const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
        stbi_load_from_memory(data, size, &width, &height, &channels, 4), stbi_image_free);
    if (!decoded)
        throw Error(path.string(), std::string("can't be decoded: ") + stbi_failure_reason());
    return {
        static_cast<std::uint32_t>(width),
        static_cast<std::uint32_t>(height),
        {decoded.get(), decoded.get() + 4 * pixels}};
}

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
