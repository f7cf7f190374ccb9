#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace benchmarks {

// RFC 4648, section 4: with padding, no line breaks.
std::string base64(std::string_view bytes);

// A picture file as a URI that holds it: "data:image/png;base64,...". Nothing where there is no
// such file, or what is there is neither PNG nor JPEG.
std::optional<std::string> pictureUri(const std::filesystem::path& file);

}  // namespace benchmarks
