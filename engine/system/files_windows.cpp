#include "engine/system/files.h"

#include <algorithm>
#include <cerrno>
#include <codecvt>
#include <cstdio>
#include <cstdlib>
#include <locale>
#include <random>
#include <system_error>

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include "engine/error.h"

#ifdef __GLIBCXX__

// ---- Paths as UTF-8 -----------------------------------------------------------------------------

// libstdc++'s paths convert their texts by this facet, and the facet by the C library, whose
// locales on Windows lack UTF-8. These definitions take the place of the library's.
namespace std {
namespace {

const codecvt_utf8_utf16<wchar_t>& utf8() {
    static const codecvt_utf8_utf16<wchar_t> conversion;
    return conversion;
}

}  // namespace

using WidePaths = codecvt<wchar_t, char, mbstate_t>;

codecvt_base::result WidePaths::do_out(
    state_type& state, const wchar_t* from, const wchar_t* from_end, const wchar_t*& from_next,
    char* to, char* to_end, char*& to_next) const {
    return utf8().out(state, from, from_end, from_next, to, to_end, to_next);
}

codecvt_base::result WidePaths::do_in(
    state_type& state, const char* from, const char* from_end, const char*& from_next, wchar_t* to,
    wchar_t* to_end, wchar_t*& to_next) const {
    return utf8().in(state, from, from_end, from_next, to, to_end, to_next);
}

int WidePaths::do_encoding() const throw() { return utf8().encoding(); }
int WidePaths::do_max_length() const throw() { return utf8().max_length(); }
int WidePaths::do_length(state_type& state, const char* from, const char* end, size_t most) const {
    return utf8().length(state, from, end, most);
}

}  // namespace std

#endif

namespace engine::system {

namespace fs = std::filesystem;

// ---- Open files ---------------------------------------------------------------------------------

namespace {

// Returns the value of errno for the last error of Windows.
int lastError() {
    switch (GetLastError()) {
    case ERROR_SUCCESS:
        return 0;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
        return ENOENT;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
        return EEXIST;
    case ERROR_DIRECTORY:
        return ENOTDIR;
    case ERROR_FILENAME_EXCED_RANGE:
        return ENAMETOOLONG;
    case ERROR_FILE_TOO_LARGE:
        return EFBIG;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
        return EACCES;
    case ERROR_HANDLE_DISK_FULL:
    case ERROR_DISK_FULL:
        return ENOSPC;
    case ERROR_WRITE_PROTECT:
        return EROFS;
    default:
        return EIO;
    }
}

// Takes a handle as a file of the C library, which closes it.
Opened opened(HANDLE handle) {
    if (handle == INVALID_HANDLE_VALUE) return {File(), lastError()};
    const int descriptor =
        _open_osfhandle(reinterpret_cast<intptr_t>(handle), _O_BINARY | _O_NOINHERIT);
    if (descriptor >= 0) return {File(descriptor), 0};
    const int error = errno;
    CloseHandle(handle);
    return {File(), error};
}

constexpr std::size_t kPiece = std::size_t{1} << 30;  // the C library counts in 32 bits

std::string randomName() {
    std::random_device device;
    char name[32];
    std::snprintf(name, sizeof name, "hairbench-%08x%08x", device(), device());
    return name;
}

}  // namespace

int File::close() {
    const int descriptor = std::exchange(descriptor_, -1);
    return descriptor >= 0 && _close(descriptor) != 0 ? errno : 0;
}

int File::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const auto piece = static_cast<unsigned>(std::min(bytes.size(), kPiece));
        const int taken = _write(descriptor_, bytes.data(), piece);
        if (taken < 0) return errno;
        if (taken == 0) return ENOSPC;
        bytes.remove_prefix(static_cast<std::size_t>(taken));
    }
    return 0;
}

int File::writeAt(std::string_view bytes, std::uintmax_t offset) {
    if (_lseeki64(descriptor_, static_cast<__int64>(offset), SEEK_SET) < 0) return errno;
    return write(bytes);
}

std::size_t File::readAt(std::span<char> bytes, std::uintmax_t offset) const {
    if (_lseeki64(descriptor_, static_cast<__int64>(offset), SEEK_SET) < 0) return 0;
    std::size_t done = 0;
    while (done < bytes.size()) {
        const auto piece = static_cast<unsigned>(std::min(bytes.size() - done, kPiece));
        const int taken = _read(descriptor_, bytes.data() + done, piece);
        if (taken <= 0) break;
        done += static_cast<std::size_t>(taken);
    }
    return done;
}

std::uintmax_t File::size() const {
    const __int64 size = _filelengthi64(descriptor_);
    return size < 0 ? 0 : static_cast<std::uintmax_t>(size);
}

int File::cut(std::uintmax_t size) { return _chsize_s(descriptor_, static_cast<__int64>(size)); }

int File::sync() { return _commit(descriptor_) == 0 ? 0 : errno; }

Opened createFile(const fs::path& path) {
    // Without the last flag it would make what a link names.
    return opened(CreateFileW(
        path.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
        nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL | FILE_FLAG_OPEN_REPARSE_POINT, nullptr));
}

Opened openToWrite(const fs::path& path) {
    return opened(CreateFileW(
        path.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
        nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
}

std::optional<int> openStream(const fs::path& path) {
    if (path == "/dev/stdout") return 1;
    if (path == "/dev/stderr") return 2;
    return std::nullopt;
}

bool isWriteFailure(int error) { return error == ENOSPC || error == EFBIG || error == EIO; }

Opened openAgain(int stream) {
    const int descriptor = _dup(stream);
    return {File(descriptor), descriptor < 0 ? errno : 0};
}

Locked openLocked(const fs::path& path) {
    // Others may read the file, but not open it to write as well.
    const HANDLE handle = CreateFileW(
        path.c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ, nullptr, OPEN_ALWAYS,
        FILE_ATTRIBUTE_NORMAL | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        if (GetLastError() == ERROR_SHARING_VIOLATION) return {.lock = Lock::by_another};
        const int error = lastError();
        std::error_code ignored;
        if (fs::is_directory(path, ignored)) return {.lock = Lock::is_no_file};
        return {Lock::failed, {File(), error}};
    }
    Opened file = opened(handle);
    if (!file.file.isOpen()) return {Lock::failed, std::move(file)};
    if (GetFileType(handle) != FILE_TYPE_DISK) return {.lock = Lock::is_no_file};
    // Other reparse points are files, such as those that OneDrive keeps elsewhere.
    FILE_ATTRIBUTE_TAG_INFO information{};
    if (GetFileInformationByHandleEx(
            handle, FileAttributeTagInfo, &information, sizeof information) &&
        information.FileAttributes & FILE_ATTRIBUTE_REPARSE_POINT &&
        IsReparseTagNameSurrogate(information.ReparseTag))
        return {.lock = Lock::is_link};
    return {Lock::held, std::move(file)};
}

void removeOpen(File file, const fs::path& path) {
    file.close();
    DeleteFileW(path.c_str());
}

// ---- Folders and names --------------------------------------------------------------------------

int replaceFile(const fs::path& from, const fs::path& to) {
    // A scanner for viruses may have one of them open for a moment.
    constexpr int kTries = 20;
    constexpr DWORD kPause = 50;  // ms
    for (int i = 1;; ++i) {
        if (MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING)) return 0;
        const int error = lastError();
        if (error != EACCES || i == kTries) return error;
        Sleep(kPause);
    }
}

int checkWriteAccess(const fs::path& path) {
    std::error_code ignored;
    const bool is_folder = fs::is_directory(path, ignored);
    const HANDLE handle = CreateFileW(
        path.c_str(), is_folder ? DWORD{FILE_ADD_FILE} : DWORD{GENERIC_WRITE},
        FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, OPEN_EXISTING,
        is_folder ? FILE_FLAG_BACKUP_SEMANTICS : 0, nullptr);
    if (handle == INVALID_HANDLE_VALUE) return lastError();
    CloseHandle(handle);
    return 0;
}

void syncFolder(const fs::path&) {}  // NTFS keeps names in a journal of its own

fs::path makeTemporaryFolder() {
    const fs::path path = fs::temp_directory_path() / randomName();
    std::error_code error;
    if (!fs::create_directory(path, error)) throw Error(path.string(), "can't be made");
    return path;
}

SharedFile::SharedFile(std::string_view bytes) {
    const fs::path path = fs::temp_directory_path() / randomName();
    name_ = path.string();
    Opened opened = createFile(path);
    int error = opened.error;
    if (opened.file.isOpen()) error = opened.file.write(bytes);
    if (error == 0) return;
    opened.file.close();
    DeleteFileW(path.c_str());
    throw Error(name_, "cannot be written: " + std::generic_category().message(error));
}

SharedFile::~SharedFile() { DeleteFileW(fs::path(name_).c_str()); }

// ---- Places -------------------------------------------------------------------------------------

const std::string_view kProgramEnding = ".exe";

const std::string_view kPythonProgram = "Scripts/python.exe";

std::string pythonEnvironmentCommand(
    const fs::path& environment, const fs::path& requirements, const fs::path&) {
    const std::string folder = '"' + environment.string() + '"';
    return "py -m venv " + folder + " && " + '"' + (environment / "Scripts" / "pip.exe").string() +
           "\" install -r \"" + requirements.string() + '"';
}

fs::path thisProgram() {
    std::wstring path(1 << 15, L'\0');  // Windows' longest path
    const DWORD size = GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
    path.resize(size < path.size() ? size : 0);
    return path;
}

// Windows keeps the file of a running program from being replaced.
std::string thisProgramAsStarted() { return thisProgram().string(); }

fs::path userFolder(UserFiles kind) {
    struct Place {
        const wchar_t* variable;
        const wchar_t* windows;
    };
    constexpr Place kPlaces[] = {
        {L"XDG_CACHE_HOME", L"LOCALAPPDATA"},
        {L"XDG_CONFIG_HOME", L"APPDATA"},
        {L"XDG_DATA_HOME", L"LOCALAPPDATA"}};
    const auto [variable, windows] = kPlaces[static_cast<std::size_t>(kind)];
    for (const wchar_t* const name : {variable, windows})
        if (const wchar_t* const value = _wgetenv(name); value && fs::path(value).is_absolute())
            return value;
    return {};
}

fs::path pciDevices() { return {}; }

}  // namespace engine::system
