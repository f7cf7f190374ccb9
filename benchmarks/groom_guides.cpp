#include "benchmarks/groom_guides.h"

#include "benchmarks/quantity_text.h"
#include "benchmarks/table.h"
#include "engine/error.h"
#include "hair/groom/guides/bind_strands.h"
#include "hair/groom/guides/choose_guides.h"
#include "hair/groom/guides/root_triangles.h"
#include "hair/groom/resample.h"
#include "hair/groom/style/strand_edits.h"

namespace benchmarks {
namespace {

// In metres where the unit is known, or else in the file's.
std::string
errorText(const hair::ReconstructionError& error, std::optional<double> metres_per_unit) {
    const auto length = [&](double value) {
        return metres_per_unit ? lengthText(value * *metres_per_unit)
                               : shortNumber(value) + " units";
    };
    return length(error.mean) + " in the mean (" + shortNumber(100.0 * error.relative) +
           " % of the mean length), " + length(error.rms) + " rms, " + length(error.percentile95) +
           " for 95 % of the strands, " + length(error.maximum) + " at most";
}

}  // namespace

GuideChoice chooseGuides(const hair::StrandSet& strands, std::uint32_t count, std::uint32_t seed) {
    if (count > strands.strandCount())
        throw engine::Error(
            "--guides", std::to_string(count) + " are more than the " +
                            std::to_string(strands.strandCount()) + " strands there are");
    const hair::Groom dense = hair::toGroom(strands, 0);
    const std::vector<std::uint32_t> chosen = hair::chooseGuides(dense, count, seed);
    const hair::Groom guides = hair::pickStrands(dense, chosen);
    const hair::ReconstructionError error =
        hair::reconstructionError(dense, guides, hair::bindStrands(dense, chosen));
    return {
        .guides = hair::pickStrands(strands, chosen),
        .error = errorText(error, strands.metres_per_unit)};
}

std::vector<std::array<std::uint32_t, 3>>
rootTriangles(const hair::StrandSet& strands, const hair::Mesh* mesh) {
    return hair::triangulateRoots(hair::toGroom(strands, 0), mesh);
}

}  // namespace benchmarks
