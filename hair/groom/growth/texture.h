#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/vec2.hpp>

namespace hair {

// A grey picture over texture coordinates: (0, 0) is its upper left corner, (1, 1) the lower right.
class Texture {
public:
    Texture(std::uint32_t width, std::uint32_t height, std::vector<float> brightness);

    // Between the four nearest pixels' centres; coordinates beyond the edge count as on it.
    double operator()(const glm::dvec2& coordinate) const;

private:
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<float> brightness_;  // [row][column], 0 to 1
};

// The brightness of the values that the file stores, red, green and blue as in Rec. 709's luma.
// Throws engine::Error that names the file.
Texture readTexture(const std::filesystem::path& path);

}  // namespace hair
