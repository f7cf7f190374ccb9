#include "hair/groom/edit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/depth.h"
#include "hair/groom/style/style.h"

namespace hair::groom {
namespace {

constexpr std::uint32_t kMostPointsOfAGuide = 256;

std::string millimetres(double metres) {
    std::ostringstream text;
    text << 1000.0 * metres << " mm";
    return text.str();
}

// ---- Leaving out --------------------------------------------------------------------------------

// A reason to leave a strand out.
struct StrandTest {
    std::string what;
    std::function<bool(std::uint32_t strand)> fails;
};

EditedStrands leaveOut(const StrandSet& strands, const std::vector<StrandTest>& tests) {
    EditedStrands edited;
    for (const StrandTest& test : tests) edited.notes.push_back({"left out: " + test.what, 0});
    std::vector<std::uint32_t> kept;
    engine::Step step("filters strands", strands.strandCount());
    for (std::uint32_t strand = 0; strand < strands.strandCount(); ++strand) {
        step.advance();
        const auto failed =
            std::ranges::find_if(tests, [&](const StrandTest& test) { return test.fails(strand); });
        if (failed == tests.end()) {
            kept.push_back(strand);
        } else {
            ++edited.notes[static_cast<std::size_t>(failed - tests.begin())].count;
        }
    }
    if (kept.empty()) throw engine::Error("no strand is left");
    edited.strands = keepStrands(strands, kept);
    return edited;
}

// ---- Points -------------------------------------------------------------------------------------

template <class Value>
void keepPoints(std::vector<Value>& values, const std::vector<bool>& kept) {
    if (values.empty()) return;
    std::size_t next = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (kept[i]) values[next++] = values[i];
    values.resize(next);
}

// Drops points that are not kept.
void keepPoints(StrandSet& strands, const std::vector<bool>& kept) {
    std::uint32_t first = 0;
    for (std::uint32_t& end : strands.ends) {
        const std::uint32_t before = first;
        first = end;
        end = static_cast<std::uint32_t>(std::count(
            kept.begin() + std::ptrdiff_t{before}, kept.begin() + std::ptrdiff_t{end}, true));
    }
    std::partial_sum(strands.ends.begin(), strands.ends.end(), strands.ends.begin());
    keepPoints(strands.points, kept);
    keepPoints(strands.widths.values, kept);
    keepPoints(strands.transparencies.values, kept);
    keepPoints(strands.colors.values, kept);
}

// Drops points at the place of the point before them. Returns their number.
std::uint64_t dropRepeatedPoints(StrandSet& strands) {
    std::vector<bool> kept(strands.points.size(), true);
    std::uint32_t first = 0;
    for (const std::uint32_t end : strands.ends) {
        for (std::uint32_t i = first + 1; i < end; ++i)
            kept[i] = strands.points[i] != strands.points[i - 1];
        first = end;
    }
    keepPoints(strands, kept);
    return static_cast<std::uint64_t>(std::ranges::count(kept, false));
}

// Whether all numbers of a point are finite.
bool isFinitePoint(const StrandSet& strands, std::size_t point) {
    const auto is_finite = [](const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    const auto has = [point](const auto& values, const auto& test) {
        return values.empty() || test(values[point]);
    };
    const auto is_number = [](float value) { return std::isfinite(value); };
    return is_finite(strands.points[point]) && has(strands.widths.values, is_number) &&
           has(strands.transparencies.values, is_number) && has(strands.colors.values, is_finite);
}

// ---- On a mesh ----------------------------------------------------------------------------------

std::span<glm::vec3> pointsOf(StrandSet& strands, std::uint32_t strand) {
    return std::span(strands.points).subspan(strands.first(strand), strands.size(strand));
}

void putOnMesh(
    EditedStrands& edited, const BodyMesh& mesh, double metres_per_unit, double farthest_root) {
    DepthInside depthOf(mesh);
    std::uint64_t moved = 0;
    std::uint64_t too_far = 0;
    std::uint64_t pushed = 0;
    std::uint64_t pushed_strands = 0;
    for (std::uint32_t strand = 0; strand < edited.strands.strandCount(); ++strand) {
        const std::span<glm::vec3> points = pointsOf(edited.strands, strand);
        const glm::dvec3 root = glm::dvec3(points[0]) * metres_per_unit;
        const MeshPoint at = depthOf.nearest(root);
        if (at.distance > farthest_root) {
            ++too_far;
        } else if (at.distance > kSurfaceTolerance) {
            const glm::dvec3 way = (at.position - root) / metres_per_unit;
            for (glm::vec3& point : points) point = glm::vec3(glm::dvec3(point) + way);
            ++moved;
        }
        std::uint64_t here = 0;
        for (glm::vec3& point : points.subspan(1)) {
            const glm::dvec3 metres = glm::dvec3(point) * metres_per_unit;
            if (depthOf(metres) <= kSurfaceTolerance) continue;
            point = glm::vec3(depthOf.nearest(metres).position / metres_per_unit);
            ++here;
        }
        pushed += here;
        pushed_strands += here > 0 ? 1 : 0;
    }
    edited.notes.push_back(
        {"moved: strands whose root was more than " + millimetres(kSurfaceTolerance) +
             " off the mesh",
         moved});
    edited.notes.push_back(
        {"left as they are: strands whose root is more than " + millimetres(farthest_root) +
             " off the mesh",
         too_far});
    edited.notes.push_back(
        {"moved onto the mesh: points deeper than " + millimetres(kSurfaceTolerance) +
             " inside it, on " + std::to_string(pushed_strands) + " strands",
         pushed});
}

}  // namespace

// ---- Filter -------------------------------------------------------------------------------------

EditedStrands filterStrands(
    const StrandSet& strands, const FilterSettings& settings, const BodyMesh* mesh,
    double metres_per_unit) {
    if ((settings.farthest_root || settings.deepest) && !mesh)
        throw engine::Error("there is no mesh to compare roots and points with");
    std::optional<DepthInside> depth;
    if (mesh) depth.emplace(*mesh);
    const auto metresOf = [&](const glm::vec3& point) {
        return glm::dvec3(point) * metres_per_unit;
    };
    const auto lengthOf = [&](std::uint32_t i) {
        return arcLength(strands.strand(i)) * metres_per_unit;
    };
    std::vector<StrandTest> tests;
    if (!settings.groups.empty()) {
        requireGroups(strands, settings.groups);
        tests.push_back({"of other groups", [&](std::uint32_t i) {
                             return std::ranges::find(settings.groups, strands.groups[i]) ==
                                    settings.groups.end();
                         }});
    }
    if (settings.shortest)
        tests.push_back({"shorter than " + millimetres(*settings.shortest), [&](std::uint32_t i) {
                             return lengthOf(i) < *settings.shortest;
                         }});
    if (settings.longest)
        tests.push_back({"longer than " + millimetres(*settings.longest), [&](std::uint32_t i) {
                             return lengthOf(i) > *settings.longest;
                         }});
    if (settings.fewest_points)
        tests.push_back(
            {"of fewer than " + std::to_string(*settings.fewest_points) + " points",
             [&](std::uint32_t i) { return strands.size(i) < *settings.fewest_points; }});
    if (settings.most_points)
        tests.push_back(
            {"of more than " + std::to_string(*settings.most_points) + " points",
             [&](std::uint32_t i) { return strands.size(i) > *settings.most_points; }});
    if (settings.farthest_root)
        tests.push_back(
            {"with the root more than " + millimetres(*settings.farthest_root) + " off the mesh",
             [&](std::uint32_t i) {
                 return depth->nearest(metresOf(strands.strand(i)[0])).distance >
                        *settings.farthest_root;
             }});
    if (settings.deepest)
        tests.push_back(
            {"with a point more than " + millimetres(*settings.deepest) + " inside the mesh",
             [&](std::uint32_t i) {
                 return std::ranges::any_of(strands.strand(i), [&](const glm::vec3& point) {
                     return (*depth)(metresOf(point)) > *settings.deepest;
                 });
             }});
    return leaveOut(strands, tests);
}

// ---- Smooth -------------------------------------------------------------------------------------

StrandSet smoothStrands(StrandSet strands, double length) {
    std::vector<std::size_t> segments;  // of a strand; those with a length
    std::vector<double> lengths;
    std::vector<glm::dvec3> directions;
    std::vector<double> above;  // above the diagonal of the eliminated matrix
    engine::Step step("smooths strands", strands.strandCount());
    for (std::uint32_t strand = 0; strand < strands.strandCount(); ++strand) {
        step.advance();
        const std::span<glm::vec3> points = pointsOf(strands, strand);
        segments.clear();
        lengths.clear();
        directions.clear();
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            const glm::dvec3 along = glm::dvec3(points[k + 1]) - glm::dvec3(points[k]);
            const double segment = glm::length(along);
            if (segment == 0.0) continue;
            segments.push_back(k);
            lengths.push_back(segment);
            directions.push_back(along / segment);
        }
        const std::size_t count = lengths.size();
        if (count < 2) continue;
        const std::vector<glm::dvec3> rough = directions;

        // Thomas's algorithm. The flow between neighbours i and i + 1 is length^2 over the distance
        // between their middles.
        const auto flow = [&](std::size_t i) {
            return length * length / (0.5 * (lengths[i] + lengths[i + 1]));
        };
        above.assign(count, 0.0);
        for (std::size_t i = 0; i < count; ++i) {
            const double before = i > 0 ? flow(i - 1) : 0.0;
            const double after = i + 1 < count ? flow(i) : 0.0;
            const double diagonal =
                lengths[i] + before + after + (i > 0 ? before * above[i - 1] : 0.0);
            above[i] = -after / diagonal;
            const glm::dvec3 carried = i > 0 ? before * directions[i - 1] : glm::dvec3(0.0);
            directions[i] = (lengths[i] * directions[i] + carried) / diagonal;
        }
        for (std::size_t i = count - 1; i-- > 0;) directions[i] -= above[i] * directions[i + 1];

        glm::dvec3 place(points[0]);
        std::size_t next = 0;
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            if (next < count && segments[next] == k) {
                const double size = glm::length(directions[next]);
                // If directions cancel out, the strand keeps its own.
                const glm::dvec3 along = size > 1e-12 ? directions[next] / size : rough[next];
                place += lengths[next++] * along;
            }
            points[k + 1] = glm::vec3(place);
        }
    }
    return strands;
}

// ---- Resample -----------------------------------------------------------------------------------

StrandSet resampleBySpacing(StrandSet strands, double spacing) {
    std::vector<std::uint32_t> sizes(strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        const double length = arcLength(strands.strand(i));
        const double pieces = std::clamp(std::round(length / spacing), 1.0, 4e9);
        sizes[i] = length > 0.0 ? static_cast<std::uint32_t>(pieces) + 1 : strands.size(i);
    }
    return resample(std::move(strands), sizes);
}

// ---- Fix ----------------------------------------------------------------------------------------

EditedStrands mendStrands(StrandSet strands) {
    std::vector<bool> kept(strands.points.size());
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = isFinitePoint(strands, i);
    const auto dropped = static_cast<std::uint64_t>(std::ranges::count(kept, false));
    if (dropped > 0) keepPoints(strands, kept);
    EditedStrands mended{
        .strands = usableStrands(std::move(strands)),
        .notes = {{"left out: points with a number that is not finite", dropped}}};
    for (const LeftOutStrands& each : mended.strands.left_out)
        mended.notes.push_back({"left out: strands " + each.reason, each.count});
    return mended;
}

EditedStrands fixStrands(
    const StrandSet& strands, const BodyMesh* mesh, double metres_per_unit, double farthest_root) {
    const std::vector<std::uint32_t> duplicates = duplicateStrands(strands);
    EditedStrands edited = leaveOut(
        strands,
        {{"strands of a single point", [&](std::uint32_t i) { return strands.size(i) == 1; }},
         {"strands without length",
          [&](std::uint32_t i) { return arcLength(strands.strand(i)) == 0.0; }},
         {"strands equal to one before them",
          [&](std::uint32_t i) { return std::ranges::binary_search(duplicates, i); }}});
    edited.notes.push_back(
        {"left out: points at the same place as the previous one",
         dropRepeatedPoints(edited.strands)});

    std::vector<std::uint32_t> sizes;
    std::uint64_t longer = 0;
    for (std::uint32_t i = 0; i < edited.strands.strandCount(); ++i) {
        longer += edited.strands.size(i) > kMostPointsOfAGuide ? 1 : 0;
        sizes.push_back(std::min(edited.strands.size(i), kMostPointsOfAGuide));
    }
    if (longer > 0) edited.strands = resample(std::move(edited.strands), sizes);
    edited.notes.push_back({"resampled to 256 points: strands with more", longer});
    if (mesh) putOnMesh(edited, *mesh, metres_per_unit, farthest_root);
    return edited;
}

// ---- Reverse ------------------------------------------------------------------------------------

StrandSet reverseStrands(StrandSet strands) {
    const auto reverse = [&](auto& values) {
        if (values.empty()) return;
        for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
            std::reverse(
                values.begin() + std::ptrdiff_t{strands.first(i)},
                values.begin() + std::ptrdiff_t{strands.ends[i]});
    };
    reverse(strands.points);
    reverse(strands.widths.values);
    reverse(strands.transparencies.values);
    reverse(strands.colors.values);
    return strands;
}

// ---- Transform ----------------------------------------------------------------------------------

glm::dmat3 upAxisTurn(std::uint8_t from, std::uint8_t to) {
    if (from == to) return glm::dmat3(1.0);
    // A turn about the third axis takes one of these to the other, and that to minus the first.
    glm::dmat3 turn(0.0);
    turn[3 - from - to][3 - from - to] = 1.0;
    turn[from][to] = 1.0;
    turn[to][from] = -1.0;
    return turn;
}

EditedStrands transformStrands(StrandSet strands, const TransformSettings& settings) {
    constexpr std::string_view kAxes = "xyz";
    const std::uint64_t count = strands.strandCount();
    EditedStrands edited;
    const auto note = [&](std::string what) {
        edited.notes.push_back({std::move(what) + ": strands", count});
    };
    double scale = 1.0;
    if (settings.metres_per_unit) {
        const auto from =
            settings.from_metres_per_unit ? settings.from_metres_per_unit : strands.metres_per_unit;
        if (!from) throw engine::Error("the present unit is not stated: give it");
        scale = *from / *settings.metres_per_unit;
        strands.metres_per_unit = settings.metres_per_unit;
        if (scale != 1.0)
            note(
                "converted from " + statedUnit(*from).name + " to " +
                statedUnit(*settings.metres_per_unit).name);
    } else if (settings.from_metres_per_unit) {
        strands.metres_per_unit = settings.from_metres_per_unit;
    }
    glm::dmat3 matrix(1.0);
    if (settings.from_up) strands.up = settings.from_up;
    if (settings.up) {
        if (!strands.up) throw engine::Error("the present upward axis is not stated: give it");
        matrix = upAxisTurn(*strands.up, *settings.up);
        if (strands.up != settings.up)
            note(
                std::string("turned from +") + kAxes[*strands.up] + " to +" + kAxes[*settings.up] +
                " up");
        strands.up = settings.up;
    }
    if (settings.mirror) {
        glm::dmat3 mirror(1.0);
        mirror[*settings.mirror][*settings.mirror] = -1.0;
        matrix = mirror * matrix;
        for (auto& triangle : strands.root_triangles) std::swap(triangle[1], triangle[2]);
        note(std::string("mirrored along ") + kAxes[*settings.mirror]);
    }
    if (settings.scale != 1.0) {
        scale *= settings.scale;
        std::ostringstream factor;
        factor << settings.scale;
        note("scaled by " + factor.str());
    }
    if (settings.translation != glm::dvec3(0.0)) note("translated");

    engine::Step step("transforms strands", count);
    for (std::uint32_t strand = 0; strand < count; ++strand) {
        step.advance();
        for (glm::vec3& point : pointsOf(strands, strand)) {
            point = glm::vec3(matrix * (scale * glm::dvec3(point)) + settings.translation);
            for (int axis = 0; axis < 3; ++axis)
                if (!std::isfinite(point[axis]))
                    throw engine::Error(
                        "strand " + std::to_string(strand) +
                        " would be outside the range of floats");
        }
    }
    const auto scaleWidth = [&](float& width) { width = static_cast<float>(width * scale); };
    std::ranges::for_each(strands.widths.values, scaleWidth);
    if (strands.widths.everywhere) scaleWidth(*strands.widths.everywhere);
    edited.strands = std::move(strands);
    return edited;
}

// ---- Groups -------------------------------------------------------------------------------------

std::vector<StrandGroup> groupsOf(const StrandSet& strands) {
    std::map<std::optional<std::int32_t>, StrandGroup> groups;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        std::optional<std::int32_t> number;
        if (!strands.groups.empty()) number = strands.groups[i];
        StrandGroup& group = groups[number];
        group.number = number;
        ++group.strands;
        group.guides += !strands.guides.empty() && strands.guides[i] != 0 ? 1 : 0;
        group.points += strands.size(i);
        group.mean_length += arcLength(strands.strand(i));
    }
    std::vector<StrandGroup> all;
    for (const auto& [number, group] : groups) {
        all.push_back(group);
        all.back().mean_length /= group.strands;
    }
    return all;
}

EditedStrands renumberGroups(StrandSet strands, const std::vector<GroupChange>& changes) {
    EditedStrands edited;
    std::map<std::int32_t, std::int32_t> numbers;
    for (const GroupChange& change : changes) {
        const std::string from = std::to_string(change.from);
        const auto count =
            static_cast<std::uint64_t>(std::ranges::count(strands.groups, change.from));
        if (count == 0) throw engine::Error("there is no group " + from);
        if (!numbers.try_emplace(change.from, change.to).second)
            throw engine::Error("group " + from + " is given two numbers");
        edited.notes.push_back(
            {"group " + from + " is now " + std::to_string(change.to) + ": strands", count});
    }
    for (std::int32_t& group : strands.groups)
        if (const auto at = numbers.find(group); at != numbers.end()) group = at->second;
    edited.strands = std::move(strands);
    return edited;
}

}  // namespace hair::groom
