#pragma once

#include <array>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "hair/groom/formats/usda_curves.h"
#include "hair/groom/strand_set.h"

namespace hair {

// Writes strands that move as time-sampled BasisCurves, a frame at a time: none is kept.
class UsdaAnimation {
public:
    // All but the points is of `strands`, in every frame. Throws as exportUsda does.
    UsdaAnimation(std::ostream& out, const StrandSet& strands, const UsdaTiming& timing);

    // The points of the next frame, as many as the strands have.
    void frame(std::span<const glm::vec3> points);
    // After the last one.
    void end();

    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    void beginSample(std::uint32_t frame);

    UsdaText text_;
    std::size_t point_count_;
    float greatest_width_;
    std::uint32_t frames_;
    std::vector<std::array<glm::vec3, 2>> extents_;  // [frame] so far
    std::vector<std::string> warnings_;
};

}  // namespace hair
