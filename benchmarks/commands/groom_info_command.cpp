#include <iostream>
#include <optional>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/info.h"
#include "benchmarks/report/change.h"
#include "hair/groom/files.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/import_mesh.h"

namespace benchmarks::commands {

int inspectGroom(const GroomInfoOptions& options) {
    std::optional<hair::groom::Mesh> mesh;
    if (!options.mesh.empty()) mesh = hair::groom::importMesh(options.mesh);
    const hair::groom::StrandSet strands =
        hair::groom::importStrands(options.file, options.points_per_strand);
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
