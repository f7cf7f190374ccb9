#include "benchmarks/report_page/picture_uri.h"

#include <cstdint>

#include "engine/read_file.h"

namespace benchmarks {

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? digits[bits >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::optional<std::string> pictureUri(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    const std::string bytes = engine::readFile(file);
    if (bytes.starts_with("\x89PNG\r\n")) return "data:image/png;base64," + base64(bytes);
    if (bytes.starts_with("\xff\xd8\xff")) return "data:image/jpeg;base64," + base64(bytes);
    return std::nullopt;
}

}  // namespace benchmarks
