#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace hair {

// ".glb" for "head.GLB".
inline std::string lowerCaseExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return extension;
}

}  // namespace hair
