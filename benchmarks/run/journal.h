#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// The system did not take what was to be written: a full disk, a limit. "<path>: cannot be written:
// <reason>"
class WriteFailed : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// A file of JSON values, one a line, that survives the end of its writer at any moment: a line is
// handed over in one piece and on the disk when append() returns, and one that was cut short is not
// there for who reads. No two processes have it at a time.
class Journal {
public:
    // Opens it, or makes it with its folder. Throws engine::Error "<path>: <reason>" where another
    // process has it or it can't be opened.
    explicit Journal(std::filesystem::path path);
    // An empty one is removed.
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    // Its whole lines, up to one that is no JSON, which only a torn disk leaves. Throws
    // engine::Error where the first is none: it is some other file.
    std::vector<Json> read();

    // Behind the lines that read() gave. Throws WriteFailed, and leaves those before as they were.
    void append(const Json& line);

    // Without lines, from here on.
    void clear();

    // The file, once nobody needs it.
    void remove();

private:
    std::filesystem::path path_;
    int file_;
    std::uintmax_t size_ = 0;  // B, of the whole lines
};

}  // namespace benchmarks
