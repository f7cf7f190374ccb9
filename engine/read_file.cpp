#include "engine/read_file.h"

#include <array>
#include <limits>

#include "engine/error.h"

namespace engine {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargest = std::numeric_limits<int>::max();

std::ifstream opened(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) throw Error(path.string(), "no such file");
    if (fs::is_directory(path, error)) throw Error(path.string(), "not a file");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(path.string(), "can't be read");
    return file;
}

}  // namespace

OpenFile::OpenFile(const fs::path& path) : name_(path.string()) {
    std::error_code error;
    // Opening a pipe would wait for its writer.
    if (fs::is_other(path, error)) throw Error(name_, "not a file");
    file_ = opened(path);
    size_ = fs::file_size(path, error);
    if (error) throw Error(name_, "can't be read");
}

void OpenFile::read(std::span<char> bytes) {
    file_.seekg(0);
    file_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file_) throw Error(name_, "can't be read");
}

std::string readFile(const fs::path& path) {
    std::ifstream file = opened(path);
    std::string bytes;
    std::array<char, 1 << 16> part;
    while (file) {
        file.read(part.data(), part.size());
        bytes.append(part.data(), static_cast<std::size_t>(file.gcount()));
        if (bytes.size() > kLargest) throw Error(path.string(), "is larger than 2 GiB");
    }
    if (!file.eof()) throw Error(path.string(), "can't be read");
    return bytes;
}

}  // namespace engine
