#include "hair/groom/growth/grow.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "hair/groom/growth/direction_field.h"
#include "hair/groom/growth/root_density.h"
#include "hair/groom/growth/roots.h"
#include "hair/random.h"

namespace hair {
namespace {

constexpr glm::dvec3 kGravity{0.0, -1.0, 0.0};

// m, of a guide where the map is black: no segment may be without length.
constexpr double kShortest = 0.001;

// The direction after a length s at which droop * s = turn.
glm::dvec3 drooped(const glm::dvec3& direction, double turn) {
    const double cosine = glm::dot(direction, kGravity);
    const glm::dvec3 across = direction - cosine * kGravity;
    const double sine = glm::length(across);
    if (turn == 0.0 || sine < 1e-9) return direction;  // straight up or down it stays
    const double tangent = (1.0 - cosine) / sine * std::exp(-turn);  // of half the angle
    const double scale = 1.0 / (1.0 + tangent * tangent);
    return 2.0 * tangent * scale * (across / sine) + (1.0 - tangent * tangent) * scale * kGravity;
}

std::optional<Texture> picture(const std::filesystem::path& directory, const std::string& name) {
    if (name.empty()) return std::nullopt;
    return readTexture(directory / name);
}

}  // namespace

Groom grow(
    const Mesh& mesh, const GrowSettings& settings, const std::filesystem::path& directory,
    std::uint32_t guides, std::uint32_t seed) {
    assert(settings.vertices >= 2 && guides >= 1);
    const Scalp scalp = extractScalp(mesh, settings.scalp);
    const NearestSurface surface(scalp.positions, scalp.triangles);
    const std::optional<Texture> mask = picture(directory, settings.mask);
    const std::optional<Texture> length_map = picture(directory, settings.length_map);
    std::optional<PartingLine> line;
    if (settings.parting.strength > 0.0f) line.emplace(scalp, surface, settings.parting);
    const PartingLine* parting = line ? &*line : nullptr;
    const DirectionField directions(settings, surface, parting);
    Roots roots = placeRoots(
        scalp, surface,
        {.guides = guides,
         .seed = seed,
         .placement = settings.placement,
         .mask = mask ? &*mask : nullptr,
         .parting = parting});

    Groom groom;
    groom.strand_count = guides;
    groom.vertices_per_strand = settings.vertices;
    groom.root_triangles = std::move(roots.triangles);
    groom.points.reserve(std::size_t{guides} * settings.vertices);
    groom.root_normals.reserve(guides);
    for (std::uint32_t i = 0; i < guides; ++i) {
        const SurfacePoint& root = roots.points[i];
        double length = settings.length;
        if (length_map) length *= textureAt(*length_map, scalp, root);
        length *=
            1.0 - double{settings.length_variation} * random01(seed, i, purpose::guide_length);
        const double segment_length = std::max(length, kShortest) / groom.segmentsPerStrand();
        const glm::dvec3 direction = directions(root);
        glm::dvec3 position(root.position);
        groom.points.push_back(root.position);
        groom.root_normals.push_back(root.normal);
        for (std::uint32_t segment = 0; segment < groom.segmentsPerStrand(); ++segment) {
            const double middle = (segment + 0.5) * segment_length;
            position += segment_length * drooped(direction, settings.droop * middle);
            groom.points.emplace_back(position);
        }
    }
    return groom;
}

}  // namespace hair
