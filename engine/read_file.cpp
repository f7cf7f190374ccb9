#include "engine/read_file.h"

#include <fstream>
#include <iterator>
#include <limits>

#include "engine/error.h"

namespace engine {

std::string readFile(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw Error(
            path.string(), std::filesystem::exists(path, error) ? "not a file" : "no such file");
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw Error(path.string(), "can't be read");
    if (bytes.size() > std::size_t{std::numeric_limits<int>::max()})
        throw Error(path.string(), "is larger than 2 GiB");
    return bytes;
}

}  // namespace engine
