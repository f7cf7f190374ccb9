#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>

#include "engine/shaders.h"

namespace engine {

// Reads the project's shaders, with replacements for some of them.
inline ReadShader projectShaders(std::map<std::string, std::string> others = {}) {
    return [others = std::move(others)](const std::string& file) -> std::optional<std::string> {
        if (const auto other = others.find(file); other != others.end()) return other->second;
        std::ifstream stream(
            std::filesystem::path(HAIRBENCH_SOURCE_DIR) / "shaders" / file, std::ios::binary);
        if (!stream) return std::nullopt;
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
}

}  // namespace engine
