#include "engine/files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>

#include <unistd.h>

#include "engine/error.h"
#include "engine/process.h"

namespace engine {
namespace {

namespace fs = std::filesystem;

std::ifstream opened(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) throw Error(path.string(), "no such file");
    if (fs::is_directory(path, error)) throw Error(path.string(), "not a file");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(path.string(), "can't be read");
    return file;
}

using Writer = std::function<void(std::ostream&)>;

// A file that calls `poll` before every piece written, and keeps the error of a failed write.
class PolledFile : public std::filebuf {
public:
    PolledFile(const fs::path& path, const WritePoll& poll) : poll_(poll) {
        open(path, std::ios::out | std::ios::binary);
        if (!is_open()) error_ = errno;
    }

    int error() const { return error_; }  // errno value; 0: none

protected:
    int_type overflow(int_type byte) override {
        if (poll_) poll_();
        const int_type result = std::filebuf::overflow(byte);
        keepError(result == traits_type::eof());
        return result;
    }

    std::streamsize xsputn(const char* bytes, std::streamsize count) override {
        constexpr std::streamsize kPiece = 1 << 20;
        std::streamsize done = 0;
        while (done < count) {
            if (poll_) poll_();
            const std::streamsize piece = std::min(kPiece, count - done);
            const std::streamsize taken = std::filebuf::xsputn(bytes + done, piece);
            done += taken;
            keepError(taken < piece);
            if (taken < piece) break;
        }
        return done;
    }

    int sync() override {
        const int result = std::filebuf::sync();
        keepError(result != 0);
        return result;
    }

private:
    void keepError(bool failed) {
        if (failed && error_ == 0) error_ = errno;
    }

    const WritePoll& poll_;
    int error_ = 0;
};

// `error` is an errno value.
[[noreturn]] void fail(const fs::path& path, int error) {
    const std::string reason =
        std::string("cannot be written: ") + (error == 0 ? "unknown reason" : std::strerror(error));
    if (error == 0 || error == ENOSPC || error == EDQUOT || error == EFBIG || error == EIO)
        throw WriteFailed(path.string(), reason);
    throw Error(path.string(), reason);
}

// `name` is the file's name in errors.
void writeFile(
    const fs::path& path, const fs::path& name, const Writer& write, const WritePoll& poll) {
    PolledFile file(path, poll);
    const auto fail_here = [&] { fail(name, file.error()); };
    if (!file.is_open()) fail_here();
    std::ostream stream(&file);
    stream.exceptions(std::ios::badbit);  // to stop at the first failure
    try {
        write(stream);
        stream.flush();
    } catch (const std::ios_base::failure&) {
        fail_here();
    }
    if (stream.fail() || !file.close()) fail_here();
    if (poll) poll();
}

// Whether the path is an open file of the program, like /dev/stdout and the shell's >(command).
bool isOpenAlready(const fs::path& path) {
    const fs::path folder = path.parent_path();
    return folder == "/dev/fd" || folder == "/proc/self/fd" || path == "/dev/stdout" ||
           path == "/dev/stderr";
}

// Creates the folder of the file.
void makePlaceFor(const fs::path& path) {
    std::error_code error;
    const fs::file_type type = fs::status(path, error).type();
    if ((type == fs::file_type::fifo || type == fs::file_type::socket) && !isOpenAlready(path))
        throw Error(path.string(), "is a pipe or a socket, which waits for its reader");
    if (type == fs::file_type::block) throw Error(path.string(), "is a disk, not a file to write");
    error.clear();
    if (path.filename().empty() || fs::is_directory(path, error))
        throw Error(path.string(), "is a folder, not a file to write");
    error.clear();
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    if (error) throw Error(path.parent_path().string(), "cannot be made: " + error.message());
}

}  // namespace

// ---- Reading ------------------------------------------------------------------------------------

OpenFile::OpenFile(const fs::path& path) : name_(path.string()) {
    std::error_code error;
    // Opening a pipe would wait for a writer.
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

std::string readFile(const fs::path& path, std::size_t largest) {
    const auto too_large = [&] {
        const std::size_t mebibytes = largest >> 20;
        throw Error(
            path.string(),
            "is larger than " +
                (largest == kLargestFile ? "2 GiB" : std::to_string(mebibytes) + " MiB"));
    };
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error) &&
        !fs::is_directory(path, error) && path != "/dev/stdin")
        throw Error(path.string(), "not a file");
    std::ifstream file = opened(path);
    if (fs::is_regular_file(path, error) && fs::file_size(path, error) > largest) too_large();
    std::string bytes;
    std::array<char, 1 << 16> part;
    while (file) {
        file.read(part.data(), part.size());
        bytes.append(part.data(), static_cast<std::size_t>(file.gcount()));
        if (bytes.size() > largest) too_large();
    }
    if (!file.eof()) throw Error(path.string(), "can't be read");
    return bytes;
}

// ---- Writing ------------------------------------------------------------------------------------

void writeFileAtomically(const fs::path& path, std::string_view text) {
    writeFileAtomically(path, [&](std::ostream& file) {
        file.write(text.data(), static_cast<std::streamsize>(text.size()));
    });
}

void writeFileAtomically(const fs::path& path, const Writer& write, const WritePoll& poll) {
    makePlaceFor(path);
    std::error_code error;
    const bool there = fs::exists(path, error);
    if (error) fail(path, error.value());  // circular links, or a name that is too long
    if (there && !fs::is_regular_file(path, error)) return writeFile(path, path, write, poll);
    const fs::path target = there ? fs::canonical(path, error) : path;
    const fs::path partial(target.string() + ".partial");
    const Leftover leftover(partial);
    try {
        writeFile(partial, path, write, poll);
        if (there) fs::permissions(partial, fs::status(target).permissions(), error);
        fs::rename(partial, target, error);
        if (error) fail(path, error.value());
    } catch (...) {
        fs::remove(partial, error);
        throw;
    }
}

fs::path userCacheFolder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return fs::path(cache) / "hairbench";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".cache" / "hairbench";
    return {};
}

void checkWritable(const fs::path& path) {
    makePlaceFor(path);
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const fs::path probe = fs::exists(path, error) ? path : folder;
    if (access(probe.c_str(), W_OK) != 0) fail(path, errno);
    // A name that is too long, or broken links.
    for (const fs::path& each : {path, fs::path(path.string() + ".partial")}) {
        error.clear();
        const fs::file_status status = fs::status(each, error);
        if (!fs::status_known(status)) fail(path, error.value());
    }
}

}  // namespace engine
