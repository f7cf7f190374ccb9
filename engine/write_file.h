#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace engine {

// Called again and again while a file is written, at least once in a megabyte; what it throws ends
// the writing.
using WritePoll = std::function<void()>;

// Writes a file beside its place, as "<path>.partial", and renames it there, so that nobody sees
// half of it; creates missing folders; follows a link; keeps the permissions of the file that was
// there. What is no regular file (/dev/stdout, a pipe) is written as it is. Throws engine::Error
// "<path>: <reason>", or what the writer or `poll` throws, and leaves nothing behind, the old file
// as it was.
void writeFileAtomically(const std::filesystem::path& path, std::string_view text);
void writeFileAtomically(
    const std::filesystem::path& path, const std::function<void(std::ostream&)>& write,
    const WritePoll& poll = {});

// Throws the Error that writing the file would, before the work whose result it is to hold: a
// missing folder is made, one that can't be written is an error.
void checkWritable(const std::filesystem::path& path);

}  // namespace engine
