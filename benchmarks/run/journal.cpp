#include "benchmarks/run/journal.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/read_file.h"

namespace benchmarks {

namespace {

// Reads and compares like any file, but is not in the folder after a crash unless that is written.
void syncFolderOf(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;  // a folder that may be written but not read
    fsync(file);
    close(file);
}

// Errno's; 0: all is written.
int writeAt(int file, std::string_view text, std::uintmax_t offset) {
    while (!text.empty()) {
        const ssize_t taken = pwrite(file, text.data(), text.size(), static_cast<off_t>(offset));
        if (taken < 0 && errno == EINTR) continue;
        if (taken < 0) return errno;
        if (taken == 0) return ENOSPC;
        text.remove_prefix(static_cast<std::size_t>(taken));
        offset += static_cast<std::uintmax_t>(taken);
    }
    return fsync(file) == 0 ? 0 : errno;
}

}  // namespace

Journal::Journal(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), error);
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw engine::Error(path_.string(), std::strerror(errno));
    // Some file systems know no locks: there it goes without.
    if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(file_);
        throw engine::Error(path_.string(), "another run is writing it");
    }
}

Journal::~Journal() {
    if (file_ < 0) return;
    if (lseek(file_, 0, SEEK_END) == 0) unlink(path_.c_str());
    close(file_);
}

std::vector<Json> Journal::read() {
    const std::string text = engine::readFile(path_);
    std::vector<Json> lines;
    size_ = 0;
    for (std::size_t end; (end = text.find('\n', size_)) != std::string::npos; size_ = end + 1) {
        Json line = Json::parse(
            text.begin() + static_cast<std::ptrdiff_t>(size_),
            text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
        if (line.is_discarded() && lines.empty())
            throw engine::Error(path_.string(), "is no journal of hairbench run");
        if (line.is_discarded()) break;
        lines.push_back(std::move(line));
    }
    return lines;
}

void Journal::append(const Json& line) {
    // What drivers and commands say need not be UTF-8.
    const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
    int error = ftruncate(file_, static_cast<off_t>(size_)) == 0 ? 0 : errno;
    if (error == 0) error = writeAt(file_, text, size_);
    if (error != 0) {
        // Should that fail too, the next one who reads leaves the rest out.
        [[maybe_unused]] const int ignored = ftruncate(file_, static_cast<off_t>(size_));
        throw WriteFailed(path_.string() + ": cannot be written: " + std::strerror(error));
    }
    if (size_ == 0) syncFolderOf(path_);
    size_ += text.size();
}

void Journal::clear() { size_ = 0; }

void Journal::remove() {
    unlink(path_.c_str());
    close(std::exchange(file_, -1));
}

}  // namespace benchmarks
