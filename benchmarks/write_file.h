#pragma once

#include <filesystem>
#include <string_view>

namespace benchmarks {

// Writes a file beside its place and renames it there, so that nobody sees half of it; creates
// missing folders. What is no regular file (/dev/stdout, a pipe) is written as it is. Throws
// engine::Error "<path>: <reason>" and leaves nothing behind.
void writeFileAtomically(const std::filesystem::path& path, std::string_view text);

// Throws the Error that writing the file would, before the work whose result it is to hold: a
// missing folder is made, one that can't be written is an error.
void checkWritable(const std::filesystem::path& path);

}  // namespace benchmarks
