#include "hair/rendering/irradiance.h"

#include <cmath>
#include <numbers>

namespace hair {

namespace {

constexpr double kPi = std::numbers::pi;

std::array<double, 9> harmonics(const glm::dvec3& n) {
    return {
        0.282095,
        0.488603 * n.y,
        0.488603 * n.z,
        0.488603 * n.x,
        1.092548 * n.x * n.y,
        1.092548 * n.y * n.z,
        0.315392 * (3 * n.z * n.z - 1),
        1.092548 * n.x * n.z,
        0.546274 * (n.x * n.x - n.y * n.y)};
}

// The cosine lobe's harmonics over pi (their eq. 8), by l.
constexpr std::array kLobe{1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25};

}  // namespace

std::array<glm::dvec3, 9> irradianceHarmonics(const engine::FloatPixels& picture, double turn) {
    std::array<glm::dvec3, 9> sums{};
    const float* texel = picture.rgb.data();
    for (std::uint32_t row = 0; row < picture.height; ++row) {
        const double top = kPi * row / picture.height;
        const double bottom = kPi * (row + 1) / picture.height;
        const double solid_angle = 2 * kPi / picture.width * (std::cos(top) - std::cos(bottom));
        const double polar = (top + bottom) / 2;
        for (std::uint32_t column = 0; column < picture.width; ++column, texel += 3) {
            const double azimuth = turn + 2 * kPi * (0.5 - (column + 0.5) / picture.width);
            const std::array basis = harmonics(
                {std::sin(polar) * std::sin(azimuth), std::cos(polar),
                 std::sin(polar) * std::cos(azimuth)});
            const glm::dvec3 light = solid_angle * glm::dvec3(texel[0], texel[1], texel[2]);
            for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += basis[i] * light;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] *= kLobe[i];
    return sums;
}

}  // namespace hair
