#include "hair/groom/growth/grow.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/growth/parting.h"
#include "hair/groom/growth/root_density.h"
#include "hair/groom/growth/roots.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/guides/bind_strands.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom/style/displace.h"
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

// ---- Vellus hairs -------------------------------------------------------------------------------

namespace {

constexpr std::uint32_t kHairPoints = 6;
constexpr double kEdgeStep = 0.0005;  // m, between places on the scalp's edge
constexpr double kRise = 0.3;  // slope of a hair at its root: tangent of its angle to the surface
constexpr double kMostTurn = 25.0 * std::numbers::pi / 180.0;

// Returns places along the edges with one triangle of the scalp.
std::vector<glm::vec3> edgePlaces(const Scalp& scalp) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& triangle : scalp.triangles)
        for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(triangle[i], triangle[(i + 1) % 3])];
    std::vector<glm::vec3> places;
    for (const auto& [edge, count] : uses) {
        if (count != 1) continue;
        const glm::dvec3 from(scalp.positions[edge.first]);
        const glm::dvec3 to(scalp.positions[edge.second]);
        const auto steps = std::max(1.0, std::ceil(glm::distance(from, to) / kEdgeStep));
        for (double i = 0.0; i < steps; ++i) places.emplace_back(from + i / steps * (to - from));
    }
    return places;
}

// The part of the mesh within a band round the scalp's edge.
class Band {
public:
    Band(const Mesh& mesh, const Scalp& scalp, const NearestSurface& surface, double width)
        : places_(edgePlaces(scalp)), surface_(surface), width_(width) {
        if (places_.empty())
            throw engine::Error("/groom/grow/vellus: the scalp has no edge for them to grow along");
        tree_.emplace(std::span<const glm::vec3>(places_));
        whole_ = extractScalp(mesh, "*");
        const auto isNear = [&](const std::array<std::uint32_t, 3>& triangle) {
            const auto corner = [&](std::size_t i) {
                return glm::dvec3(whole_.positions[triangle[i % 3]]);
            };
            double longest = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
                longest = std::max(longest, glm::distance(corner(i), corner(i + 1)));
            return fromEdge(whole_.positions[triangle[0]]) <= width_ + longest;
        };
        double sum = 0.0;
        double so_far = 0.0;
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::vector<double> areas;
        for (std::size_t i = 0; i < whole_.triangles.size(); ++i) {
            const double area = whole_.cumulative_areas[i] - so_far;
            so_far = whole_.cumulative_areas[i];
            if (!isNear(whole_.triangles[i])) continue;
            triangles.push_back(whole_.triangles[i]);
            areas.push_back(sum += area);
        }
        whole_.triangles = std::move(triangles);
        whole_.cumulative_areas = std::move(areas);
        whole_.texture_coordinates.clear();
    }

    const Scalp& around() const { return whole_; }

    double fromEdge(const glm::vec3& point) const {  // m
        std::array<std::uint32_t, 1> nearest{};
        tree_->find(point, nearest);
        return glm::distance(glm::dvec3(point), glm::dvec3(places_[nearest[0]]));
    }

    bool isOnScalp(const glm::vec3& point) const {
        static constexpr double kOnSurface = 1e-5;  // m
        return surface_.within(glm::dvec3(point), kOnSurface).has_value();
    }

private:
    std::vector<glm::vec3> places_;
    const NearestSurface& surface_;
    double width_;
    std::optional<RootKdTree> tree_;
    Scalp whole_;
};

// Returns the direction along the surface, turned by `turn`.
glm::dvec3 lyingDown(const glm::dvec3& direction, const glm::dvec3& normal, double turn) {
    glm::dvec3 flat = direction - glm::dot(direction, normal) * normal;
    if (glm::length(flat) < 0.05) {  // it stands up: then down the slope
        const glm::dvec3 down(0.0, -1.0, 0.0);
        flat += down - glm::dot(down, normal) * normal;
    }
    const double length = glm::length(flat);
    const glm::dvec3 along = length > 1e-6 ? flat / length : groom::across(normal);
    return std::cos(turn) * along + std::sin(turn) * glm::cross(normal, along);
}

}  // namespace

StrandSet growVellus(const Mesh& mesh, const GrowSettings& settings, std::uint32_t seed) {
    const VellusSettings& vellus = settings.vellus;
    const auto count =
        static_cast<std::uint32_t>(std::lround(double{vellus.share} * settings.strands));
    StrandSet hairs{.metres_per_unit = 1.0};
    hairs.widths.everywhere = vellus.width;
    if (count == 0) return hairs;
    const Scalp scalp = extractScalp(mesh, settings.scalp);
    const NearestSurface surface(scalp.positions, scalp.triangles);
    std::optional<PartingLine> parting;
    if (settings.parting.strength > 0.0f) parting.emplace(scalp, surface, settings.parting);
    const DirectionField directions(settings, surface, parting ? &*parting : nullptr);
    const Band band(mesh, scalp, surface, vellus.band);
    engine::Step step("grows vellus hairs");
    for (std::uint32_t i = 0; hairs.ends.size() < count; ++i) {
        step.advance();
        const std::uint32_t own = hash(seed, i, purpose::vellus_choice);
        const SurfacePoint root = rootSample(band.around(), own, 0);
        const double apart = band.fromEdge(root.position);
        if (random01(own, 1, purpose::vellus_choice) >= 1.0 - ease(0.0, vellus.band, apart))
            continue;
        const double inside = band.isOnScalp(root.position) ? apart / vellus.band : 0.0;
        const double share = 1.0 - 2.0 / 3.0 * random01(own, 0, purpose::vellus_length);
        const double length = vellus.length * (1.0 + inside) * share;
        const double turn = kMostTurn * (2.0 * random01(own, 0, purpose::vellus_turn) - 1.0);
        const glm::dvec3 normal(root.normal);
        const glm::dvec3 along = lyingDown(directions(root), normal, turn);
        for (std::uint32_t k = 0; k < kHairPoints; ++k) {
            const double s = static_cast<double>(k) / (kHairPoints - 1);
            // It rises from the skin and bends back along it.
            const double height = kRise * s * (1.0 - 0.5 * s);
            hairs.points.emplace_back(
                glm::dvec3(root.position) + length * (s * along + height * normal));
        }
        hairs.ends.push_back(static_cast<std::uint32_t>(hairs.points.size()));
    }
    return hairs;
}

}  // namespace hair::groom
