#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/vec2.hpp>

#include "hair/groom/growth/scalp.h"
#include "hair/random.h"

// The density of roots: pictures over a scalp, and the density that a mask gives.
namespace hair::groom {

// A grey picture over texture coordinates: (0, 0) is its upper left corner, (1, 1) the lower right.
class Texture {
public:
    Texture(std::uint32_t width, std::uint32_t height, std::vector<float> brightness);

    // Interpolates the brightness between the centres of the four nearest pixels. Coordinates
    // beyond the edge count as on it.
    double operator()(const glm::dvec2& coordinate) const;

private:
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<float> brightness_;  // [row][column], 0 to 1
};

// Reads the brightness of a picture: Rec. 709's luma of the values that the file stores. Throws
// engine::Error that names the file.
Texture readTexture(const std::filesystem::path& path);

// The relative density of roots at each point of a scalp: the mask divided by its maximum there,
// since the number of roots is given. 1 without a mask.
class RootDensity {
public:
    // Borrows both; `mask` may be null. The maximum and the means are those of `points` random
    // points. Throws engine::Error for a mask without texture coordinates, or black all over.
    RootDensity(const Scalp& scalp, const Texture* mask, std::uint32_t points, std::uint32_t seed);

    double operator()(const SurfacePoint& point) const;  // 0 to 1
    double area() const { return area_; }  // m^2, of the part that isn't black
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

// Returns the sample with this number, of random points uniform in area.
inline SurfacePoint rootSample(const Scalp& scalp, std::uint32_t seed, std::uint32_t number) {
    return sampleSurface(
        scalp, {random01(seed, number, purpose::root_triangle),
                random01(seed, number, purpose::root_u), random01(seed, number, purpose::root_v)});
}

}  // namespace hair::groom
