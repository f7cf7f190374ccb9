#include <iostream>
#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/info.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "hair/groom/files.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/import_mesh.h"

namespace benchmarks::commands {

hair::groom::StrandSet chosenGroups(
    hair::groom::StrandSet strands, const std::vector<std::int32_t>& groups,
    const std::filesystem::path& file) {
    if (groups.empty()) return strands;
    try {
        return hair::groom::keepGroups(std::move(strands), groups);
    } catch (const engine::Error& error) {
        throw engine::Error(file.string() + ": --group", error.what());
    }
}

int printGroomFormats(const GroomFormatsOptions& options) {
    const std::string table = hair::groom::formatsMarkdown();
    if (options.markdown) {
        std::cout << table;
        return report::kOk;
    }
    // Columns of a table are cells between bars; those of the plain text are as wide as needed.
    std::vector<report::Column> columns;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("|---")) continue;
        std::size_t column = 0;
        for (std::size_t at = 1; at < line.size(); ++column) {
            const std::size_t end = line.find('|', at);
            std::string cell = line.substr(at, end - at);
            std::erase(cell, '`');
            cell.erase(0, std::min(cell.find_first_not_of(' '), cell.size()));
            cell.erase(cell.find_last_not_of(' ') + 1);
            if (columns.size() == column)
                columns.push_back({.title = cell, .numeric = false});
            else
                columns[column].cells.push_back(cell);
            at = end + 1;
        }
    }
    for (std::size_t row = 0; row <= columns.front().cells.size(); ++row)
        std::cout << report::columnsLine(columns, row);
    return report::kOk;
}

int inspectGroom(const GroomInfoOptions& options) {
    std::optional<hair::groom::Mesh> mesh;
    if (!options.mesh.empty()) mesh = hair::groom::importMesh(options.mesh);
    hair::groom::StrandSet strands = hair::groom::importStrands(
        options.file, options.points_per_strand, {}, hair::groom::badStrands(options.strict));
    strands = chosenGroups(std::move(strands), options.groups, options.file);
    hair::groom::StrandFindings findings =
        hair::groom::inspect(strands, mesh ? &*mesh : nullptr, options.scale);
    if (options.scale) {
        findings.unit = hair::groom::statedUnit(*options.scale).name;
        findings.unit_stated = true;
        findings.unit_reason = "--scale states it.";
        findings.metres_per_unit = *options.scale;
    }
    const groom::GroomInfo info{
        .file = options.file,
        .format = hair::groom::strandImporterOf(options.file).name,
        .strands = strands,
        .findings = findings,
        .oddities = groom::findOddities(strands, findings)};
    std::cout << (options.json ? groom::groomInfoJson(info) : groom::groomInfoText(info));
    return report::kOk;
}

}  // namespace benchmarks::commands
