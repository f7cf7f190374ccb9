#include "engine/system/files.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/error.h"

namespace engine::system {

namespace fs = std::filesystem;

// ---- Open files ---------------------------------------------------------------------------------

namespace {

Opened opened(int descriptor) { return {File(descriptor), descriptor < 0 ? errno : 0}; }

// Calls `some` with the rest of the bytes, until it has written all. Returns an error.
template <class Some>
int writeAll(std::string_view bytes, const Some& some) {
    while (!bytes.empty()) {
        const ssize_t taken = some(bytes);
        if (taken < 0 && errno == EINTR) continue;
        if (taken < 0) return errno;
        if (taken == 0) return ENOSPC;
        bytes.remove_prefix(static_cast<std::size_t>(taken));
    }
    return 0;
}

}  // namespace

int File::close() {
    const int descriptor = std::exchange(descriptor_, -1);
    return descriptor >= 0 && ::close(descriptor) != 0 ? errno : 0;
}

int File::write(std::string_view bytes) {
    return writeAll(bytes, [&](std::string_view rest) {
        return ::write(descriptor_, rest.data(), rest.size());
    });
}

int File::writeAt(std::string_view bytes, std::uintmax_t offset) {
    const std::uintmax_t end = offset + bytes.size();
    return writeAll(bytes, [&](std::string_view rest) {
        return pwrite(descriptor_, rest.data(), rest.size(), static_cast<off_t>(end - rest.size()));
    });
}

std::size_t File::readAt(std::span<char> bytes, std::uintmax_t offset) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t taken = pread(
            descriptor_, bytes.data() + done, bytes.size() - done,
            static_cast<off_t>(offset + done));
        if (taken < 0 && errno == EINTR) continue;
        if (taken <= 0) break;
        done += static_cast<std::size_t>(taken);
    }
    return done;
}

std::uintmax_t File::size() const {
    struct stat status{};
    return fstat(descriptor_, &status) == 0 ? static_cast<std::uintmax_t>(status.st_size) : 0;
}

int File::cut(std::uintmax_t size) {
    return ftruncate(descriptor_, static_cast<off_t>(size)) == 0 ? 0 : errno;
}

int File::sync() { return fsync(descriptor_) == 0 ? 0 : errno; }

Opened createFile(const fs::path& path) {
    return opened(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
}

Opened openToWrite(const fs::path& path) {
    return opened(open(path.c_str(), O_WRONLY | O_CLOEXEC));
}

std::optional<int> openStream(const fs::path& wanted) {
    constexpr int kMostLinks = 40;  // Linux follows as many
    fs::path path = wanted;
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

bool isWriteFailure(int error) {
    return error == ENOSPC || error == EDQUOT || error == EFBIG || error == EIO;
}

Opened openAgain(int stream) { return opened(fcntl(stream, F_DUPFD_CLOEXEC, 0)); }

Locked openLocked(const fs::path& path) {
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    Opened file = opened(descriptor);
    if (!file.file.isOpen())
        return {file.error == ELOOP ? Lock::is_link : Lock::failed, std::move(file)};
    struct stat status{};
    if (fstat(descriptor, &status) == 0 && !S_ISREG(status.st_mode))
        return {.lock = Lock::is_no_file};
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return {.lock = Lock::by_another};
    return {Lock::held, std::move(file)};
}

void removeOpen(File file, const fs::path& path) {
    unlink(path.c_str());  // while it is locked: no other process can have opened it
    file.close();
}

// ---- Folders and names --------------------------------------------------------------------------

int replaceFile(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    return error.value();
}

int checkWriteAccess(const fs::path& path) { return access(path.c_str(), W_OK) == 0 ? 0 : errno; }

void syncFolder(const fs::path& folder) {
    File file(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (file.isOpen()) file.sync();  // the folder may be writable but not readable
}

fs::path makeTemporaryFolder() {
    std::string path = (fs::temp_directory_path() / "hairbench-XXXXXX").string();
    if (!mkdtemp(path.data())) throw Error(path, "can't be made");
    return path;
}

namespace {

// Returns a file in memory, which children inherit.
int memoryFile() {
    const int descriptor = memfd_create("hairbench", 0);
    if (descriptor < 0) throw Error("the system has no file in memory for another program");
    return descriptor;
}

}  // namespace

SharedFile::SharedFile(std::string_view bytes) {
    const int descriptor = memoryFile();
    file_ = File(descriptor);
    name_ = "/proc/self/fd/" + std::to_string(descriptor);
    if (const int error = file_.write(bytes))
        throw Error(name_, "cannot be written: " + std::generic_category().message(error));
}

SharedFile::~SharedFile() = default;

// ---- Places -------------------------------------------------------------------------------------

const std::string_view kProgramEnding;

const std::string_view kPythonProgram = "bin/python";

std::string
pythonEnvironmentCommand(const fs::path& environment, const fs::path&, const fs::path& maker) {
    return maker.string() + ' ' + environment.filename().string();
}

fs::path thisProgram() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error);
}

std::string thisProgramAsStarted() { return "/proc/self/exe"; }

fs::path userFolder(UserFiles kind) {
    struct Place {
        const char* variable;
        const char* below_home;
    };
    constexpr std::array<Place, 3> kPlaces{
        Place{"XDG_CACHE_HOME", ".cache"}, Place{"XDG_CONFIG_HOME", ".config"},
        Place{"XDG_DATA_HOME", ".local/share"}};
    const auto [variable, below_home] = kPlaces[static_cast<std::size_t>(kind)];
    // The specification says to ignore relative paths.
    const auto folder_in = [](const char* name) {
        const char* const value = std::getenv(name);
        return value && *value == '/' ? fs::path(value) : fs::path();
    };
    const fs::path folder = folder_in(variable), home = folder_in("HOME");
    return !folder.empty() || home.empty() ? folder : home / below_home;
}

fs::path pciDevices() { return "/sys/bus/pci/devices"; }

}  // namespace engine::system
