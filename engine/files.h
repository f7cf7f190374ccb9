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

// Whole files: read at once, and written so that nobody sees half of one.
namespace engine {

// A file that is open for reading, of any size. Throws Error that names it.
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

// What decoders of pictures can count.
inline constexpr std::size_t kLargestFile = 0x7fffffff;

// The bytes of a file of at most so many, or of standard input up to its end. Throws Error that
// names it: for a pipe or a device, too, which could be without an end, or with nobody to write it.
std::string readFile(const std::filesystem::path& path, std::size_t largest = kLargestFile);

// The system did not take what was to be written: a full disk, a limit, a broken device. "<path>:
// cannot be written: <reason>"
class WriteFailed : public Error {
public:
    using Error::Error;
};

// Called again and again while a file is written, at least once in a megabyte; what it throws ends
// the writing.
using WritePoll = std::function<void()>;

// Writes a file beside its place, as "<path>.partial", and renames it there, so that nobody sees
// half of it; creates missing folders; follows a link; keeps the permissions of the file that was
// there. What is no regular file (/dev/stdout, a pipe) is written as it is. Throws Error "<path>:
// <reason>", WriteFailed where the system took a part only, or what the writer or `poll` throws,
// and leaves nothing behind, the old file as it was.
void writeFileAtomically(const std::filesystem::path& path, std::string_view text);
void writeFileAtomically(
    const std::filesystem::path& path, const std::function<void(std::ostream&)>& write,
    const WritePoll& poll = {});

// $XDG_CACHE_HOME/hairbench or ~/.cache/hairbench, for what can be made again; empty where there is
// no home. It need not be there.
std::filesystem::path userCacheFolder();

// Throws the Error that writing the file would, before the work whose result it is to hold: a
// missing folder is made, one that can't be written is an error, as a name is that is too long.
void checkWritable(const std::filesystem::path& path);

}  // namespace engine
