#include "hair/groom/formats/usda_animation.h"

#include <cassert>

namespace hair {

UsdaAnimation::UsdaAnimation(std::ostream& out, const StrandSet& strands, const UsdaTiming& timing)
    : text_(out), point_count_(strands.points.size()), greatest_width_(greatestWidth(strands)),
      frames_(timing.frames), warnings_(beginUsdaCurves(text_, strands, timing)) {
    text_.text("    point3f[] points.timeSamples = {\n");
}

void UsdaAnimation::beginSample(std::uint32_t frame) {
    text_.text("        ");
    text_.value(frame);
    text_.text(": ");
}

void UsdaAnimation::frame(std::span<const glm::vec3> points) {
    assert(points.size() == point_count_ && extents_.size() < frames_);
    beginSample(static_cast<std::uint32_t>(extents_.size()));
    text_.array(points);
    text_.text(",\n");
    extents_.push_back(usdExtent(points, greatest_width_));
}

void UsdaAnimation::end() {
    assert(extents_.size() == frames_);
    text_.text("    }\n    float3[] extent.timeSamples = {\n");
    for (std::uint32_t i = 0; i < extents_.size(); ++i) {
        beginSample(i);
        text_.array(std::span<const glm::vec3>(extents_[i]));
        text_.text(",\n");
    }
    text_.text("    }\n");
    endUsdaCurves(text_);
}

}  // namespace hair
