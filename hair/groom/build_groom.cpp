#include "hair/groom/build_groom.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/text.h"
#include "hair/groom/growth/grow.h"
#include "hair/groom/guides/bind_strands.h"
#include "hair/groom/guides/choose_guides.h"
#include "hair/groom/guides/root_triangles.h"
#include "hair/groom/style/strokes.h"
#include "hair/groom/style/style.h"

namespace hair::groom {
namespace {

constexpr std::uint32_t kMostVertices = 256;  // for guides with no given number

// ---- Guides of a scene --------------------------------------------------------------------------

constexpr std::uint32_t kThesisGuides = 86;

glm::dmat4 placement(const FilePlacementSettings& settings, double scale) {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(settings.translation));
    for (int axis = 2; axis >= 0; --axis) {
        glm::dvec3 direction(0.0);
        direction[axis] = 1.0;
        matrix = glm::rotate(matrix, glm::radians(double{settings.rotation[axis]}), direction);
    }
    return glm::scale(matrix, glm::dvec3(scale));
}

void place(StrandSet& strands, const FilePlacementSettings& settings) {
    const double scale = double{settings.scale} * strands.metres_per_unit.value_or(1.0);
    const glm::dmat4 matrix = placement(settings, scale);
    strands.metres_per_unit = 1.0;
    if (matrix == glm::dmat4(1.0)) return;
    for (glm::vec3& point : strands.points)
        point = glm::vec3(matrix * glm::dvec4(glm::dvec3(point), 1.0));
    for (float& width : strands.widths.values) width = static_cast<float>(width * scale);
    if (strands.widths.everywhere)
        *strands.widths.everywhere = static_cast<float>(*strands.widths.everywhere * scale);
}

// The brush strokes for a groom that is styled.
Strokes strokesOf(const GroomSettings& settings, const Groom& styled, const Mesh* mesh) {
    return Strokes(settings.edits, mesh, settings.style.clearance, middleOfRoots(styled));
}

// Returns the strands that become guides; a count of 0 takes all. They are chosen before brushes
// move strands, so that strokes don't change the choice.
std::vector<std::uint32_t> guidesOf(const Groom& dense, std::uint32_t count, std::uint32_t seed) {
    if (count != 0 && count != dense.strand_count) return chooseGuides(dense, count, seed);
    std::vector<std::uint32_t> all(dense.strand_count);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

// Makes all strands guides, or the chosen ones with the others bound to them.
Groom withGuides(Groom dense, const std::vector<std::uint32_t>& chosen, const Mesh* mesh) {
    if (chosen.size() == dense.strand_count) {
        dense.bindings = bindStrands(dense, chosen);
        if (dense.root_triangles.empty()) dense.root_triangles = triangulateRoots(dense, mesh);
        return dense;
    }
    Groom guides = pickStrands(dense, chosen);
    guides.bindings = bindStrands(dense, chosen);
    guides.root_triangles = triangulateRoots(guides, mesh);
    return guides;
}

// Strands as points alone.
struct Polylines {
    std::vector<std::uint32_t> ends;  // [strand], index after its last point
    std::vector<glm::vec3> points;
};

// Returns the strands as they are drawn at rest: a strand of the file or, if styling moved it, its
// styled points. `before` and `after` are the strands' resampled points, [strand][vertex].
Polylines
drawnStrands(Polylines file, std::span<const glm::vec3> before, std::span<const glm::vec3> after) {
    if (std::ranges::equal(before, after)) return file;
    const std::size_t vertices = after.size() / file.ends.size();
    Polylines drawn;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < file.ends.size(); ++i) {
        std::span<const glm::vec3> points = after.subspan(i * vertices, vertices);
        if (std::ranges::equal(before.subspan(i * vertices, vertices), points))
            points = std::span<const glm::vec3>(file.points).subspan(first, file.ends[i] - first);
        first = file.ends[i];
        drawn.points.insert(drawn.points.end(), points.begin(), points.end());
        drawn.ends.push_back(static_cast<std::uint32_t>(drawn.points.size()));
    }
    return drawn;
}

// Adds strands that follow the head alone to the groom's bound strands.
void addFixed(Groom& groom, const StrandSet& strands) {
    if (!groom.groups.empty())
        groom.groups.insert(groom.groups.end(), strands.strandCount(), Groom::kNoGroup);
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        const std::span<const glm::vec3> points = strands.strand(i);
        groom.bindings.push_back(
            {.guides = {0, 0, 0},
             .weights = glm::vec3(0.0f),
             .offset = points.front(),
             .width = strands.widths.known() ? strands.widths.at(strands.first(i)) : 0.0f});
        groom.bound_points.insert(groom.bound_points.end(), points.begin(), points.end());
        groom.bound_ends.push_back(static_cast<std::uint32_t>(groom.bound_points.size()));
    }
}

void addFixedFile(
    Groom& groom, const std::string& file, const std::filesystem::path& directory,
    const NamedFileCheck& check) {
    if (file.empty() || groom.bound_ends.empty()) return;
    StrandSet strands = importStrands(directory / file, 0, check);
    place(strands, {});
    addFixed(groom, strands);
}

// Returns which of the file's strands become guides: those that it flags, or as many of them as
// asked for. Files without flags have their guides chosen from all strands.
std::vector<std::uint32_t> guidesOf(
    const Groom& dense, const std::vector<std::uint32_t>& flagged, std::uint32_t count,
    std::uint32_t seed) {
    if (flagged.empty()) return guidesOf(dense, count, seed);
    if (count == 0 || count == flagged.size()) return flagged;
    if (count > flagged.size())
        throw engine::Error(
            "/groom/guides is " + std::to_string(count) + ", but the file flags " +
            std::to_string(flagged.size()) + " strands as guides; 0 takes them all");
    std::vector<std::uint32_t> chosen = chooseGuides(pickStrands(dense, flagged), count, seed);
    for (std::uint32_t& strand : chosen) strand = flagged[strand];
    return chosen;
}

// Drops bindings of the strands that the file flags as guides, unless there are no others: they
// guide hair and are not hair.
void dropFlagged(Groom& groom, Polylines& file, const std::vector<std::uint32_t>& flagged) {
    if (flagged.empty() || flagged.size() == file.ends.size()) return;
    Polylines drawn;
    std::vector<StrandBinding> bindings;
    std::vector<std::int32_t> groups;
    auto next_flagged = flagged.begin();
    for (std::uint32_t i = 0; i < file.ends.size(); ++i) {
        if (next_flagged != flagged.end() && *next_flagged == i) {
            ++next_flagged;
            continue;
        }
        const auto first = file.points.begin() + (i == 0 ? 0 : file.ends[i - 1]);
        drawn.points.insert(drawn.points.end(), first, file.points.begin() + file.ends[i]);
        drawn.ends.push_back(static_cast<std::uint32_t>(drawn.points.size()));
        bindings.push_back(groom.bindings[i]);
        if (!groom.groups.empty()) groups.push_back(groom.groups[i]);
    }
    file = std::move(drawn);
    groom.bindings = std::move(bindings);
    groom.groups = std::move(groups);
}

// Reads numbers of groups: "0, 2". Throws engine::Error for other words.
std::vector<std::int32_t> groupsNamed(std::string_view text) {
    std::vector<std::int32_t> groups;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(','), text.size());
        std::string_view rest = text.substr(0, end);
        const std::string_view word = takeWord(rest);
        const auto number = integerFrom(word);
        if (!number || *number < std::numeric_limits<std::int32_t>::min() ||
            *number > std::numeric_limits<std::int32_t>::max() || !takeWord(rest).empty())
            throw engine::Error(
                inQuotes(text.substr(0, end)) +
                " is not the number of a group; numbers with commas between them are expected");
        groups.push_back(static_cast<std::int32_t>(*number));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return groups;
}

StrandSet strandsOf(
    const GroomSettings& settings, const std::filesystem::path& path, const NamedFileCheck& check) {
    StrandSet strands = importStrands(path, settings.points_per_strand, check);
    if (settings.groups.empty()) return strands;
    try {
        return keepGroups(std::move(strands), groupsNamed(settings.groups));
    } catch (const engine::Error& error) {
        throw engine::Error(path.string() + ": /groom/groups", error.what());
    }
}

// Reads the file that plays; nothing if none does.
StrandSamples samplesOf(
    const GroomSettings& settings, const std::filesystem::path& directory,
    const NamedFileCheck& check) {
    if (settings.cache.mode == CacheMode::none) return {};
    const std::string& name = settings.cache.file.empty() ? settings.file : settings.cache.file;
    return importStrandSamples(directory / name, check);
}

// Returns the motion of the chosen guides. `ends` are of the strands of settings.file.
GuideCache cacheOf(
    const GroomSettings& settings, StrandSamples samples, const std::vector<std::uint32_t>& ends,
    std::uint32_t vertices, const std::vector<std::uint32_t>& chosen) {
    if (samples.ends != ends)
        throw engine::Error(
            "/groom/cache: the cache has " + std::to_string(samples.ends.size()) +
            " strands with " + std::to_string(samples.ends.empty() ? 0 : samples.ends.back()) +
            " points, but /groom/file has " + std::to_string(ends.size()) + " with " +
            std::to_string(ends.back()) +
            ", or other numbers of points: a cache needs the "
            "same strands in the same order");
    GuideCache cache{.times = std::move(samples.times), .points = {}, .strength = {}};
    if (settings.cache.mode == CacheMode::follow) cache.strength = settings.cache.strength;
    const std::size_t count = ends.back();
    engine::Step step("reads samples of guides", cache.times.size());
    for (std::size_t i = 0; i < cache.times.size(); ++i) {
        step.advance();
        const auto points = std::span<const glm::vec3>(samples.points).subspan(i * count, count);
        StrandSet strands{
            .ends = ends,
            .points = {points.begin(), points.end()},
            .metres_per_unit = samples.metres_per_unit};
        strands = pickStrands(strands, chosen);
        place(strands, settings.placement);
        strands = resample(std::move(strands), vertices);
        cache.points.insert(cache.points.end(), strands.points.begin(), strands.points.end());
    }
    return cache;
}

Groom fromFile(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& directory,
    std::uint32_t seed, const NamedFileCheck& check) {
    const std::filesystem::path path = directory / settings.file;
    StrandSamples samples = samplesOf(settings, directory, check);
    StrandSet strands = strandsOf(settings, path, check);
    try {
        const std::vector<std::uint32_t> flagged = flaggedGuides(strands);
        const std::vector<std::int32_t> groups = std::move(strands.groups);
        std::vector<std::string> warnings;
        for (const LeftOutStrands& each : strands.left_out)
            warnings.push_back(settings.file + ": " + warningOf(each));
        place(strands, settings.placement);
        Polylines file{strands.ends, strands.points};
        Groom dense = toGroom(std::move(strands), settings.vertices);
        if (mesh) dense.root_normals = rootNormals(dense, *mesh);
        const std::vector<glm::vec3> unstyled = dense.points;
        dense = style(std::move(dense), settings.style, seed, mesh);
        file = drawnStrands(std::move(file), unstyled, dense.points);
        const Strokes strokes = strokesOf(settings, dense, mesh);
        const std::vector<std::uint32_t> chosen = guidesOf(dense, flagged, settings.guides, seed);
        GuideCache cache;
        if (settings.cache.mode != CacheMode::none) {
            if (dense.points != unstyled || !settings.edits.empty())
                throw engine::Error(
                    "is styled by /groom/style or /groom/edits, but /groom/cache has positions "
                    "without styling: use only one of them");
            cache =
                cacheOf(settings, std::move(samples), file.ends, dense.vertices_per_strand, chosen);
        }
        replay(file.ends, file.points, strokes);
        Groom groom = withGuides(replay(std::move(dense), strokes), chosen, mesh);
        groom.warnings = std::move(warnings);
        if (!groups.empty())
            for (const std::uint32_t guide : chosen) groom.guide_groups.push_back(groups[guide]);
        groom.groups = groups;
        dropFlagged(groom, file, flagged);
        groom.cache = std::move(cache);
        groom.bound_ends = std::move(file.ends);
        groom.bound_points = std::move(file.points);
        addFixedFile(groom, settings.fixed, directory, check);
        return groom;
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

}  // namespace

// ---- Expected sizes -----------------------------------------------------------------------------

GroomSize
expectedSize(const GroomSettings& settings, std::uint64_t file_bytes, std::uint64_t cache_bytes) {
    constexpr std::uint64_t kPointBytes = sizeof(glm::vec3);
    const auto or_else = [](std::uint64_t asked, std::uint64_t otherwise) {
        return asked == 0 ? otherwise : asked;
    };
    GroomSize size;
    if (settings.file.empty()) {
        const GrowSettings& grow = settings.grow;
        size.guides = or_else(settings.guides, kThesisGuides);
        size.vertices_per_guide = grow.vertices;
        if (grow.strands > 0) {
            size.guides = std::min<std::uint64_t>(size.guides, grow.strands);
            size.bound_strands =
                grow.strands +
                static_cast<std::uint64_t>(std::llround(double{grow.vellus.share} * grow.strands));
            size.bound_points = size.bound_strands * grow.vertices;
        }
    } else {
        size.bound_points = file_bytes / kPointBytes;
        size.bound_strands =
            size.bound_points / or_else(settings.points_per_strand, kUncountedPoints) + 1;
        size.guides = std::min<std::uint64_t>(
            or_else(settings.guides, size.bound_strands), size.bound_strands);
        size.vertices_per_guide =
            or_else(settings.vertices, or_else(settings.points_per_strand, kUncountedPoints));
    }
    if (settings.cache.mode != CacheMode::none) size.cached_points = cache_bytes / kPointBytes;
    size.root_triangles = 2 * size.guides;  // at most, by Euler's formula of a disc
    size.root_normals = size.guides;
    if (!settings.file.empty()) {
        size.grouped_guides = size.guides;
        size.grouped_strands = size.bound_strands;
    }
    return size;
}

// ---- Guides of strands --------------------------------------------------------------------------

Groom toGroom(StrandSet strands, std::uint32_t vertices) {
    if (strands.ends.empty()) throw engine::Error("there are no strands");
    if (vertices == 0) vertices = std::clamp(greatestSize(strands), 2u, kMostVertices);
    strands.transparencies = {};
    strands.colors = {};
    strands = resample(std::move(strands), vertices);

    Groom groom{
        .strand_count = strands.strandCount(),
        .vertices_per_strand = vertices,
        .points = std::move(strands.points),
        .widths = std::move(strands.widths.values),
        .root_triangles = std::move(strands.root_triangles)};
    if (groom.widths.empty() && strands.widths.everywhere)
        groom.widths.assign(groom.points.size(), *strands.widths.everywhere);
    return groom;
}

// ---- The groom of a scene -----------------------------------------------------------------------

Groom buildGroom(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& directory,
    std::uint32_t seed, const NamedFileCheck& check) {
    if (!settings.file.empty()) return fromFile(settings, mesh, directory, seed, check);
    const std::string path = (directory / settings.grow.mesh).string();
    if (!mesh) throw engine::Error(path, "guides are to be grown, but there is no mesh");
    try {
        const std::uint32_t guides = settings.guides == 0 ? kThesisGuides : settings.guides;
        Groom grown =
            style(grow(*mesh, settings.grow, directory, guides, seed), settings.style, seed, mesh);
        const Strokes strokes = strokesOf(settings, grown, mesh);
        if (settings.grow.strands == 0) return replay(std::move(grown), strokes);
        const std::vector<std::uint32_t> chosen = guidesOf(grown, guides, seed);
        grown = replay(std::move(grown), strokes);
        std::vector<glm::vec3> points = grown.points;
        std::vector<std::uint32_t> ends(grown.strand_count);
        for (std::uint32_t i = 0; i < grown.strand_count; ++i)
            ends[i] = (i + 1) * grown.vertices_per_strand;
        Groom groom = withGuides(std::move(grown), chosen, mesh);
        groom.bound_points = std::move(points);
        groom.bound_ends = std::move(ends);
        addFixed(groom, growVellus(*mesh, settings.grow, seed));
        addFixedFile(groom, settings.fixed, directory, check);
        return groom;
    } catch (const engine::Error& error) {
        throw engine::Error(path, error.what());
    }
}

}  // namespace hair::groom
