#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"

// Straight strands of known size in pixels, white on black, so that a picture's value is the part
// of a pixel that strands cover.
namespace hair::rendering {

inline constexpr std::uint32_t kSide = 192;  // px
inline constexpr float kPixel = 0.001f;  // m, in the plane z = 0
inline constexpr float kFieldOfView = 2.0f;  // degrees: as good as parallel

// Pixels, y down, to metres.
inline glm::vec3 inPlane(glm::dvec2 pixels, float z = 0.0f) {
    const glm::dvec2 centred = pixels - 0.5 * kSide;
    return {static_cast<float>(centred.x) * kPixel, -static_cast<float>(centred.y) * kPixel, z};
}

inline float eyeDistance() {
    return 0.5f * kSide * kPixel / std::tan(0.5f * kFieldOfView * std::numbers::pi_v<float> / 180);
}

// Lit by ambient light alone.
inline Settings whiteStrands(double width_in_pixels) {
    Settings settings;
    settings.strands.density = 1;
    settings.strands.tessellation = 4;
    settings.strands.root_width = settings.strands.tip_width =
        static_cast<float>(width_in_pixels) * kPixel;
    settings.shading.color = glm::vec3(1.0f);
    settings.shading.ambient = 1.0f;
    settings.shading.diffuse = 0.0f;
    settings.shading.specular = 0.0f;
    settings.shading.lights = {{}};
    settings.camera.position = {0.0f, 0.0f, eyeDistance()};
    settings.camera.field_of_view = kFieldOfView;
    settings.render.width = kSide;
    settings.render.height = kSide;
    settings.render.background = glm::vec3(0.0f);
    return settings;
}

inline Settings withAnalyticCoverage(Settings settings, Transparency transparency) {
    settings.render.coverage = Coverage::analytic;
    settings.render.transparency = transparency;
    return settings;
}

struct Line {
    glm::vec3 root;  // m
    glm::vec3 tip;
};

// A strand on each line.
inline groom::Groom straightStrands(const std::vector<Line>& lines) {
    constexpr std::uint32_t kVertices = 4;
    groom::Groom groom{.vertices_per_strand = kVertices};
    for (const Line& line : lines) {
        const std::uint32_t first = groom.strand_count;
        groom.root_triangles.push_back({first, first + 1, first + 2});
        groom.strand_count += 3;
        for (int guide = 0; guide < 3; ++guide) {
            for (std::uint32_t v = 0; v < kVertices; ++v) {
                const float part = static_cast<float>(v) / (kVertices - 1);
                groom.points.push_back((1 - part) * line.root + part * line.tip);
            }
        }
    }
    return groom;
}

// Strands in the cells of a grid, at angles all round and at arbitrary positions within their
// pixels.
inline constexpr int kCells = 5;  // along each side
inline constexpr double kLength = 27.3;  // px

inline std::vector<Line> fan() {
    std::vector<Line> lines;
    for (int i = 0; i < kCells * kCells; ++i) {
        const double angle = std::numbers::pi * (i + 0.37) / (kCells * kCells);
        const glm::dvec2 cell(i % kCells, i / kCells);
        const double golden = i * 0.618033988749895;
        const glm::dvec2 off(golden - std::floor(golden), golden / 3 - std::floor(golden / 3));
        const glm::dvec2 centre = (cell + 0.5) * (static_cast<double>(kSide) / kCells) + off - 0.5;
        const glm::dvec2 half = 0.5 * kLength * glm::dvec2(std::cos(angle), std::sin(angle));
        lines.push_back({inPlane(centre - half), inPlane(centre + half)});
    }
    return lines;
}

inline double area(const std::vector<Line>& lines, double width_in_pixels) {
    return static_cast<double>(lines.size()) * kLength * width_in_pixels;  // px^2
}

// Sum of a picture's red, in units of white pixels.
inline double covered(const Pixels& pixels) {
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels.size(); i += 4) sum += pixels[i] / 255.0;
    return sum;
}

class TransparencyTest : public GpuTest {
protected:
    static Pixels draw(
        const Settings& settings, const std::vector<Line>& lines,
        const groom::Mesh* mesh = nullptr) {
        return drawGroom(device(), settings, straightStrands(lines), mesh);
    }
};

}  // namespace hair::rendering
