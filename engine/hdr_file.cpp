#include <memory>
#include <string>

#include "engine/error.h"
#include "engine/float_formats.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_HDR
#include <stb/stb_image.h>

namespace engine {

FloatPixels decodeHdr(std::string_view file) {
    const auto* data = reinterpret_cast<const stbi_uc*>(file.data());
    const int size = static_cast<int>(file.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        throw Error("not a Radiance HDR picture");
    checkPictureSize(width, height);
    const std::unique_ptr<float, void (*)(void*)> decoded(
        stbi_loadf_from_memory(data, size, &width, &height, &channels, 3), stbi_image_free);
    if (!decoded) throw Error(std::string("can't be decoded: ") + stbi_failure_reason());
    const std::size_t values =
        std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {
        static_cast<std::uint32_t>(width),
        static_cast<std::uint32_t>(height),
        {decoded.get(), decoded.get() + values}};
}

}  // namespace engine
