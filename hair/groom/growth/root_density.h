#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/vec2.hpp>

#include "hair/groom/growth/scalp.h"

// How densely roots lie: pictures over a scalp, and the density that a mask gives.
namespace hair::groom {

// A grey picture over texture coordinates: (0, 0) is its upper left corner, (1, 1) the lower right.
class Texture {
public:
    Texture(std::uint32_t width, std::uint32_t height, std::vector<float> brightness);

    // The brightness between the four nearest pixels' centres; coordinates beyond the edge count as
    // on it.
    double operator()(const glm::dvec2& coordinate) const;

private:
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<float> brightness_;  // [row][column], 0 to 1
};

// The brightness of the values that the file stores, red, green and blue as in Rec. 709's luma.
// Throws engine::Error that names the file.
Texture readTexture(const std::filesystem::path& path);

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

}  // namespace hair::groom
