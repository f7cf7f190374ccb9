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

// Files of strands: the tables of formats, and reading and writing by extension or first bytes.
namespace hair::groom {

// A writer of strands. `write` returns a sentence for each kind of data that the format can't hold
// of these strands; everything else reads back equal to the last bit. Throws engine::Error where
// the format can't hold the strands at all.
struct StrandExporter {
    std::string_view extension;  // lower case, with the dot
    std::vector<std::string> (*write)(const StrandSet& strands, std::ostream& out);
};

// A new format is a row here.
std::span<const StrandExporter> strandExporters();

// Returns the extensions of formats that can be written: ".hair, .hgl, ...".
std::string writtenExtensions();

// Returns the exporter for the path's extension. Throws engine::Error "path: reason" with the known
// extensions if there is none.
const StrandExporter& strandExporterOf(const std::filesystem::path& path);

// Writes the strands in the format of the path's extension, completely or not at all. Returns the
// sentences of StrandExporter::write. `poll` is called now and then; an exception of it ends the
// writing. Throws engine::Error "path: reason".
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

// A file in memory. `path` is its origin, for formats that name other files or that another program
// reads. If it is empty, no other file is opened.
struct StrandFile {
    std::span<const std::byte> bytes;
    std::filesystem::path path;
    // For formats that can leave it out, such as a PLY of points alone; 0: not known.
    std::uint32_t points_per_strand = 0;
    NamedFileCheck check{};  // for those other files
};

// A reader of strands. Its errors begin with the place in the file, "byte N" or "line N", and don't
// name the file. It refuses files that are not exactly of the format, and checks counts against the
// file's size before it allocates by them.
struct StrandImporter {
    std::string_view name;  // for messages
    std::span<const std::string_view> extensions;  // lower case, with the dot
    std::string_view magic;  // first bytes of all such files; empty: there are none
    StrandSet (*read)(const StrandFile& file);
    bool from_memory = true;  // reads `bytes`; false: another program reads the file at `path`
};

// A new format is a row here.
std::span<const StrandImporter> strandImporters();

// Returns the extensions of formats that can be read: ".hair, .tfx, ...".
std::string readExtensions();

// Returns the importer of a file: by its first bytes where they are a format's magic, otherwise by
// its extension, in upper or lower case. Throws engine::Error "path: reason". For some formats that
// are not read, the reason names the format and says what to do.
const StrandImporter& strandImporterOf(const std::filesystem::path& path);

// `points_per_strand`: see StrandFile. Formats that state it themselves ignore it. Throws
// engine::Error "path: place: reason", also for errors that `check` throws.
StrandSet importStrands(
    const std::filesystem::path& path, std::uint32_t points_per_strand = 0,
    const NamedFileCheck& check = {});

}  // namespace hair::groom
