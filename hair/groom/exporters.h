#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/write_file.h"
#include "hair/groom/strand_set.h"

namespace hair {

// A writer of strands. `write` returns what the format can't hold of these strands, a sentence
// each; what it does hold reads back equal to the last bit. Throws engine::Error where the format
// can't hold them at all.
struct StrandExporter {
    std::string_view extension;  // lower case, with the dot
    std::vector<std::string> (*write)(const StrandSet& strands, std::ostream& out);
};

// A new format is a row here.
std::span<const StrandExporter> strandExporters();

// The row of the path's extension. Throws engine::Error "path: reason" with the known ones if there
// is none.
const StrandExporter& strandExporterOf(const std::filesystem::path& path);

// Writes the format of the path's extension, whole or not at all. Returns what it can't hold.
// `poll` is called now and then and ends the writing by what it throws.
// Throws engine::Error "path: reason".
std::vector<std::string> exportStrands(
    const StrandSet& strands, const std::filesystem::path& path,
    const engine::WritePoll& poll = {});

}  // namespace hair
