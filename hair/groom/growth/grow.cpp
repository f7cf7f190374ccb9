#include "hair/groom/growth/grow.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/process.h"
#include "hair/groom/growth/root_density.h"
#include "hair/groom/growth/roots.h"
#include "hair/random.h"

namespace hair::groom {
namespace {

constexpr double kLeastRise = 0.05;  // least part of a direction along the normal

// The unit vector of the part along the surface, or zero if there is none.
glm::dvec3 alongSurface(const glm::dvec3& vector, const glm::dvec3& normal) {
    const glm::dvec3 flat = vector - glm::dot(vector, normal) * normal;
    const double length = glm::length(flat);
    return length > 1e-9 ? flat / length : glm::dvec3(0.0);
}

glm::dvec3
whorl(const WhorlSettings& settings, const glm::dvec3& from_centre, const glm::dvec3& normal) {
    const double r = glm::length(from_centre) / settings.radius;
    const double strength = settings.strength * r * std::exp(0.5 * (1.0 - r * r));
    return strength * alongSurface(glm::cross(normal, from_centre), normal);
}

glm::dvec3 partingAt(
    const PartingSettings& settings, const PartingLine::Place& place, const glm::dvec3& normal) {
    if (place.across == 0.0) return glm::dvec3(0.0);
    const double cosine = std::abs(place.across) / std::hypot(place.across, place.beyond);
    const double strength = settings.strength * cosine * std::exp(-place.distance / settings.reach);
    return strength * alongSurface(place.away, normal);
}

glm::dvec3 lifted(const glm::dvec3& direction, const glm::dvec3& normal) {
    if (glm::dot(direction, normal) >= kLeastRise) return direction;
    const glm::dvec3 flat = alongSurface(direction, normal);
    return glm::normalize(std::sqrt(1.0 - kLeastRise * kLeastRise) * flat + kLeastRise * normal);
}

constexpr glm::dvec3 kGravity{0.0, -1.0, 0.0};

// Length of a guide where the map is black, m: no segment may be without length.
constexpr double kShortest = 0.001;

// The direction after an arc length s with droop * s = turn.
glm::dvec3 drooped(const glm::dvec3& direction, double turn) {
    const double cosine = glm::dot(direction, kGravity);
    const glm::dvec3 across = direction - cosine * kGravity;
    const double sine = glm::length(across);
    if (turn == 0.0 || sine < 1e-9) return direction;  // a vertical direction stays
    const double tangent = (1.0 - cosine) / sine * std::exp(-turn);  // of half the angle
    const double scale = 1.0 / (1.0 + tangent * tangent);
    return 2.0 * tangent * scale * (across / sine) + (1.0 - tangent * tangent) * scale * kGravity;
}

std::optional<Texture> picture(const std::filesystem::path& directory, const std::string& name) {
    if (name.empty()) return std::nullopt;
    return readTexture(directory / name);
}

}  // namespace

// ---- Directions at the roots --------------------------------------------------------------------

DirectionField::DirectionField(
    const GrowSettings& settings, const NearestSurface& surface, const PartingLine* parting)
    : settings_(settings), parting_(parting) {
    if (settings.whorl.strength != 0.0f)
        whorl_centre_ = surface(glm::dvec3(settings.whorl.position)).position;
}

glm::dvec3 DirectionField::operator()(const SurfacePoint& root) const {
    const glm::dvec3 normal(root.normal);
    const bool has_whorl = settings_.whorl.strength != 0.0f;
    glm::dvec3 direction = normal + glm::dvec3(settings_.comb);
    if (has_whorl)
        direction += whorl(settings_.whorl, glm::dvec3(root.position) - whorl_centre_, normal);
    if (parting_)
        direction +=
            partingAt(settings_.parting, parting_->place(glm::dvec3(root.position)), normal);
    const double length = glm::length(direction);
    direction = length > 1e-6 ? direction / length : glm::normalize(normal);
    return has_whorl || parting_ ? lifted(direction, normal) : direction;
}

// ---- Growth -------------------------------------------------------------------------------------

Groom grow(
    const Mesh& mesh, const GrowSettings& settings, const std::filesystem::path& directory,
    std::uint32_t guides, std::uint32_t seed) {
    assert(settings.vertices >= 2 && guides >= 1);
    const bool dense = settings.strands > 0;
    const std::uint32_t count = dense ? settings.strands : guides;
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
        {.guides = count,
         .seed = seed,
         .placement = settings.placement,
         .mask = mask ? &*mask : nullptr,
         .parting = parting,
         .dense = dense});

    Groom groom;
    groom.strand_count = count;
    groom.vertices_per_strand = settings.vertices;
    groom.root_triangles = std::move(roots.triangles);
    groom.points.reserve(std::size_t{count} * settings.vertices);
    groom.root_normals.reserve(count);
    engine::Step step("grows strands", count);
    for (std::uint32_t i = 0; i < count; ++i) {
        step.advance();
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

}  // namespace hair::groom
