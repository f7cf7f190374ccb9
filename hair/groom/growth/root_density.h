#pragma once

#include <cstdint>

#include "hair/groom/growth/scalp.h"
#include "hair/groom/growth/texture.h"

namespace hair {

// How likely a root is at each point of a scalp: the mask, as parts of its maximum there, since the
// number of roots is given. Without a mask it is 1.
class RootDensity {
public:
    // Borrows both; `mask` may be null. The maximum and the means are those of so many random
    // points. Throws engine::Error for a mask without texture coordinates, or black all over.
    RootDensity(const Scalp& scalp, const Texture* mask, std::uint32_t points, std::uint32_t seed);

    double operator()(const SurfacePoint& point) const;  // 0 to 1
    double area() const { return area_; }  // m^2, of what isn't black
    double mean() const { return mean_; }  // over that area

private:
    const Scalp& scalp_;
    const Texture* mask_;
    double maximum_ = 1.0;
    double area_;
    double mean_ = 1.0;
};

// The texture's value at a point. Throws engine::Error if the scalp has no texture coordinates.
double textureAt(const Texture& texture, const Scalp& scalp, const SurfacePoint& point);

}  // namespace hair
