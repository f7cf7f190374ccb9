#include "hair/groom/groom.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/formats/binary_file.h"
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
        .bound_points = groom.bound_points.size(),
        .cached_points = groom.cache.points.size(),
        .root_normals = groom.root_normals.size(),
        .grouped_guides = groom.guide_groups.size(),
        .grouped_strands = groom.groups.size()};
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

// ---- Strands that can't be used -----------------------------------------------------------------

namespace {

// A group of a strand's numbers: of its points, or of itself.
struct StrandNumbers {
    const float* first = nullptr;  // null: the strands have none
    std::size_t each = 0;  // numbers of an element
    bool is_per_point = true;
    std::string_view reason;  // if one of them is not finite
};

template <class Value>
StrandNumbers
numbersOf(const std::vector<Value>& values, bool is_per_point, std::string_view reason) {
    return {
        values.empty() ? nullptr : reinterpret_cast<const float*>(values.data()),
        sizeof(Value) / sizeof(float), is_per_point, reason};
}

// Finds the first of a strand's faults; an empty reason if there is none. `widths` are those of all
// points if any is negative.
std::string_view faultOf(
    const StrandSet& strands, std::uint32_t strand, std::span<const StrandNumbers> suspects,
    std::span<const float> widths, std::span<const StrandSet::Fault>& faults) {
    if (!faults.empty() && faults.front().strand == strand) {
        const std::string_view reason = faults.front().reason;
        faults = faults.subspan(1);
        return reason;
    }
    if (strands.size(strand) < 2)
        return strands.size(strand) == 0 ? "without points" : "of a single point";
    for (const StrandNumbers& suspect : suspects) {
        const std::size_t first = suspect.is_per_point ? strands.first(strand) : strand;
        const std::size_t count = suspect.is_per_point ? strands.size(strand) : 1;
        if (firstNotFinite({suspect.first + first * suspect.each, count * suspect.each}))
            return suspect.reason;
    }
    if (!widths.empty() && anyNegative(widths.subspan(strands.first(strand), strands.size(strand))))
        return "with a negative width";
    return {};
}

// Has no branch within the loop, so that the compiler makes vector instructions of it.
bool allHaveTwoPoints(const StrandSet& strands) {
    std::uint32_t before = 0;
    std::uint32_t shorter = 0;
    for (const std::uint32_t end : strands.ends) {
        shorter |= end - before < 2 ? 1u : 0u;
        before = end;
    }
    return shorter == 0;
}

// Moves the values of kept strands to the front.
template <class Value>
void keepEach(std::vector<Value>& values, std::span<const std::uint32_t> kept) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
}

// Moves the values of the kept strands' points to the front.
template <class Value>
void keepPoints(
    std::vector<Value>& values, const StrandSet& strands, std::span<const std::uint32_t> kept) {
    if (values.empty()) return;
    std::size_t next = 0;
    for (const std::uint32_t strand : kept)
        for (std::uint32_t i = strands.first(strand); i < strands.ends[strand]; ++i)
            values[next++] = values[i];
    values.resize(next);
}

void keepTriangles(StrandSet& strands, std::span<const std::uint32_t> kept) {
    const auto is_gone = [&](std::array<std::uint32_t, 3>& triangle) {
        for (std::uint32_t& corner : triangle) {
            const auto at = std::ranges::lower_bound(kept, corner);
            if (at == kept.end() || *at != corner) return true;
            corner = static_cast<std::uint32_t>(at - kept.begin());
        }
        return false;
    };
    std::erase_if(strands.root_triangles, is_gone);
}

std::string countedText(const LeftOutStrands& left_out) {
    return std::to_string(left_out.count) + (left_out.count == 1 ? " strand " : " strands ") +
           left_out.reason + (left_out.count == 1 ? " (strand " : " (the first is strand ") +
           std::to_string(left_out.first) + ", counted from 0)";
}

std::string listOf(const std::vector<LeftOutStrands>& all) {
    std::string text;
    for (const LeftOutStrands& each : all)
        text.append(text.empty() ? "" : "; ").append(countedText(each));
    return text;
}

}  // namespace

StrandSet keepStrands(StrandSet strands, std::span<const std::uint32_t> kept) {
    if (kept.size() == strands.strandCount()) return strands;
    keepPoints(strands.points, strands, kept);
    keepPoints(strands.widths.values, strands, kept);
    keepPoints(strands.transparencies.values, strands, kept);
    keepPoints(strands.colors.values, strands, kept);
    keepEach(strands.root_uvs, kept);
    keepEach(strands.groups, kept);
    keepEach(strands.guides, kept);
    keepTriangles(strands, kept);
    std::vector<std::uint32_t> ends(kept.size());
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) ends[i] = end += strands.size(kept[i]);
    strands.ends = std::move(ends);
    return strands;
}

void requireGroups(const StrandSet& strands, std::span<const std::int32_t> groups) {
    if (strands.groups.empty()) throw engine::Error("the file has no groups to choose from");
    const std::set<std::int32_t> known(strands.groups.begin(), strands.groups.end());
    for (const std::int32_t group : groups) {
        if (known.contains(group)) continue;
        std::string names;
        constexpr std::size_t kMostNames = 20;
        std::size_t count = 0;
        for (const std::int32_t each : known) {
            if (count++ == kMostNames) break;
            names.append(names.empty() ? "" : ", ").append(std::to_string(each));
        }
        throw engine::Error(
            "no strand belongs to group " + std::to_string(group) + "; the file has " + names +
            (known.size() > kMostNames ? ", ..." : ""));
    }
}

StrandSet keepGroups(StrandSet strands, std::span<const std::int32_t> groups) {
    requireGroups(strands, groups);
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        if (std::ranges::find(groups, strands.groups[i]) != groups.end()) kept.push_back(i);
    return keepStrands(std::move(strands), kept);
}

std::vector<std::uint32_t> flaggedGuides(const StrandSet& strands) {
    std::vector<std::uint32_t> flagged;
    for (std::uint32_t i = 0; i < strands.guides.size(); ++i)
        if (strands.guides[i] != 0) flagged.push_back(i);
    return flagged;
}

namespace {

// Drops a value of all strands that is not finite.
template <class Value>
void dropNotFinite(PointAttribute<Value>& attribute, const char* name, StrandSet& strands) {
    if (!attribute.everywhere) return;
    const auto* const numbers = reinterpret_cast<const float*>(&*attribute.everywhere);
    if (!firstNotFinite({numbers, sizeof(Value) / sizeof(float)})) return;
    attribute.everywhere.reset();
    strands.warnings.push_back(
        std::string("the ") + name + " of all strands is not finite and is left out");
}

}  // namespace

std::string warningOf(const LeftOutStrands& left_out) {
    return countedText(left_out) + (left_out.count == 1 ? " is left out" : " are left out");
}

StrandSet usableStrands(StrandSet strands, BadStrands bad) {
    assert(bad != BadStrands::kept);
    if (isNegative(strands.widths.everywhere.value_or(0.0f)) && strands.widths.values.empty()) {
        strands.widths.everywhere.reset();
        strands.warnings.emplace_back("the width of all strands is negative and is left out");
    }
    dropNotFinite(strands.widths, "width", strands);
    dropNotFinite(strands.transparencies, "transparency", strands);
    dropNotFinite(strands.colors, "colour", strands);
    std::vector<StrandNumbers> suspects{
        numbersOf(strands.points, true, "with a position that is not finite"),
        numbersOf(strands.widths.values, true, "with a width that is not finite"),
        numbersOf(strands.transparencies.values, true, "with a transparency that is not finite"),
        numbersOf(strands.colors.values, true, "with a colour that is not finite"),
        numbersOf(strands.root_uvs, false, "with a texture coordinate that is not finite")};
    std::erase_if(suspects, [&](const StrandNumbers& numbers) {
        const std::size_t count =
            numbers.is_per_point ? strands.points.size() : strands.ends.size();
        return !numbers.first || !firstNotFinite({numbers.first, count * numbers.each});
    });
    std::span<const float> widths;
    if (anyNegative(strands.widths.values)) widths = strands.widths.values;
    std::span<const StrandSet::Fault> faults(strands.faults);
    // Files of millions of good strands, the usual ones, need no look at each.
    if (suspects.empty() && widths.empty() && faults.empty() && allHaveTwoPoints(strands))
        return strands;
    std::vector<std::uint32_t> bad_strands;
    const std::uint32_t count = strands.strandCount();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string_view reason = faultOf(strands, i, suspects, widths, faults);
        if (reason.empty()) continue;
        bad_strands.push_back(i);
        const auto known = std::ranges::find(strands.left_out, reason, &LeftOutStrands::reason);
        if (known == strands.left_out.end())
            strands.left_out.push_back({.reason = std::string(reason), .count = 1, .first = i});
        else
            ++known->count;
    }
    strands.faults.clear();
    if (bad_strands.empty()) return strands;
    if (bad == BadStrands::refused)
        throw engine::Error(
            listOf(strands.left_out) +
            ": refused by --strict; 'hairbench groom fix' mends what it can and leaves out the "
            "rest");
    if (bad_strands.size() == count)
        throw engine::Error("no strand can be used; the file has only " + listOf(strands.left_out));
    std::vector<std::uint32_t> kept;
    kept.reserve(count - bad_strands.size());
    auto next_bad = bad_strands.begin();
    for (std::uint32_t i = 0; i < count; ++i)
        if (next_bad != bad_strands.end() && *next_bad == i)
            ++next_bad;
        else
            kept.push_back(i);
    strands = keepStrands(std::move(strands), kept);
    for (const LeftOutStrands& each : strands.left_out) strands.warnings.push_back(warningOf(each));
    return strands;
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
