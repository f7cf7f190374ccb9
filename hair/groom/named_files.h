#pragma once

#include <filesystem>
#include <functional>

namespace hair::groom {

// Asked of every file that another one names - buffers and pictures of a glTF file, textures of a
// mesh - before it is opened; what it throws ends the reading. Empty: all are opened.
using NamedFileCheck = std::function<void(const std::filesystem::path& file)>;

}  // namespace hair::groom
