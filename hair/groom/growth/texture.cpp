#include "hair/groom/growth/texture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/image_file.h"

namespace hair {
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

}  // namespace hair
