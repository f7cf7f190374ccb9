#pragma once

#include <filesystem>
#include <string>

namespace engine {

// The bytes of a file of at most 2 GiB, which is what decoders of pictures can count. Throws Error
// that names it.
std::string readFile(const std::filesystem::path& path);

}  // namespace engine
