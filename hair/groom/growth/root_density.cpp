#include "hair/groom/growth/root_density.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/error.h"
#include "engine/pictures.h"

namespace hair::groom {
namespace {

// Two pixels along an axis, and the second one's weight.
struct Pair {
    std::uint32_t first;
    std::uint32_t second;
    double weight;
};

Pair pixelsAt(double coordinate, std::uint32_t size) {
    const double most = size - 1.0;
    const double at = std::clamp(coordinate * size - 0.5, 0.0, most);
    const double first = std::min(std::floor(at), std::max(most - 1.0, 0.0));
    const auto index = static_cast<std::uint32_t>(first);
    return {index, std::min(index + 1, size - 1), at - first};
}

}  // namespace

// ---- Pictures over a scalp ----------------------------------------------------------------------

Texture::Texture(std::uint32_t width, std::uint32_t height, std::vector<float> brightness)
    : width_(width), height_(height), brightness_(std::move(brightness)) {
    assert(width > 0 && height > 0 && brightness_.size() == std::size_t{width} * height);
}

double Texture::operator()(const glm::dvec2& coordinate) const {
    const Pair x = pixelsAt(coordinate.x, width_);
    const Pair y = pixelsAt(coordinate.y, height_);
    const auto row = [&](std::uint32_t index) {
        const float* pixels = brightness_.data() + std::size_t{index} * width_;
        return (1.0 - x.weight) * pixels[x.first] + x.weight * pixels[x.second];
    };
    return (1.0 - y.weight) * row(y.first) + y.weight * row(y.second);
}

Texture readTexture(const std::filesystem::path& path) {
    const engine::Pixels pixels = engine::readImage(path);
    std::vector<float> brightness;
    brightness.reserve(pixels.rgba.size() / 4);
    for (std::size_t i = 0; i < pixels.rgba.size(); i += 4) {
        const double luma =
            0.2126 * pixels.rgba[i] + 0.7152 * pixels.rgba[i + 1] + 0.0722 * pixels.rgba[i + 2];
        brightness.push_back(static_cast<float>(luma / 255.0));
    }
    return {pixels.width, pixels.height, std::move(brightness)};
}

// ---- Density ------------------------------------------------------------------------------------

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

}  // namespace hair::groom
