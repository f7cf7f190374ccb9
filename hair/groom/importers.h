#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "hair/groom/strand_set.h"

namespace hair {

// A file in memory. `path` is where it came from, for formats that name other files and for those
// that another program reads; empty: from nowhere, then nothing else is opened.
struct StrandFile {
    std::span<const std::byte> bytes;
    std::filesystem::path path;
};

// A reader of strands. Its errors begin with the place in the file, "byte N" or "line N", and don't
// name the file. It refuses what is not exactly the format, before it allocates by a count that the
// file's size does not bear out.
struct StrandImporter {
    std::string_view name;  // for messages
    std::span<const std::string_view> extensions;  // lower case, with the dot
    std::string_view magic;  // how every such file begins; empty: it can't be told
    StrandSet (*read)(const StrandFile& file);
};

// A new format is a row here.
std::span<const StrandImporter> strandImporters();

// The row that reads a file: that of its first bytes where they are a format's, otherwise that of
// its extension, in any case. Throws engine::Error "path: reason".
const StrandImporter& strandImporterOf(const std::filesystem::path& path);

// Throws engine::Error "path: place: reason".
StrandSet importStrands(const std::filesystem::path& path);

}  // namespace hair
