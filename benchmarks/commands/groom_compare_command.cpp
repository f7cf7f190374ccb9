#include <cmath>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/compare.h"
#include "benchmarks/report/change.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/shown_text.h"
#include "hair/groom/files.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/style/style.h"

namespace benchmarks::commands {
namespace {

// Reads a file and converts its strands to metres, by `scale` or the unit that the file states or
// suggests.
groom::ComparedFile readCompared(
    const std::filesystem::path& path, std::optional<double> scale,
    std::uint32_t points_per_strand) {
    hair::groom::StrandSet strands = hair::groom::importStrands(path, points_per_strand);
    hair::groom::Unit unit{};
    if (scale) {
        unit = hair::groom::statedUnit(*scale);
        unit.reason = "An option states it.";
    } else {
        const auto findings = hair::groom::inspect(strands, nullptr, {});
        unit = {findings.unit, findings.metres_per_unit, findings.unit_reason};
        if (!findings.unit_stated && findings.metres_per_unit != 1.0)
            std::cerr << "hairbench: " << engine::shownText(path.string())
                      << ": states no unit; lengths are taken as " << findings.unit << '\n';
    }
    groom::ComparedFile file{
        .file = path, .format = hair::groom::strandImporterOf(path).name, .unit = unit};
    file.strands = unit.metres == 1.0 ? std::move(strands)
                                      : hair::groom::scaleLengths(std::move(strands), unit.metres);
    return file;
}

// "2/20": 2 mm, 20 degrees.
hair::groom::MatchThreshold parsedThreshold(const std::string& text) {
    try {
        std::size_t used = 0;
        const double distance = std::stod(text, &used);
        if (used < text.size() && text[used] == '/') {
            const std::string rest = text.substr(used + 1);
            const double angle = std::stod(rest, &used);
            if (used == rest.size()) return {distance / 1000.0, angle};
        }
    } catch (const std::exception&) {  // not a number: see below
    }
    throw engine::Error(
        "--threshold", "'" + text + "' is not MM/DEGREES, as in 2/20 for 2 mm and 20 degrees");
}

}  // namespace

int compareGrooms(const CompareGroomsOptions& options) {
    hair::groom::CompareSettings settings{
        .spacing = options.spacing / 1000.0,
        .curvature_step = options.curvature_step / 1000.0,
        .consistency_samples = options.consistency_samples,
        .directions = options.undirected ? hair::groom::StrandDirections::either_way
                                         : hair::groom::StrandDirections::from_root_to_tip,
        .threads = options.threads};
    if (!options.thresholds.empty()) settings.thresholds.clear();
    for (const std::string& text : options.thresholds)
        settings.thresholds.push_back(parsedThreshold(text));
    std::optional<hair::groom::BodyMesh> mesh;
    if (!options.mesh.empty()) mesh = hair::groom::bodyMesh(hair::groom::importMesh(options.mesh));
    const groom::ComparedFile first =
        readCompared(options.first, options.first_scale, options.first_points_per_strand);
    const groom::ComparedFile second =
        readCompared(options.second, options.second_scale, options.second_points_per_strand);
    if (!options.out.empty()) engine::checkWritable(options.out);

    const hair::groom::StrandComparison found = hair::groom::compareStrands(
        first.strands, second.strands, mesh ? &*mesh : nullptr, settings);
    const groom::GroomComparison comparison{first, second, settings, found};
    const std::string json = groom::groomComparisonJson(comparison);
    if (!options.out.empty())
        engine::writeFileAtomically(options.out, [&](std::ostream& file) { file << json; });
    std::cout << (options.json ? json : groom::groomComparisonText(comparison));
    return report::kOk;
}

}  // namespace benchmarks::commands
