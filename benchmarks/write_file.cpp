#include "benchmarks/write_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <unistd.h>

#include "engine/error.h"

namespace benchmarks {
namespace {

namespace fs = std::filesystem;

bool writeFile(const fs::path& path, std::string_view text) {
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    return !file.fail();
}

// Makes the folder that the file is to be in.
void makePlaceFor(const fs::path& path) {
    std::error_code error;
    if (path.filename().empty() || fs::is_directory(path, error))
        throw engine::Error(path.string(), "is a folder, not a file to write");
    error.clear();
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    if (error)
        throw engine::Error(path.parent_path().string(), "cannot be made: " + error.message());
}

}  // namespace

void writeFileAtomically(const fs::path& path, std::string_view text) {
    makePlaceFor(path);
    std::error_code error;
    const bool in_place = fs::exists(path, error) && !fs::is_regular_file(path, error);
    const fs::path target = in_place ? path : fs::path(path.string() + ".partial");
    if (!writeFile(target, text)) {
        if (!in_place) fs::remove(target, error);
        throw engine::Error(path.string(), "cannot be written");
    }
    if (in_place) return;
    fs::rename(target, path, error);
    if (!error) return;
    const std::string reason = error.message();
    fs::remove(target, error);
    throw engine::Error(path.string(), "cannot be written: " + reason);
}

void checkWritable(const fs::path& path) {
    makePlaceFor(path);
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const fs::path probe = fs::exists(path, error) ? path : folder;
    if (access(probe.c_str(), W_OK) != 0)
        throw engine::Error(
            path.string(), std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace benchmarks
