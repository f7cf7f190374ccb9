#include "hair/rendering/root_pattern.h"

#include <cmath>

namespace hair {
namespace {

// Thesis program 2.3: fract(sin(dot(co, (12.9898, 78.233))) * 43758.5453).
float thesisRandom(double x, double y) {
    const double wide = std::sin(12.9898 * x + 78.233 * y) * 43758.5453;
    const double fraction = wide - std::floor(wide);
    return static_cast<float>(std::floor(fraction * 0x1p24)) * 0x1p-24f;
}

}  // namespace

// Thesis program 2.4; there the strand is gl_TessCoord.y.
std::vector<glm::vec2> thesisRootPattern(std::uint32_t density) {
    std::vector<glm::vec2> pairs;
    pairs.reserve(density);
    for (std::uint32_t strand = 0; strand < density; ++strand) {
        const double isoline = static_cast<double>(strand) / density;
        pairs.emplace_back(thesisRandom(isoline, 0.6), thesisRandom(isoline, -0.4));
    }
    return pairs;
}

}  // namespace hair
