#include "hair/groom/formats/export_usda.h"

#include "hair/groom/formats/usda_curves.h"

namespace hair {

std::vector<std::string> exportUsda(const StrandSet& strands, std::ostream& out) {
    UsdaText text(out);
    std::vector<std::string> warnings = beginUsdaCurves(text, strands, {});
    text.text("    point3f[] points = ");
    text.array(std::span<const glm::vec3>(strands.points));
    text.text("\n    float3[] extent = ");
    const auto extent = usdExtent(strands.points, greatestWidth(strands));
    text.array(std::span<const glm::vec3>(extent));
    text.text("\n");
    endUsdaCurves(text);
    return warnings;
}

}  // namespace hair
