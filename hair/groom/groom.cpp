#include "hair/groom/groom.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/groom_size.h"

namespace hair::groom {
namespace {

// ---- Even spacing -------------------------------------------------------------------------------

// A place between two neighbouring points.
struct Place {
    std::size_t point;  // index of the point before it
    double fraction;  // 0 there, 1 at the next
};

double segmentLength(std::span<const glm::vec3> points, std::size_t segment) {
    return glm::distance(glm::dvec3(points[segment]), glm::dvec3(points[segment + 1]));
}

// Finds places at equal distances along a strand. In a strand without length, all segments count as
// equally long: the points stay where they are, and their attributes still run from root to tip.
void spaceEvenly(std::span<const glm::vec3> points, std::size_t first, std::span<Place> places) {
    const std::size_t segments = points.size() - 1;
    double total = 0.0;
    for (std::size_t i = 0; i < segments; ++i) total += segmentLength(points, i);
    const bool has_length = total > 0.0;
    if (!has_length) total = static_cast<double>(segments);

    const double step = total / static_cast<double>(places.size() - 1);
    std::size_t segment = 0;
    double start = 0.0;  // of the segment, as arc length from the root
    for (std::size_t k = 0; k < places.size(); ++k) {
        const double wanted = static_cast<double>(k) * step;
        for (; segment < segments; ++segment) {
            const double length = has_length ? segmentLength(points, segment) : 1.0;
            if (wanted < start + length) {
                places[k] = {first + segment, (wanted - start) / length};
                break;
            }
            start += length;
        }
        if (segment == segments) places[k] = {first + segments, 0.0};
    }
    places.front() = {first, 0.0};
    places.back() = {first + segments, 0.0};
}

template <class Value>
Value interpolateAt(const std::vector<Value>& values, const Place& place) {
    if (place.fraction == 0.0) return values[place.point];
    const auto mix = [&](float a, float b) {
        return static_cast<float>(a + place.fraction * (double{b} - double{a}));
    };
    const Value& a = values[place.point];
    const Value& b = values[place.point + 1];
    if constexpr (std::is_same_v<Value, float>) {
        return mix(a, b);
    } else {
        return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z)};
    }
}

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from, std::span<const Place> places) {
    if (from.empty()) return;
    for (const Place& place : places) to.push_back(interpolateAt(from, place));
}

// Visits the places of all strands in order, one strand at a time.
template <class Visit>
void forEachPlace(const StrandSet& strands, std::span<const std::uint32_t> sizes, Visit&& visit) {
    std::vector<Place> places;
    engine::Step step("spaces points evenly", strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        step.advance();
        places.resize(sizes[i]);
        if (strands.size(i) == sizes[i]) {
            for (std::uint32_t k = 0; k < sizes[i]; ++k) places[k] = {strands.first(i) + k, 0.0};
        } else {
            spaceEvenly(strands.strand(i), strands.first(i), places);
        }
        visit(std::span<const Place>(places));
    }
}

}  // namespace

GroomSize sizeOf(const Groom& groom) {
    return {
        .guides = groom.strand_count,
        .vertices_per_guide = groom.vertices_per_strand,
        .root_triangles = groom.root_triangles.size(),
        .bound_strands = groom.bindings.size(),
        .bound_points = groom.bound_points.size()};
}

std::optional<std::uint32_t> commonSize(const StrandSet& strands) {
    if (strands.ends.empty()) return {};
    const std::uint32_t size = strands.ends.front();
    for (std::uint32_t i = 1; i < strands.strandCount(); ++i)
        if (strands.size(i) != size) return {};
    return size;
}

std::uint32_t greatestSize(const StrandSet& strands) {
    std::uint32_t greatest = 0;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        greatest = std::max(greatest, strands.size(i));
    return greatest;
}

// ---- Resampling ---------------------------------------------------------------------------------

StrandSet resample(StrandSet strands, std::uint32_t vertices) {
    assert(vertices >= 2);
    if (strands.ends.empty() || commonSize(strands) == vertices) return strands;
    return resample(
        std::move(strands), std::vector<std::uint32_t>(strands.strandCount(), vertices));
}

StrandSet resample(StrandSet strands, std::span<const std::uint32_t> sizes) {
    assert(sizes.size() == strands.strandCount());
    const std::size_t count = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    if (count > std::numeric_limits<std::uint32_t>::max()) {
        const auto [least, most] = std::ranges::minmax(sizes);
        throw engine::Error(
            std::to_string(strands.strandCount()) + " strands of " +
                (least == most ? "" : "up to ") + std::to_string(most) + " points",
            "more than 2^32 - 1 points in all");
    }

    std::vector<glm::vec3> points;
    decltype(strands.widths.values) widths;
    decltype(strands.transparencies.values) transparencies;
    decltype(strands.colors.values) colors;
    points.reserve(count);
    widths.reserve(strands.widths.values.empty() ? 0 : count);
    transparencies.reserve(strands.transparencies.values.empty() ? 0 : count);
    colors.reserve(strands.colors.values.empty() ? 0 : count);
    forEachPlace(strands, sizes, [&](std::span<const Place> places) {
        append(points, strands.points, places);
        append(widths, strands.widths.values, places);
        append(transparencies, strands.transparencies.values, places);
        append(colors, strands.colors.values, places);
    });
    std::partial_sum(sizes.begin(), sizes.end(), strands.ends.begin());
    strands.points = std::move(points);
    strands.widths.values = std::move(widths);
    strands.transparencies.values = std::move(transparencies);
    strands.colors.values = std::move(colors);
    return strands;
}

}  // namespace hair::groom
