#include "hair/groom/style/style.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/random.h"

namespace hair::groom {

// ---- All steps in order -------------------------------------------------------------------------

Groom style(Groom groom, const StyleSettings& settings, std::uint32_t seed, const Mesh* mesh) {
    groom = braid(std::move(groom), settings.braid, seed, mesh);
    groom = clump(std::move(groom), settings.clump, seed);
    groom = wave(std::move(groom), settings.wave, seed);
    groom = curl(std::move(groom), settings.curl, seed);
    groom = frizz(std::move(groom), settings.frizz, seed);
    groom = flyaways(std::move(groom), settings.flyaways, seed);
    if (settings.clearance > 0.0f && !mesh)
        throw engine::Error("/groom/style/clearance: is above 0, but the strands grow on no mesh");
    const auto clear = [&] {
        if (settings.clearance > 0.0f)
            groom = keepClear(std::move(groom), *mesh, settings.clearance);
    };
    clear();
    groom = cut(std::move(groom), settings.cut, seed);
    clear();  // shorter strands have their vertices elsewhere
    return taper(std::move(groom), settings.taper);
}

// ---- Clumps -------------------------------------------------------------------------------------

namespace {

void drawToCentres(
    Groom& groom, const std::vector<std::uint32_t>& centres, const ClumpSettings& settings,
    std::uint32_t seed) {
    const std::size_t vertices = groom.vertices_per_strand;
    engine::Step step("draws strands into clumps", groom.strand_count);
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        step.advance();
        if (centres[strand] == strand) continue;
        const AlongStrand along(groom.strand(strand));
        const std::span<const glm::vec3> centre = groom.strand(centres[strand]);
        const double strength =
            settings.strength *
            (1.0 - double{settings.variation} * random01(seed, strand, purpose::clump_strength));
        for (std::size_t i = 0; i < vertices; ++i) {
            const double share = strength * ease(settings.start, 1.0, along.fraction(i));
            glm::vec3& point = groom.points[strand * vertices + i];
            point = glm::vec3(glm::mix(glm::dvec3(point), glm::dvec3(centre[i]), share));
        }
    }
}

}  // namespace

Groom clump(Groom groom, const ClumpSettings& settings, std::uint32_t seed) {
    if (settings.strength == 0.0f) return groom;
    for (std::uint32_t level = settings.levels; level-- > 0;) {
        const double spacing = std::ldexp(double{settings.spacing}, -static_cast<int>(level));
        drawToCentres(groom, clumpCentres(groom, spacing, seed), settings, seed);
    }
    return groom;
}

// ---- Cutting ------------------------------------------------------------------------------------

namespace {

constexpr double kLeast = 1e-3;  // fraction of a strand that is always left

// Arc length at which the strand first passes the plane; infinite if it never does.
double
arcAtPlane(std::span<const glm::vec3> points, const AlongStrand& along, const CutSettings& plane) {
    const auto beyond = [&](std::size_t i) {
        return glm::dot(glm::dvec3(points[i]) - glm::dvec3(plane.point), glm::dvec3(plane.normal));
    };
    if (beyond(0) > 0.0) return 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double before = beyond(i - 1);
        const double after = beyond(i);
        if (after > 0.0)
            return std::lerp(along.arc(i - 1), along.arc(i), before / (before - after));
    }
    return std::numeric_limits<double>::infinity();
}

// Arc length at which the strand passes the plane or is as long as allowed; infinite if neither.
double arcOfCut(std::span<const glm::vec3> points, const AlongStrand& along, const CutSettings& s) {
    const double most = s.length > 0.0f ? s.length : std::numeric_limits<double>::infinity();
    if (s.normal == glm::vec3(0.0f)) return most;
    return std::min(most, arcAtPlane(points, along, s));
}

// The first of the two old points that a new point of a strand lies between, and the share of the
// second.
struct Between {
    std::size_t point;
    double share;
};

// Returns places at even spacing over the first `length` of a strand, which is above 0 and below
// its whole length.
std::vector<Between> evenly(const AlongStrand& along, std::uint32_t vertices, double length) {
    std::vector<Between> places(vertices);
    std::size_t segment = 0;
    for (std::uint32_t i = 1; i < vertices; ++i) {
        const double arc = length * i / (vertices - 1);
        while (along.arc(segment + 1) < arc) ++segment;
        const double start = along.arc(segment);
        places[i] = {segment, (arc - start) / (along.arc(segment + 1) - start)};
    }
    return places;
}

template <class Value, class Wide>
void moveTo(std::span<Value> values, const std::vector<Between>& places, Wide&& widen) {
    const std::vector<Value> old(values.begin(), values.end());
    for (std::size_t i = 1; i < values.size(); ++i) {
        const auto [point, share] = places[i];
        values[i] = static_cast<Value>(glm::mix(widen(old[point]), widen(old[point + 1]), share));
    }
}

}  // namespace

Groom cut(Groom groom, const CutSettings& settings, std::uint32_t seed) {
    if (settings.length == 0.0f && settings.normal == glm::vec3(0.0f)) return groom;
    const std::uint32_t vertices = groom.vertices_per_strand;
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const AlongStrand along(groom.strand(strand));
        const double end = arcOfCut(groom.strand(strand), along, settings);
        if (end >= along.length()) continue;
        const double shorter =
            double{settings.variation} * random01(seed, strand, purpose::cut_length);
        const double left = std::max(end - shorter, kLeast * along.length());
        const std::vector<Between> places = evenly(along, vertices, left);
        const std::size_t first = std::size_t{strand} * vertices;
        moveTo(std::span(groom.points).subspan(first, vertices), places, [](const glm::vec3& v) {
            return glm::dvec3(v);
        });
        if (!groom.widths.empty())
            moveTo(std::span(groom.widths).subspan(first, vertices), places, [](float w) {
                return double{w};
            });
    }
    return groom;
}

// ---- Strands of a file --------------------------------------------------------------------------

namespace {

template <class Value>
std::vector<Value> pickPoints(
    const std::vector<Value>& values, const StrandSet& strands,
    std::span<const std::uint32_t> indices, std::size_t count) {
    std::vector<Value> picked;
    if (values.empty()) return picked;
    picked.reserve(count);
    for (const std::uint32_t strand : indices) {
        const auto first = values.begin() + std::ptrdiff_t{strands.first(strand)};
        picked.insert(picked.end(), first, first + std::ptrdiff_t{strands.size(strand)});
    }
    return picked;
}

}  // namespace

StrandSet pickStrands(const StrandSet& strands, std::span<const std::uint32_t> indices) {
    StrandSet picked{
        .metres_per_unit = strands.metres_per_unit,
        .up = strands.up,
        .comment = strands.comment,
        .warnings = strands.warnings};
    std::size_t count = 0;
    picked.ends.reserve(indices.size());
    for (const std::uint32_t strand : indices) {
        count += strands.size(strand);
        picked.ends.push_back(static_cast<std::uint32_t>(count));
    }
    if (count > std::numeric_limits<std::uint32_t>::max())
        throw engine::Error(
            std::to_string(indices.size()) + " strands have " + std::to_string(count) +
            " points, more than 2^32 - 1");
    const auto pick = [&](const auto& values) {
        return pickPoints(values, strands, indices, count);
    };
    picked.points = pick(strands.points);
    picked.widths = {strands.widths.everywhere, pick(strands.widths.values)};
    picked.transparencies = {
        strands.transparencies.everywhere, pick(strands.transparencies.values)};
    picked.colors = {strands.colors.everywhere, pick(strands.colors.values)};
    const auto pickEach = [&](const auto& values, auto& chosen) {
        if (values.empty()) return;
        chosen.reserve(indices.size());
        for (const std::uint32_t strand : indices) chosen.push_back(values[strand]);
    };
    pickEach(strands.root_uvs, picked.root_uvs);
    pickEach(strands.groups, picked.groups);
    pickEach(strands.guides, picked.guides);
    return picked;
}

StrandSet scaleLengths(StrandSet strands, double factor) {
    const auto scale = [factor](float& length) { length = static_cast<float>(length * factor); };
    for (glm::vec3& point : strands.points) point = glm::vec3(glm::dvec3(point) * factor);
    for (float& width : strands.widths.values) scale(width);
    if (strands.widths.everywhere) scale(*strands.widths.everywhere);
    return strands;
}

// ---- Follow hairs -------------------------------------------------------------------------------

namespace {

// A random point of the disc across the strand's direction at the root, uniform in area.
glm::dvec3 randomInDisc(
    std::span<const glm::vec3> points, double radius, std::uint32_t follower, std::uint32_t seed) {
    const glm::dvec3 direction = rootDirection(points);
    const glm::dvec3 u = across(direction);
    const glm::dvec3 v = glm::cross(direction, u);
    const double angle = 2.0 * std::numbers::pi * random01(seed, follower, purpose::follower_angle);
    const double distance =
        radius * std::sqrt(double{random01(seed, follower, purpose::follower_radius)});
    return distance * (std::cos(angle) * u + std::sin(angle) * v);
}

}  // namespace

StrandSet addFollowers(
    const StrandSet& strands, std::uint32_t count, float radius, float tip_separation,
    std::uint32_t seed) {
    if (count == 0) return strands;
    const std::uint64_t times = std::uint64_t{count} + 1;
    const std::uint64_t points = strands.points.size() * times;
    if (points > 0xffff'ffffu)
        throw engine::Error(
            std::to_string(count) + " followers for each strand make " + std::to_string(points) +
            " points, more than 2^32 - 1");

    std::vector<std::uint32_t> sources;
    sources.reserve(strands.strandCount() * times);
    for (std::uint32_t strand = 0; strand < strands.strandCount(); ++strand)
        sources.insert(sources.end(), times, strand);
    StrandSet all = pickStrands(strands, sources);
    for (std::uint32_t i = 0; i < all.strandCount(); ++i) {
        if (i % times == 0) continue;
        if (!all.guides.empty()) all.guides[i] = 0;
        const glm::dvec3 offset = randomInDisc(strands.strand(sources[i]), radius, i, seed);
        for (std::uint32_t k = 0; k < all.size(i); ++k) {
            const double share = k == 0 ? 0.0 : double(k) / (all.size(i) - 1);
            glm::vec3& point = all.points[all.first(i) + k];
            point = glm::vec3(
                glm::dvec3(point) + std::lerp(1.0, double{tip_separation}, share) * offset);
        }
    }
    all.root_triangles = strands.root_triangles;
    for (auto& triangle : all.root_triangles)
        for (std::uint32_t& corner : triangle) corner *= static_cast<std::uint32_t>(times);
    return all;
}

// ---- Widths -------------------------------------------------------------------------------------

Groom taper(Groom groom, const TaperSettings& settings) {
    if (settings.root_width == 0.0f) return groom;
    groom.widths.resize(groom.points.size());
    const double start = settings.start;
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        const AlongStrand along(groom.strand(strand));
        const std::size_t first = std::size_t{strand} * groom.vertices_per_strand;
        for (std::uint32_t i = 0; i < groom.vertices_per_strand; ++i) {
            const double past = along.fraction(i) - start;
            groom.widths[first + i] = static_cast<float>(
                past <= 0.0
                    ? settings.root_width
                    : std::lerp(settings.root_width, settings.tip_width, past / (1.0 - start)));
        }
    }
    return groom;
}

}  // namespace hair::groom
