#include <string>

#include "engine/error.h"
#include "engine/float_formats.h"
#include "engine/read_file.h"

namespace engine {

void checkPictureSize(std::int64_t width, std::int64_t height) {
    constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
    if (width > 0 && height > 0 && width <= kMostPixels / height) return;
    throw Error(
        std::to_string(width) + " by " + std::to_string(height) +
        " pixels are outside [1, 2^26] in all");
}

FloatPixels readFloatImage(const std::filesystem::path& path) {
    const std::string bytes = readFile(path);
    try {
        if (bytes.starts_with("\x76\x2f\x31\x01")) return decodeExr(bytes);
        if (bytes.starts_with("#?")) return decodeHdr(bytes);
        throw Error("neither OpenEXR nor Radiance HDR");
    } catch (const Error& error) {
        throw Error(path.string(), error.what());
    }
}

}  // namespace engine
