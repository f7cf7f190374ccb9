#include <iostream>
#include <optional>
#include <utility>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/info.h"
#include "benchmarks/report/change.h"
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
