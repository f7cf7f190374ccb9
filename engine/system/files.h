#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

// Files as the system has them: what the standard library lacks. Errors are values of errno; 0:
// none. engine/files.h has the rules by which the program reads and writes.
namespace engine::system {

// ---- Open files ---------------------------------------------------------------------------------

// An open file; other programs that this process starts do not inherit it.
class File {
public:
    explicit File(int descriptor = -1) : descriptor_(descriptor) {}
    File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    File& operator=(File&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~File() { close(); }

    bool isOpen() const { return descriptor_ >= 0; }
    int close();  // returns an error

    // Writes all bytes, after those that were written before, or at an offset. Returns an error.
    int write(std::string_view bytes);
    int writeAt(std::string_view bytes, std::uintmax_t offset);

    // Reads up to the end of the file or of `bytes`. Returns the number of bytes read.
    std::size_t readAt(std::span<char> bytes, std::uintmax_t offset) const;

    std::uintmax_t size() const;

    // Cuts the file to this size. Returns an error.
    int cut(std::uintmax_t size);

    // Returns once everything written is on disk, with an error.
    int sync();

private:
    int descriptor_;
};

struct Opened {
    File file{};
    int error = 0;
};

// Creates a file to write. Fails if the path exists, even as a link.
Opened createFile(const std::filesystem::path& path);

// Opens an existing path to write, such as a device.
Opened openToWrite(const std::filesystem::path& path);

// Returns the number of an open stream of the program if the path names one, such as /dev/stdout
// or the shell's >(command), or is a link to one.
std::optional<int> openStream(const std::filesystem::path& path);

// Whether the system took no more data: a full disk, a quota, a broken device.
bool isWriteFailure(int error);

// Opens a stream of the program a second time.
Opened openAgain(int stream);

// Opens or creates a file to read and write, which no other process can open in this way until it
// is closed. Some file systems have no locks; there it is not locked.
enum class Lock { held, by_another, is_link, is_no_file, failed };
struct Locked {
    Lock lock = Lock::failed;
    Opened opened{};
};
Locked openLocked(const std::filesystem::path& path);

// Closes the file and removes it.
void removeOpen(File file, const std::filesystem::path& path);

// ---- Folders and names --------------------------------------------------------------------------

// Renames a file. It replaces another one in one step, even if that is open. Windows refuses that,
// so there it waits for a second until the file is closed, and then returns an error.
int replaceFile(const std::filesystem::path& from, const std::filesystem::path& to);

// Returns an error if this user can't write the file or, in the folder, new files.
int checkWriteAccess(const std::filesystem::path& path);

// Makes the names in a folder last, as sync() does for a file's content.
void syncFolder(const std::filesystem::path& folder);

// Makes a new folder for temporary files, which only this user can read. Throws Error.
std::filesystem::path makeTemporaryFolder();

// A file that programs started from here can read by its name while this object lives. Throws Error
// if it can't be made.
class SharedFile {
public:
    explicit SharedFile(std::string_view bytes);
    ~SharedFile();
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    const std::string& name() const { return name_; }

private:
    File file_;
    std::string name_;
};

// ---- Places -------------------------------------------------------------------------------------

// Ending of the names of programs: ".exe" on Windows.
extern const std::string_view kProgramEnding;

// The interpreter in a Python environment.
extern const std::string_view kPythonProgram;

// Returns a command that makes a Python environment: `maker`, a script, with the environment's
// name, or on Windows, which does not run the script, what it does.
std::string pythonEnvironmentCommand(
    const std::filesystem::path& environment, const std::filesystem::path& requirements,
    const std::filesystem::path& maker);

// Returns the path of this program, or nothing if the system does not tell.
std::filesystem::path thisProgram();

// A name by which this program can be read and run, even if its file was replaced since its start.
std::string thisProgramAsStarted();

// Returns the folder of the user's files of a kind, where each program has a folder of its own. On
// Linux, by the XDG Base Directory Specification: $XDG_CACHE_HOME or ~/.cache, and so on. On
// Windows without these variables: %LOCALAPPDATA%. Empty if there is no home.
enum class UserFiles { cache, settings, data };
std::filesystem::path userFolder(UserFiles kind);

// Folder of Linux's files on the devices of the PCI bus; empty on other systems.
std::filesystem::path pciDevices();

}  // namespace engine::system
