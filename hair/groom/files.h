#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files.h"
#include "hair/groom/groom.h"
#include "hair/groom/named_files.h"
#include "hair/groom/strand_format.h"

// Files of strands: the tables of formats, and reading and writing by extension or first bytes.
namespace hair::groom {

// A new format is a row in these tables.
std::span<const StrandExporter> strandExporters();

// Returns the extensions of formats that can be written: ".hair, .hgl, ...".
std::string writtenExtensions();

// Returns the exporter for the path's extension. Throws engine::Error "path: reason" with the known
// extensions if there is none.
const StrandExporter& strandExporterOf(const std::filesystem::path& path);

// Writes the strands in the format of the path's extension, completely or not at all. Returns the
// sentences of StrandExporter::write. `poll` is called now and then; an exception of it ends the
// writing. `extras` are for formats with a StrandExporter::write_with. Throws engine::Error
// "path: reason".
std::vector<std::string> exportStrands(
    const StrandSet& strands, const std::filesystem::path& path, const engine::WritePoll& poll = {},
    const ExportExtras& extras = {});

// ".glb" for "head.GLB".
inline std::string lowerCaseExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return extension;
}

std::span<const StrandImporter> strandImporters();

// Returns the extensions of formats that can be read: ".hair, .tfx, ...".
std::string readExtensions();

// The kinds of data of every format in the tables. A new format is a row here too; a test holds the
// facts.
std::span<const FormatFacts> formatFacts();

// Returns the facts as rows of cells, the first with the titles. Extensions stand in backquotes.
std::vector<std::vector<std::string>> formatsTable();
// Returns this table as it stands in docs/grooms.md.
std::string formatsMarkdown();

// Returns the importer of a file: by its first bytes if they are a format's magic, otherwise by its
// extension, in upper or lower case. Formats that share an extension are told apart by looks_like.
// Throws engine::Error "path: reason". For some formats that are not read, the reason names the
// format and says what to do.
const StrandImporter& strandImporterOf(const std::filesystem::path& path);

// `points_per_strand`: see StrandFile. Formats that state it themselves ignore it. Strands that
// can't be used are treated as usableStrands() says; if they are `kept`, the set is as the reader
// returns it. Throws engine::Error "path: place: reason", also for errors that `check` throws.
StrandSet importStrands(
    const std::filesystem::path& path, std::uint32_t points_per_strand = 0,
    const NamedFileCheck& check = {}, BadStrands bad = BadStrands::left_out);

// Reads the strands at all samples over time. Throws engine::Error "path: reason" like
// importStrands(), and for a format that has no samples.
StrandSamples
importStrandSamples(const std::filesystem::path& path, const NamedFileCheck& check = {});

}  // namespace hair::groom
