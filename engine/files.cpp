#include "engine/files.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/process.h"
#include "engine/system/files.h"

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

// A buffer of an open file that calls `poll` before every piece written and keeps the error of a
// failed write.
class PolledFile : public std::streambuf {
public:
    PolledFile(system::File file, const WritePoll& poll) : file_(std::move(file)), poll_(poll) {
        setp(buffer_.data(), buffer_.data() + buffer_.size());
    }

    int error() const { return error_; }  // errno value; 0: none

    // Returns whether the system took everything.
    bool close() {
        const bool flushed = sync() == 0;
        keep(file_.close());
        return flushed && error_ == 0;
    }

protected:
    int_type overflow(int_type byte) override {
        if (sync() != 0) return traits_type::eof();
        if (!traits_type::eq_int_type(byte, traits_type::eof()))
            sputc(traits_type::to_char_type(byte));
        return traits_type::not_eof(byte);
    }

    std::streamsize xsputn(const char* bytes, std::streamsize count) override {
        if (count < epptr() - pptr()) {
            std::copy_n(bytes, count, pptr());
            pbump(static_cast<int>(count));
            return count;
        }
        constexpr std::size_t kPiece = std::size_t{1} << 20;
        if (sync() != 0) return 0;
        std::string_view rest(bytes, static_cast<std::size_t>(count));
        for (; !rest.empty(); rest.remove_prefix(std::min(kPiece, rest.size())))
            if (!write(rest.substr(0, kPiece)))
                return count - static_cast<std::streamsize>(rest.size());
        return count;
    }

    int sync() override {
        const std::string_view kept(pbase(), static_cast<std::size_t>(pptr() - pbase()));
        setp(buffer_.data(), buffer_.data() + buffer_.size());
        return kept.empty() || write(kept) ? 0 : -1;
    }

private:
    bool write(std::string_view bytes) {
        if (poll_) poll_();
        const int error = file_.write(bytes);
        keep(error);
        return error == 0;
    }

    void keep(int error) {
        if (error_ == 0) error_ = error;
    }

    system::File file_;
    const WritePoll& poll_;
    std::array<char, 1 << 14> buffer_;
    int error_ = 0;
};

// `error` is an errno value.
[[noreturn]] void fail(const fs::path& path, int error) {
    const std::string reason =
        "cannot be written: " +
        (error == 0 ? "unknown reason" : std::generic_category().message(error));
    if (error == 0 || system::isWriteFailure(error)) throw WriteFailed(path.string(), reason);
    throw Error(path.string(), reason);
}

// Writes an open file and closes it. `name` is the file's name in errors.
void writeFile(
    system::Opened opened, const fs::path& name, const Writer& write, const WritePoll& poll) {
    if (!opened.file.isOpen()) fail(name, opened.error);
    PolledFile file(std::move(opened.file), poll);
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
    std::random_device device;
    const std::uint64_t number = std::uint64_t{device()} << 32 | device();
    char suffix[32];
    const int size = std::snprintf(
        suffix, sizeof suffix, ".%016llx.partial", static_cast<unsigned long long>(number));
    std::string name = target.filename().string();
    if (std::size_t kept = kLongestName - static_cast<std::size_t>(size); kept < name.size()) {
        while (kept > 0 && (name[kept] & 0xc0) == 0x80) --kept;  // no part of a UTF-8 character
        name.resize(kept);
    }
    return target.parent_path() / (name + suffix);
}

// `name` is the file's name in errors.
void replaceFile(
    const fs::path& target, const fs::path& name, const Writer& write, const WritePoll& poll) {
    const fs::path partial = partialName(target);
    const Leftover leftover(partial);
    system::Opened opened = system::createFile(partial);
    if (!opened.file.isOpen()) fail(name, opened.error);
    std::error_code error;
    try {
        writeFile(std::move(opened), name, write, poll);
        if (const fs::file_status there = fs::symlink_status(target, error);
            fs::is_regular_file(there))
            fs::permissions(partial, there.permissions(), error);
        if (const int refused = system::replaceFile(partial, target)) fail(name, refused);
    } catch (...) {
        fs::remove(partial, error);
        throw;
    }
}

// Creates the folder of the file.
void makePlaceFor(const fs::path& path) {
    std::error_code error;
    const fs::file_type type = fs::status(path, error).type();
    if ((type == fs::file_type::fifo || type == fs::file_type::socket) && !system::openStream(path))
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
    return !system::openStream(path) &&
           (!fs::exists(path, error) || fs::is_regular_file(path, error));
}

void writeFileAtomically(const fs::path& path, const Writer& write, const WritePoll& poll) {
    makePlaceFor(path);
    if (const auto known = system::openStream(path))
        return writeFile(system::openAgain(*known), path, write, poll);
    std::error_code error;
    const bool there = fs::exists(path, error);
    if (error) fail(path, error.value());  // circular links, or a name that is too long
    if (there && !fs::is_regular_file(path, error))
        return writeFile(system::openToWrite(path), path, write, poll);
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
            if (now - entry.used > kStale && is_entry(name.stem().stem().string()))
                fs::remove(entry.path, gone);
        } else if (is_entry(name.string())) {
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

namespace {

fs::path ownFolder(system::UserFiles kind) {
    const fs::path folder = system::userFolder(kind);
    return folder.empty() ? folder : folder / "hairbench";
}

}  // namespace

fs::path userCacheFolder() { return ownFolder(system::UserFiles::cache); }

void checkWritable(const fs::path& path) {
    makePlaceFor(path);
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const fs::path probe = fs::exists(path, error) ? path : folder;
    if (const int refused = system::checkWriteAccess(probe)) fail(path, refused);
    // A name that is too long, by itself or with the longest suffix, or broken links.
    error.clear();
    if (!fs::status_known(fs::status(path, error))) fail(path, error.value());
    if (path.filename().string().size() > kLongestName - kLongestSuffix)
        fail(path, static_cast<int>(std::errc::filename_too_long));
}

// ---- The program's own files --------------------------------------------------------------------

namespace {

namespace fs = std::filesystem;

// Returns the parent of the program's folder, or that folder itself in an archive that is unpacked
// anywhere.
fs::path prefix() {
    std::error_code error;
    const fs::path folder = system::thisProgram().parent_path();
    return fs::is_directory(folder / "share/hairbench", error) ? folder : folder.parent_path();
}

}  // namespace

fs::path programFile(std::string_view name) {
    std::error_code error;
    const fs::path file = prefix() / "share/hairbench" / name;
    const fs::path place = fs::weakly_canonical(file, error);
    return error ? file : place;
}

fs::path helperProgram(std::string_view name) {
    return (prefix() / "libexec/hairbench" / name) += system::kProgramEnding;
}

fs::path pythonEnvironment(const std::string& name) {
    std::error_code error;
    const fs::path made = programFile(".deps") / name;
    const fs::path users = ownFolder(system::UserFiles::data);
    return users.empty() || fs::exists(made, error) ? made : users / name;
}

std::string pythonInterpreter(const std::string& name, const char* override) {
    const char* const wanted = std::getenv(override);
    return wanted && *wanted ? wanted : (pythonEnvironment(name) / system::kPythonProgram).string();
}

std::string makesPythonEnvironment(const std::string& name) {
    std::error_code error;
    const fs::path folder = prefix() / "libexec/hairbench";
    const fs::path requirements =
        folder / (name == "python" ? "requirements.txt" : "requirements-" + name + ".txt");
    if (!fs::exists(requirements, error)) return "scripts/setup --" + name;
    return system::pythonEnvironmentCommand(
        pythonEnvironment(name), requirements, folder / "python-environment");
}

}  // namespace engine
