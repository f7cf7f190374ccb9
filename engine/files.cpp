#include "engine/files.h"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <ext/stdio_filebuf.h>

#include "engine/process.h"

namespace engine {

// ---- Files --------------------------------------------------------------------------------------

namespace {

namespace fs = std::filesystem;

std::ifstream opened(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) throw Error(path.string(), "no such file");
    if (fs::is_directory(path, error)) throw Error(path.string(), "is not a file");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(path.string(), "can't be read");
    return file;
}

using Writer = std::function<void(std::ostream&)>;

// An open file that calls `poll` before every piece written, keeps the error of a failed write, and
// is closed at the end.
class PolledFile : public __gnu_cxx::stdio_filebuf<char> {
public:
    PolledFile(int descriptor, const WritePoll& poll)
        : stdio_filebuf(descriptor, std::ios::out | std::ios::binary), poll_(poll) {}

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

// Writes an open file and closes it. `name` is the file's name in errors.
void writeFile(int descriptor, const fs::path& name, const Writer& write, const WritePoll& poll) {
    PolledFile file(descriptor, poll);
    const auto fail_here = [&] { fail(name, file.error()); };
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

constexpr std::size_t kLongestName = 255;  // bytes, without the folder
constexpr std::size_t kLongestSuffix = 8;  // ".journal"

// Returns a random name beside the target, so that nobody can guess it and put a link there.
fs::path partialName(const fs::path& target) {
    std::uint64_t number = 0;
    if (getrandom(&number, sizeof number, 0) != sizeof number) fail(target, errno);
    char suffix[32];
    const int size = std::snprintf(
        suffix, sizeof suffix, ".%016llx.partial", static_cast<unsigned long long>(number));
    const std::string name = target.filename().string();
    return target.parent_path() /
           (name.substr(0, kLongestName - static_cast<std::size_t>(size)) + suffix);
}

// Creates a file and fails if the path exists, even as a link. `name` is the file's name in errors.
int makeFile(const fs::path& path, const fs::path& name) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) fail(name, errno);
    return descriptor;
}

// `name` is the file's name in errors.
void replaceFile(
    const fs::path& target, const fs::path& name, const Writer& write, const WritePoll& poll) {
    const fs::path partial = partialName(target);
    const Leftover leftover(partial);
    const int descriptor = makeFile(partial, name);
    std::error_code error;
    try {
        writeFile(descriptor, name, write, poll);
        if (const fs::file_status there = fs::symlink_status(target, error);
            fs::is_regular_file(there))
            fs::permissions(partial, there.permissions(), error);
        fs::rename(partial, target, error);
        if (error) fail(name, error.value());
    } catch (...) {
        fs::remove(partial, error);
        throw;
    }
}

// Returns the descriptor if the path is an open file of the program, like /dev/stdout and the
// shell's >(command), or a link to one.
std::optional<int> openAlready(fs::path path) {
    constexpr int kMostLinks = 40;  // Linux follows as many
    for (int i = 0; i < kMostLinks; ++i) {
        if (path == "/dev/stdout") return STDOUT_FILENO;
        if (path == "/dev/stderr") return STDERR_FILENO;
        const fs::path folder = path.parent_path();
        const std::string name = path.filename().string();
        if ((folder == "/dev/fd" || folder == "/proc/self/fd") && !name.empty() &&
            name.size() < 8 && name.find_first_not_of("0123456789") == std::string::npos)
            return std::stoi(name);
        std::error_code error;
        const fs::path to = fs::read_symlink(path, error);
        if (error) break;
        path = (folder / to).lexically_normal();
    }
    return std::nullopt;
}

// Creates the folder of the file.
void makePlaceFor(const fs::path& path) {
    std::error_code error;
    const fs::file_type type = fs::status(path, error).type();
    if ((type == fs::file_type::fifo || type == fs::file_type::socket) && !openAlready(path))
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
    if (fs::is_other(path, error)) throw Error(name_, "is not a file");
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
            "is larger than " + (largest == kLargestFile ? "2 GiB"
                                 : mebibytes > 0         ? std::to_string(mebibytes) + " MiB"
                                                         : std::to_string(largest >> 10) + " KiB"));
    };
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error) &&
        !fs::is_directory(path, error) && path != "/dev/stdin")
        throw Error(path.string(), "is not a file");
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

bool isReplaceable(const fs::path& path) {
    std::error_code error;
    return !openAlready(path) && (!fs::exists(path, error) || fs::is_regular_file(path, error));
}

void writeFileAtomically(const fs::path& path, const Writer& write, const WritePoll& poll) {
    makePlaceFor(path);
    if (const auto known = openAlready(path)) {
        const int descriptor = fcntl(*known, F_DUPFD_CLOEXEC, 0);
        if (descriptor < 0) fail(path, errno);
        return writeFile(descriptor, path, write, poll);
    }
    std::error_code error;
    const bool there = fs::exists(path, error);
    if (error) fail(path, error.value());  // circular links, or a name that is too long
    if (there && !fs::is_regular_file(path, error)) {
        const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor < 0) fail(path, errno);
        return writeFile(descriptor, path, write, poll);
    }
    const fs::path target = there ? fs::canonical(path, error) : path;
    replaceFile(target, path, write, poll);
}

void replaceFile(const fs::path& path, const Writer& write) {
    std::error_code ignored;
    fs::create_directories(path.parent_path(), ignored);
    replaceFile(path, path, write, {});
}

void trimCache(
    const fs::path& folder, std::uintmax_t most_bytes,
    const std::function<bool(std::string_view name)>& is_entry) {
    constexpr std::chrono::hours kStale{1};  // no writer takes that long
    struct Entry {
        fs::path path;
        fs::file_time_type used;
        std::uintmax_t size;
    };
    std::vector<Entry> entries;
    std::uintmax_t bytes = 0;
    std::error_code error;
    const fs::file_time_type now = fs::file_time_type::clock::now();
    for (const fs::directory_entry& each : fs::directory_iterator(folder, error)) {
        std::error_code gone;  // another process may have removed it
        const Entry entry{each.path(), each.last_write_time(gone), each.file_size(gone)};
        if (gone) continue;
        const fs::path name = entry.path.filename();
        if (name.extension() == ".partial") {  // partialName()
            if (now - entry.used > kStale && is_entry(name.stem().stem().native()))
                fs::remove(entry.path, gone);
        } else if (is_entry(name.native())) {
            bytes += entry.size;
            entries.push_back(entry);
        }
    }
    std::ranges::sort(entries, {}, &Entry::used);
    for (const Entry& entry : entries) {
        if (bytes <= most_bytes) break;
        fs::remove(entry.path, error);
        bytes -= entry.size;
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
    // A name that is too long, by itself or with the longest suffix, or broken links.
    error.clear();
    if (!fs::status_known(fs::status(path, error))) fail(path, error.value());
    if (path.filename().string().size() > kLongestName - kLongestSuffix) fail(path, ENAMETOOLONG);
}

// ---- The program's own files --------------------------------------------------------------------

namespace {

namespace fs = std::filesystem;

// Returns the parent of the program's folder.
fs::path prefix() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return program.parent_path().parent_path();
}

fs::path userDataFolder() {
    if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data)
        return fs::path(data) / "hairbench";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".local/share/hairbench";
    return {};
}

// A script that is installed with the program; in the source tree, scripts/setup runs it.
constexpr const char* kMaker = "python-environment";

}  // namespace

fs::path programFile(std::string_view name) {
    std::error_code error;
    const fs::path file = prefix() / "share/hairbench" / name;
    const fs::path place = fs::weakly_canonical(file, error);
    return error ? file : place;
}

fs::path helperProgram(std::string_view name) { return prefix() / "libexec/hairbench" / name; }

fs::path pythonEnvironment(const std::string& name) {
    std::error_code error;
    const fs::path made = programFile(".deps") / name;
    const fs::path users = userDataFolder();
    return users.empty() || fs::exists(made, error) ? made : users / name;
}

std::string pythonInterpreter(const std::string& name, const char* override) {
    const char* const wanted = std::getenv(override);
    return wanted && *wanted ? wanted : (pythonEnvironment(name) / "bin/python").string();
}

std::string makesPythonEnvironment(const std::string& name) {
    std::error_code error;
    const fs::path maker = helperProgram(kMaker);
    return fs::exists(maker, error) ? maker.string() + ' ' + name : "scripts/setup --" + name;
}

}  // namespace engine
