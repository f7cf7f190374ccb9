#include <iostream>
#include <optional>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/groom_info.h"
#include "hair/groom/importers.h"
#include "hair/groom/inspect/guess_unit.h"
#include "hair/groom/mesh/import_mesh.h"

namespace benchmarks {

int inspectGroom(const GroomInfoOptions& options) {
    std::optional<hair::Mesh> mesh;
    if (!options.mesh.empty()) mesh = hair::importMesh(options.mesh);
    const hair::StrandSet strands = hair::importStrands(options.file);
    hair::StrandFindings findings = hair::inspect(strands, mesh ? &*mesh : nullptr, options.scale);
    if (options.scale) {
        findings.unit = hair::statedUnit(*options.scale).name;
        findings.unit_stated = true;
        findings.unit_reason = "--scale states it.";
        findings.metres_per_unit = *options.scale;
    }
    const GroomInfo info{
        .file = options.file,
        .format = hair::strandImporterOf(options.file).name,
        .strands = strands,
        .findings = findings,
        .oddities = findOddities(strands, findings)};
    std::cout << (options.json ? groomInfoJson(info) : groomInfoText(info));
    return kOk;
}

}  // namespace benchmarks
