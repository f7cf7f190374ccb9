#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace engine {

// A file that is open for reading, of any size. Throws Error that names it.
class OpenFile {
public:
    explicit OpenFile(const std::filesystem::path& path);

    std::uintmax_t size() const { return size_; }

    // The first of its bytes, as many as there is room for.
    void read(std::span<char> bytes);

private:
    std::string name_;
    std::ifstream file_;
    std::uintmax_t size_ = 0;
};

// The bytes of a file of at most 2 GiB, which is what decoders of pictures can count, or of a pipe
// up to its end. Throws Error that names it.
std::string readFile(const std::filesystem::path& path);

}  // namespace engine
