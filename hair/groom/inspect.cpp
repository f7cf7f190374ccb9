#include "hair/groom/inspect.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <sstream>
#include <utility>
#include <variant>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/depth.h"
#include "hair/groom/mesh/surface.h"

namespace hair::groom {
namespace {

// Fewer strands say neither how far apart hair is nor how large a scalp is.
constexpr std::uint32_t kFewest = 20;

// ---- Duplicates ---------------------------------------------------------------------------------

// Rounds of multiply and shift with the constants of MurmurHash3's finalizer (Appleby 2011).
std::uint64_t hashOf(std::span<const glm::vec3> points) {
    std::uint64_t hash = points.size();
    const auto add = [&](float value) {
        hash ^= std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 equals 0
        hash *= 0xff51afd7ed558ccd;
        hash ^= hash >> 33;
    };
    for (const glm::vec3& point : points) {
        add(point.x);
        add(point.y);
        add(point.z);
    }
    return hash;
}

struct Entry {
    std::uint64_t hash;
    std::uint32_t row;
    auto operator<=>(const Entry&) const = default;
};

// Returns those of `count` rows of points that are equal to an earlier row. Takes 16 bytes for each
// row.
std::vector<std::uint32_t> findDuplicates(
    std::uint32_t count, const std::function<std::span<const glm::vec3>(std::uint32_t)>& row) {
    std::vector<Entry> entries;
    entries.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) entries.push_back({hashOf(row(i)), i});
    std::ranges::sort(entries);

    std::vector<std::uint32_t> duplicates;
    std::vector<std::uint32_t> unlike;  // different rows of one hash: almost always one
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (i == 0 || entries[i].hash != entries[i - 1].hash) unlike.clear();
        const auto points = row(entries[i].row);
        const auto equals = [&](std::uint32_t other) {
            return std::ranges::equal(points, row(other));
        };
        if (std::ranges::any_of(unlike, equals)) {
            duplicates.push_back(entries[i].row);
        } else {
            unlike.push_back(entries[i].row);
        }
    }
    return duplicates;
}

// ---- Units --------------------------------------------------------------------------------------

struct Known {
    const char* name;
    double metres;
};

constexpr std::array kKnown{
    Known{"m", 1.0}, Known{"cm", 0.01}, Known{"mm", 0.001}, Known{"inch", 0.0254}};

// Heads are about 0.15 m wide and 0.2 m long, and hair is 0.01 m to 1 m long. The scatter is a
// factor: with 1.5, the extent of a part of a scalp or of a bearded head is still likely, and an
// inch is well apart from a centimetre.
constexpr double kRootExtent = 0.2;
constexpr double kRootScatter = 1.5;
constexpr double kLength = 0.1;
constexpr double kLengthScatter = 10.0;

// Squared deviation of a size from the expected one, in units of the scatter.
double deviation(double size, double expected, double scatter) {
    const double off = size > 0.0 ? std::log(size / expected) / std::log(scatter) : 0.0;
    return off * off;
}

// Above this certainty, a guess that contradicts a statement is worth a warning.
constexpr double kClear = 0.9;

// Guesses the unit of human hair in which the extent of the roots is closest to a scalp's and the
// median length is that of hair. A size of 0 is ignored. Deviations count as those of a logarithmic
// normal distribution. A stated unit competes with the known ones.
UnitGuess guessUnit(double root_extent, double median_length, std::optional<double> stated) {
    const auto deviationIn = [&](double metres) {
        return deviation(root_extent * metres, kRootExtent, kRootScatter) +
               deviation(median_length * metres, kLength, kLengthScatter);
    };
    const Known* best = &*std::ranges::min_element(
        kKnown, {}, [&](const Known& known) { return deviationIn(known.metres); });
    const double least = deviationIn(best->metres);
    double sum = 0.0;  // of likelihoods, relative to that of the best
    bool is_known = false;
    for (const Known& known : kKnown) {
        sum += std::exp(0.5 * (least - deviationIn(known.metres)));
        is_known = is_known || (stated && std::abs(*stated / known.metres - 1.0) < 1e-6);
    }
    if (stated && !is_known) sum += std::exp(0.5 * (least - deviationIn(*stated)));
    std::ostringstream reason;
    reason.precision(3);
    reason << "The file doesn't state it";
    if (root_extent <= 0.0 && median_length <= 0.0) {
        reason << ", and nothing in it has a length to guess from.";
    } else {
        reason << "; in " << best->name << " ";
        if (root_extent > 0.0)
            reason << "the roots span " << root_extent * best->metres << " m (a head: about "
                   << kRootExtent << " m)";
        if (root_extent > 0.0 && median_length > 0.0) reason << " and ";
        if (median_length > 0.0)
            reason << "the median strand is " << median_length * best->metres
                   << " m long (hair: 0.01 m to 1 m)";
        reason << ", which fits best of m, cm, mm and inch.";
    }
    return {.unit = {best->name, best->metres, reason.str()}, .certainty = 1.0 / sum};
}

// ---- Strands on a mesh --------------------------------------------------------------------------

void inspectInside(const StrandSet& strands, BodyMesh mesh, double scale, MeshFindings& findings) {
    findings.closed = std::holds_alternative<ClosedMesh>(mesh);
    if (!findings.closed) findings.not_closed = std::get<OpenMesh>(mesh).reason;
    DepthInside depthOf(std::move(mesh));
    std::uint32_t strands_inside = 0;
    std::size_t points_inside = 0;
    double deepest = 0.0;
    engine::Step step("finds strands inside the mesh", strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        step.advance();
        std::size_t inside = 0;
        for (const glm::vec3& point : strands.strand(i)) {
            const double depth = depthOf(glm::dvec3(point) * scale);
            deepest = std::max(deepest, depth);
            if (depth > kSurfaceTolerance) ++inside;
        }
        points_inside += inside;
        if (inside > 0) ++strands_inside;
    }
    findings.strands_inside = strands_inside;
    findings.points_inside = points_inside;
    findings.deepest = deepest;
}

// The mesh is in metres and has at least one triangle.
MeshFindings inspectOnMesh(const StrandSet& strands, const Mesh& mesh, double metres_per_unit) {
    MeshFindings findings{.tolerance = kSurfaceTolerance, .warnings = mesh.warnings};
    const NearestSurface surface(mesh.positions, mesh.triangles);
    std::vector<float> distances;
    distances.reserve(strands.strandCount());
    engine::Step step("finds roots on the mesh", strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        step.advance();
        const glm::dvec3 root = glm::dvec3(strands.strand(i)[0]) * metres_per_unit;
        const double distance = surface(root).distance;
        if (distance > kSurfaceTolerance) ++findings.roots_off_surface;
        distances.push_back(static_cast<float>(distance));
    }
    findings.root_distances = summaryOf(distances);
    if (2 * findings.roots_off_surface > strands.strandCount())
        for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
            if (surface(glm::dvec3(strands.strand(i).back()) * metres_per_unit).distance <=
                kSurfaceTolerance)
                ++findings.tips_on_surface;
    try {
        inspectInside(strands, bodyMesh(mesh), metres_per_unit, findings);
    } catch (const engine::Error& error) {
        findings.not_closed = error.what();
    }
    return findings;
}

// ---- Sizes --------------------------------------------------------------------------------------

void inspectSizes(const StrandSet& strands, StrandFindings& findings) {
    std::vector<float> sizes;
    sizes.reserve(strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        sizes.push_back(static_cast<float>(strands.size(i)));
        if (strands.size(i) == 1) ++findings.single_point_strands;
    }
    findings.points_per_strand = summaryOf(sizes);
}

void inspectLengths(const StrandSet& strands, StrandFindings& findings) {
    std::vector<float> lengths;
    std::vector<float> segments;
    lengths.reserve(strands.strandCount());
    segments.reserve(strands.points.size() - strands.strandCount());
    engine::Step step("measures strands", strands.strandCount());
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        step.advance();
        const auto points = strands.strand(i);
        double length = 0.0;
        for (std::size_t k = 1; k < points.size(); ++k) {
            const double segment = glm::distance(glm::dvec3(points[k - 1]), glm::dvec3(points[k]));
            if (segment == 0.0) ++findings.zero_length_segments;
            segments.push_back(static_cast<float>(segment));
            length += segment;
        }
        if (points.size() > 1 && length == 0.0) ++findings.zero_length_strands;
        lengths.push_back(static_cast<float>(length));
    }
    findings.lengths = summaryOf(lengths);
    findings.segment_lengths = summaryOf(segments);
}

void inspectBox(
    const StrandSet& strands, std::span<const std::uint32_t> kept, StrandFindings& findings) {
    if (kept.empty()) return;
    findings.minimum = findings.maximum = strands.strand(kept.front())[0];
    for (const std::uint32_t i : kept)
        for (const glm::vec3& point : strands.strand(i)) {
            findings.minimum = glm::min(findings.minimum, point);
            findings.maximum = glm::max(findings.maximum, point);
        }
}

void inspectWidths(const StrandSet& strands, StrandFindings& findings) {
    std::vector<float> widths = strands.widths.values;
    if (widths.empty() && strands.widths.everywhere) widths = {*strands.widths.everywhere};
    findings.widths = summaryOf(widths);
}

// Returns the greatest side of the bounding box of some strands' roots.
double rootExtent(const StrandSet& strands, std::span<const std::uint32_t> kept) {
    if (kept.empty()) return 0.0;
    glm::vec3 low = strands.points[strands.first(kept.front())];
    glm::vec3 high = low;
    for (const std::uint32_t i : kept) {
        low = glm::min(low, strands.points[strands.first(i)]);
        high = glm::max(high, strands.points[strands.first(i)]);
    }
    const glm::dvec3 size = glm::dvec3(high) - glm::dvec3(low);
    return std::max({size.x, size.y, size.z});
}

}  // namespace

// ---- Units --------------------------------------------------------------------------------------

Unit statedUnit(double metres) {
    for (const Known& known : kKnown)
        if (std::abs(metres / known.metres - 1.0) < 1e-6)
            return {known.name, metres, "The file states it."};
    std::ostringstream name;
    name << metres << " m";
    return {name.str(), metres, "The file states it."};
}

double metresOf(std::string_view unit) {
    for (const Known& known : kKnown)
        if (unit == known.name) return known.metres;
    throw engine::Error("unknown unit '" + std::string(unit) + "'; known: m, cm, mm, inch");
}

// ---- Strays -------------------------------------------------------------------------------------

std::vector<Stray> findStrays(const StrandSet& strands) {
    constexpr double kWithin = 0.95;
    constexpr double kApart = 4.0;
    const std::uint32_t count = strands.strandCount();
    if (count < kFewest) return {};
    glm::dvec3 middle(0.0);
    std::vector<float> numbers(count);
    for (int axis = 0; axis < 3; ++axis) {
        for (std::uint32_t i = 0; i < count; ++i)
            numbers[i] = strands.points[strands.first(i)][axis];
        middle[axis] = quantileOf(numbers, 0.5);
    }
    std::vector<float> distances(count);
    std::vector<float> longest(count);
    std::vector<float> lengths(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto points = strands.strand(i);
        distances[i] = static_cast<float>(glm::distance(glm::dvec3(points[0]), middle));
        for (std::size_t k = 1; k < points.size(); ++k) {
            const float segment = glm::distance(points[k - 1], points[k]);
            longest[i] = std::max(longest[i], segment);
            lengths[i] += segment;
        }
    }
    const auto within = [&](const std::vector<float>& values) {
        numbers = values;
        return quantileOf(numbers, kWithin);
    };
    // Roots that lie in one place, such as a tuft's, are no closer than the hair is long.
    const double farthest = std::max(kApart * within(distances), within(lengths));
    const double most = kApart * within(longest);
    std::vector<Stray> strays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool by_root = distances[i] > farthest;
        if (by_root || longest[i] > most)
            strays.push_back({i, by_root, double{by_root ? distances[i] : longest[i]}});
    }
    std::ranges::stable_sort(strays, std::ranges::greater(), &Stray::distance);
    return strays;
}

std::vector<std::uint32_t> strandsBut(const StrandSet& strands, const std::vector<Stray>& strays) {
    std::vector<bool> is_stray(strands.strandCount(), false);
    for (const Stray& stray : strays) is_stray[stray.strand] = true;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        if (!is_stray[i]) kept.push_back(i);
    return kept;
}

// ---- Spreads ------------------------------------------------------------------------------------

double quantileOf(std::span<float> numbers, double share) {
    const double rank = share * static_cast<double>(numbers.size() - 1);
    const auto below = numbers.begin() + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(numbers, below);
    const double fraction = rank - std::floor(rank);
    if (fraction == 0.0) return double{*below};
    return std::lerp(double{*below}, double{*std::min_element(below + 1, numbers.end())}, fraction);
}

Summary summaryOf(std::vector<float>& numbers) {
    if (numbers.empty()) return {};
    const auto quantile = [&](double share) { return quantileOf(numbers, share); };
    return {
        .minimum = quantile(0.0),
        .quartile1 = quantile(0.25),
        .median = quantile(0.5),
        .quartile3 = quantile(0.75),
        .maximum = quantile(1.0),
        .mean = std::accumulate(numbers.begin(), numbers.end(), 0.0) /
                static_cast<double>(numbers.size())};
}

// ---- Lengths ------------------------------------------------------------------------------------

double arcLength(std::span<const glm::vec3> points) {
    double length = 0.0;
    for (std::size_t k = 1; k < points.size(); ++k)
        length += glm::distance(glm::dvec3(points[k - 1]), glm::dvec3(points[k]));
    return length;
}

// ---- Duplicate strands --------------------------------------------------------------------------

std::vector<std::uint32_t> duplicateStrands(const StrandSet& strands) {
    std::vector<std::uint32_t> duplicates =
        findDuplicates(strands.strandCount(), [&](std::uint32_t i) { return strands.strand(i); });
    std::ranges::sort(duplicates);
    return duplicates;
}

// ---- Findings -----------------------------------------------------------------------------------

StrandFindings
inspect(const StrandSet& strands, const Mesh* mesh, std::optional<double> metres_per_unit) {
    StrandFindings findings{.strands = strands.strandCount(), .points = strands.points.size()};
    inspectSizes(strands, findings);
    inspectLengths(strands, findings);
    findings.strays = findStrays(strands);
    const std::vector<std::uint32_t> kept = strandsBut(strands, findings.strays);
    inspectBox(strands, kept, findings);
    inspectWidths(strands, findings);
    findings.duplicate_strands = static_cast<std::uint32_t>(duplicateStrands(strands).size());
    findings.duplicate_roots =
        static_cast<std::uint32_t>(findDuplicates(strands.strandCount(), [&](std::uint32_t i) {
                                       return strands.strand(i).first(1);
                                   }).size());

    const UnitGuess guess =
        guessUnit(rootExtent(strands, kept), findings.lengths.median, strands.metres_per_unit);
    const Unit unit = strands.metres_per_unit ? statedUnit(*strands.metres_per_unit) : guess.unit;
    if (strands.metres_per_unit && guess.certainty >= kClear && kept.size() >= kFewest &&
        std::abs(guess.unit.metres / unit.metres - 1.0) >= 1e-6)
        findings.other_unit = guess;
    findings.unit = unit.name;
    findings.unit_stated = strands.metres_per_unit.has_value();
    findings.metres_per_unit = unit.metres;
    findings.unit_reason = unit.reason;
    if (mesh)
        findings.mesh =
            inspectOnMesh(strands, *mesh, metres_per_unit.value_or(findings.metres_per_unit));
    return findings;
}

}  // namespace hair::groom
