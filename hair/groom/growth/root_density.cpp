#include "hair/groom/growth/root_density.h"

#include <algorithm>

#include "engine/error.h"
#include "hair/groom/growth/root_samples.h"

namespace hair {

double textureAt(const Texture& texture, const Scalp& scalp, const SurfacePoint& point) {
    if (scalp.texture_coordinates.empty())
        throw engine::Error("the mesh has no texture coordinates for the picture");
    return texture(textureCoordinate(scalp, point));
}

RootDensity::RootDensity(
    const Scalp& scalp, const Texture* mask, std::uint32_t points, std::uint32_t seed)
    : scalp_(scalp), mask_(mask), area_(scalp.area()) {
    if (!mask) return;
    double sum = 0.0;
    double maximum = 0.0;
    std::uint32_t grey = 0;
    for (std::uint32_t i = 0; i < points; ++i) {
        const double value = textureAt(*mask, scalp, rootSample(scalp, seed, i));
        grey += value > 0.0 ? 1 : 0;
        sum += value;
        maximum = std::max(maximum, value);
    }
    if (grey == 0) throw engine::Error("the mask is black all over the scalp");
    maximum_ = maximum;
    area_ = scalp.area() * grey / points;
    mean_ = sum / grey / maximum;
}

double RootDensity::operator()(const SurfacePoint& point) const {
    return mask_ ? std::min(1.0, textureAt(*mask_, scalp_, point) / maximum_) : 1.0;
}

}  // namespace hair
