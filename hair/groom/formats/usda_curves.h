#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hair/groom/formats/usda_text.h"
#include "hair/groom/strand_set.h"

namespace hair {

// When the frames of an animation are: frame i at time code i.
struct UsdaTiming {
    std::uint32_t frames = 1;
    double frame_time = 1.0 / 60.0;  // s
};

// Writes the file up to the points of its one prim, with all else that the strands have. Returns
// what is not written equal to the last bit. Throws engine::Error for more than USD counts.
std::vector<std::string>
beginUsdaCurves(UsdaText& text, const StrandSet& strands, const std::optional<UsdaTiming>& timing);
void endUsdaCurves(UsdaText& text);

// The lowest and the highest corner of what the curves cover, as UsdGeomCurves computes it.
std::array<glm::vec3, 2> usdExtent(std::span<const glm::vec3> points, float greatest_width);

float greatestWidth(const StrandSet& strands);

}  // namespace hair
