#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files.h"
#include "hair/groom/groom.h"
#include "hair/groom/named_files.h"

// Files of strands: the tables of formats, and whole files by their extension or first bytes.
namespace hair::groom {

// A writer of strands. `write` returns what the format can't hold of these strands, a sentence
// each; what it does hold reads back equal to the last bit. Throws engine::Error where the format
// can't hold them at all.
struct StrandExporter {
    std::string_view extension;  // lower case, with the dot
    std::vector<std::string> (*write)(const StrandSet& strands, std::ostream& out);
};

// A new format is a row here.
std::span<const StrandExporter> strandExporters();

// ".hair, .hgl, ...": what strands can be written as.
std::string writtenExtensions();

// The row of the path's extension. Throws engine::Error "path: reason" with the known ones if there
// is none.
const StrandExporter& strandExporterOf(const std::filesystem::path& path);

// Writes the format of the path's extension, whole or not at all. Returns what it can't hold.
// `poll` is called now and then and ends the writing by what it throws.
// Throws engine::Error "path: reason".
std::vector<std::string> exportStrands(
    const StrandSet& strands, const std::filesystem::path& path,
    const engine::WritePoll& poll = {});

// ".glb" for "head.GLB".
inline std::string lowerCaseExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return extension;
}

// A file in memory. `path` is where it came from, for formats that name other files and for those
// that another program reads; empty: from nowhere, then nothing else is opened.
struct StrandFile {
    std::span<const std::byte> bytes;
    std::filesystem::path path;
    // Of formats that can leave it out, such as a PLY of points alone; 0: not known.
    std::uint32_t points_per_strand = 0;
    NamedFileCheck check{};  // of those other files
};

// A reader of strands. Its errors begin with the place in the file, "byte N" or "line N", and don't
// name the file. It refuses what is not exactly the format, before it allocates by a count that the
// file's size does not bear out.
struct StrandImporter {
    std::string_view name;  // for messages
    std::span<const std::string_view> extensions;  // lower case, with the dot
    std::string_view magic;  // how every such file begins; empty: it can't be told
    StrandSet (*read)(const StrandFile& file);
    bool from_memory = true;  // reads `bytes`; false: another program reads the file at `path`
};

// A new format is a row here.
std::span<const StrandImporter> strandImporters();

// ".hair, .tfx, ...": what strands can be read from.
std::string readExtensions();

// The row that reads a file: that of its first bytes where they are a format's, otherwise that of
// its extension, in any case. Throws engine::Error "path: reason", which says of some files that
// are not read what they are and what to do.
const StrandImporter& strandImporterOf(const std::filesystem::path& path);

// `points_per_strand`: what the file may leave out, see StrandFile. A format that states it itself
// takes no notice. Throws engine::Error "path: place: reason", also for what `check` throws.
StrandSet importStrands(
    const std::filesystem::path& path, std::uint32_t points_per_strand = 0,
    const NamedFileCheck& check = {});

}  // namespace hair::groom
