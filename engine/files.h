#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "engine/error.h"

// Reads files whole, and writes them so that nobody sees half of one.

namespace engine {

// A file of any size, open for reading. Throws an Error that names the file.
class OpenFile {
public:
    explicit OpenFile(const std::filesystem::path& path);

    std::uintmax_t size() const { return size_; }

    // Reads the first bytes of the file, as many as `bytes` has room for.
    void read(std::span<char> bytes);

private:
    std::string name_;
    std::ifstream file_;
    std::uintmax_t size_ = 0;
};

// Maximum file size, in bytes. Image decoders count in 32-bit signed integers.
inline constexpr std::size_t kLargestFile = 0x7fffffff;

// Returns the bytes of a file of at most `largest` bytes, or of standard input up to its end.
// Throws an Error that names the file. A pipe or a device is an error too: it could have no end or
// no writer.
std::string readFile(const std::filesystem::path& path, std::size_t largest = kLargestFile);

// The system refused data to be written: a full disk, a limit, a broken device. "<path>: cannot be
// written: <reason>"
class WriteFailed : public Error {
public:
    using Error::Error;
};

// Called repeatedly while a file is written, at least once per megabyte. An exception from it ends
// the writing.
using WritePoll = std::function<void()>;

// Writes a file as "<path>.<random>.partial" in the same folder and renames it, so that nobody sees
// half of it. Creates missing folders, follows a link at `path`, and keeps the permissions of an
// existing file. A path that is not replaceable (isReplaceable()) is written directly. Throws Error
// "<path>: <reason>", WriteFailed if the system took only a part, or the exception of the writer or
// of `poll`. Then it leaves nothing behind and the old file unchanged.
void writeFileAtomically(const std::filesystem::path& path, std::string_view text);
void writeFileAtomically(
    const std::filesystem::path& path, const std::function<void(std::ostream&)>& write,
    const WritePoll& poll = {});

// Writes a file of a cache in the same way, but replaces whatever the path is, even a link or a
// pipe.
void replaceFile(
    const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

// Removes the least recently used entries of a cache's folder until they take at most `most_bytes`
// together, and parts of entries whose writers died an hour ago or earlier. `is_entry` tells an
// entry by its file name.
void trimCache(
    const std::filesystem::path& folder, std::uintmax_t most_bytes,
    const std::function<bool(std::string_view name)>& is_entry);

// Whether the path is a regular file or does not exist, so that a file can be put in its place and
// others beside it. False for the program's open files (/dev/stdout, the shell's >(command)), pipes
// and devices.
bool isReplaceable(const std::filesystem::path& path);

// Returns $XDG_CACHE_HOME/hairbench or ~/.cache/hairbench, for data that can be regenerated; empty
// if there is no home folder. The folder need not exist.
std::filesystem::path userCacheFolder();

// Throws the Error that writing the file would throw, before the work that produces its contents.
// Creates a missing folder. A folder that can't be written and a name that is too long are errors.
void checkWritable(const std::filesystem::path& path);

// Places of the program's own files, relative to the program itself. So an installed tree can be
// moved, and no program depends on the machine that built it:
//
//   installed                          in a build tree
//   <prefix>/bin/hairbench             <build>/benchmarks/hairbench, <build>/tests/test_*
//   <prefix>/share/hairbench/          <build>/share/hairbench, a link to the source tree
//   <prefix>/libexec/hairbench/        <build>/libexec/hairbench/

// Returns a file or folder that comes with the program, by its name in the source tree: "scenes",
// "benchmarks/report/page/page.css". Follows links. It need not exist.
std::filesystem::path programFile(std::string_view name);

// Returns a helper program that this program runs. It need not exist.
std::filesystem::path helperProgram(std::string_view name);

// Returns the folder of one of the project's Python environments, "python" or "reference": in .deps
// of the source tree, or else in the user's data folder ($XDG_DATA_HOME/hairbench or
// ~/.local/share/hairbench). It need not exist.
std::filesystem::path pythonEnvironment(const std::string& name);

// Returns its interpreter, or the interpreter named by the environment variable `override`.
std::string pythonInterpreter(const std::string& name, const char* override);

// Returns the command that makes it: "scripts/setup --python", or an installed script.
std::string makesPythonEnvironment(const std::string& name);

}  // namespace engine
