#pragma once

#include <filesystem>
#include <functional>

namespace hair::groom {

// Called for every file that another file names (buffers and pictures of a glTF file, textures of a
// mesh) before it is opened. An exception of it ends the reading. Empty: all files are opened.
using NamedFileCheck = std::function<void(const std::filesystem::path& file)>;

}  // namespace hair::groom
