#include "hair/groom/style/displace.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/process.h"
#include "hair/groom/groom.h"
#include "hair/random.h"

namespace hair::groom {
namespace {

// ---- Displacement -------------------------------------------------------------------------------

// Moves the points of every strand except its root. `offsets(groom, strand, along)` gives a
// function from a point's index to its displacement. The displacement fades in from 0 at the root
// to its full size at the fraction `start` of the strand's length.
template <class Offsets>
Groom displace(Groom groom, double start, Offsets&& offsets) {
    engine::Step step("styles strands", groom.strand_count);
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        step.advance();
        const AlongStrand along(groom.strand(strand));
        const auto offset = offsets(std::as_const(groom), strand, along);
        glm::vec3* const points =
            groom.points.data() + std::size_t{strand} * groom.vertices_per_strand;
        for (std::uint32_t i = 1; i < groom.vertices_per_strand; ++i) {
            const double share = ease(0.0, start, along.fraction(i));
            points[i] = glm::vec3(glm::dvec3(points[i]) + share * offset(i));
        }
    }
    return groom;
}

// The normal of the scalp at the root of a strand, if it is known.
const glm::vec3* rootNormalOf(const Groom& groom, std::uint32_t strand) {
    return groom.root_normals.empty() ? nullptr : &groom.root_normals[strand];
}

// ---- Frames -------------------------------------------------------------------------------------

constexpr double kParallel = 1e-3;  // sine of the angle below which two directions span no plane

glm::dvec3 perpendicularPart(const glm::dvec3& vector, const glm::dvec3& unit) {
    return vector - glm::dot(vector, unit) * unit;
}

// Returns the tangent at each point: the direction of the chord between its neighbours or, if those
// coincide, of the previous segment.
std::vector<glm::dvec3> tangents(std::span<const glm::vec3> points) {
    std::vector<glm::dvec3> tangents(points.size());
    glm::dvec3 last = rootDirection(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 before(points[i == 0 ? 0 : i - 1]);
        const glm::dvec3 after(points[i + 1 == points.size() ? i : i + 1]);
        const double length = glm::distance(before, after);
        if (length > 0.0) last = (after - before) / length;
        tangents[i] = last;
    }
    return tangents;
}

glm::dvec3 rootNormal(
    std::span<const glm::vec3> points, const glm::dvec3& tangent, const glm::vec3* root_normal) {
    if (root_normal) {
        const glm::dvec3 part = perpendicularPart(glm::dvec3(*root_normal), tangent);
        if (glm::length(part) > kParallel) return glm::normalize(part);
    }
    glm::dvec3 furthest(0.0);
    double reach = 0.0;
    for (const glm::vec3& point : points) {
        const glm::dvec3 from_root = glm::dvec3(point) - glm::dvec3(points.front());
        const glm::dvec3 part = perpendicularPart(from_root, tangent);
        if (glm::length(part) > glm::length(furthest)) furthest = part;
        reach = std::max(reach, glm::length(from_root));
    }
    if (glm::length(furthest) > kParallel * reach) return glm::normalize(furthest);
    return across(tangent);
}

glm::dvec3 reflect(const glm::dvec3& vector, const glm::dvec3& along, double along_squared) {
    return vector - 2.0 / along_squared * glm::dot(along, vector) * along;
}

// Carries the normal from a point to the next.
glm::dvec3
carried(const StrandFrame& frame, const glm::dvec3& step, const glm::dvec3& next_tangent) {
    glm::dvec3 normal = frame.normal;
    glm::dvec3 tangent = frame.tangent;
    if (const double squared = glm::dot(step, step); squared > 0.0) {
        normal = reflect(normal, step, squared);
        tangent = reflect(tangent, step, squared);
    }
    const glm::dvec3 turn = next_tangent - tangent;
    if (const double squared = glm::dot(turn, turn); squared > 1e-20)
        normal = reflect(normal, turn, squared);
    normal = perpendicularPart(normal, next_tangent);  // removes only rounding errors
    const double length = glm::length(normal);
    return length > kParallel ? normal / length : across(next_tangent);
}

// ---- Noise --------------------------------------------------------------------------------------

// A random point of a cube, moved along its ray into the ball.
glm::dvec3 randomInBall(std::uint32_t seed, std::uint32_t purpose, std::uint32_t index) {
    glm::dvec3 point;
    for (std::uint32_t axis = 0; axis < 3; ++axis)
        point[static_cast<int>(axis)] = 2.0 * random01(seed, index, purpose + axis) - 1.0;
    const double length = glm::length(point);
    if (length == 0.0) return point;
    return point * (std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) / length);
}

}  // namespace

// ---- Places along a strand ----------------------------------------------------------------------

AlongStrand::AlongStrand(std::span<const glm::vec3> points) : arcs_(points.size(), 0.0) {
    for (std::size_t i = 1; i < points.size(); ++i)
        arcs_[i] = arcs_[i - 1] + glm::distance(glm::dvec3(points[i - 1]), glm::dvec3(points[i]));
}

// ---- Frames -------------------------------------------------------------------------------------

glm::dvec3 rootDirection(std::span<const glm::vec3> points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 step = glm::dvec3(points[i]) - glm::dvec3(points[i - 1]);
        if (const double length = glm::length(step); length > 0.0) return step / length;
    }
    return {0.0, 0.0, 1.0};
}

glm::dvec3 across(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    glm::dvec3 axis(0.0);
    axis[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1.0;
    return glm::normalize(glm::cross(direction, axis));
}

std::vector<StrandFrame>
strandFrames(std::span<const glm::vec3> points, const glm::vec3* root_normal) {
    assert(!points.empty());
    const std::vector<glm::dvec3> directions = tangents(points);
    std::vector<StrandFrame> frames(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 normal =
            i == 0 ? rootNormal(points, directions.front(), root_normal)
                   : carried(
                         frames[i - 1], glm::dvec3(points[i]) - glm::dvec3(points[i - 1]),
                         directions[i]);
        frames[i] = {directions[i], normal, glm::cross(directions[i], normal)};
    }
    return frames;
}

// ---- Curls, frizz and waves ---------------------------------------------------------------------

namespace {

// The phase at which each strand of a groom starts its turns, and how the phase drifts along it.
class Phases {
public:
    // `phase`, and `drift` with the two numbers after it, are purposes of random numbers.
    template <class Settings>
    Phases(
        const Groom& groom, const Settings& settings, std::uint32_t seed, std::uint32_t phase,
        std::uint32_t drift)
        : variation_(settings.phase_variation), drift_(settings.drift), seed_(seed),
          phase_purpose_(phase), drift_purpose_(drift) {
        if (settings.spacing > 0.0f) centres_ = clumpCentres(groom, settings.spacing, seed);
    }

    // Returns the phase, in turns, after this number of turns.
    double operator()(std::uint32_t strand, double turns) const {
        const std::uint32_t like = centres_.empty() ? strand : centres_[strand];
        double phase = variation_ * random01(seed_, like, phase_purpose_);
        static constexpr double kChanges = 0.5;  // changes of the drift per turn
        if (drift_ != 0.0)
            phase +=
                drift_ *
                smoothNoise(hash(seed_, like, drift_purpose_), drift_purpose_, kChanges * turns).x;
        return phase;
    }

private:
    double variation_, drift_;
    std::uint32_t seed_, phase_purpose_, drift_purpose_;
    std::vector<std::uint32_t> centres_;  // empty: each strand is its own
};

}  // namespace

Groom curl(Groom groom, const CurlSettings& settings, std::uint32_t seed) {
    if (settings.radius == 0.0f) return groom;
    const Phases phases(groom, settings, seed, purpose::curl_phase, purpose::curl_drift);
    return displace(
        std::move(groom), settings.start,
        [&](const Groom& before, std::uint32_t strand, const AlongStrand& along) {
            return [&, strand,
                    frames = strandFrames(before.strand(strand), rootNormalOf(before, strand))](
                       std::uint32_t point) {
                const double turns = settings.frequency * along.arc(point);
                const double angle = 2.0 * std::numbers::pi * (turns + phases(strand, turns));
                return double{settings.radius} * (std::cos(angle) * frames[point].normal +
                                                  std::sin(angle) * frames[point].binormal);
            };
        });
}

glm::dvec3 smoothNoise(std::uint32_t seed, std::uint32_t purpose, double x) {
    const double whole = std::floor(x);
    const auto index = static_cast<std::uint32_t>(std::fmod(whole, 4294967296.0));
    return glm::mix(
        randomInBall(seed, purpose, index), randomInBall(seed, purpose, index + 1),
        ease(0.0, 1.0, x - whole));
}

Groom frizz(Groom groom, const FrizzSettings& settings, std::uint32_t seed) {
    if (settings.amplitude == 0.0f) return groom;
    return displace(
        std::move(groom), settings.start,
        [&](const Groom&, std::uint32_t strand, const AlongStrand& along) {
            return [&, own = hash(seed, strand, purpose::frizz_x)](std::uint32_t point) {
                return double{settings.amplitude} *
                       smoothNoise(own, purpose::frizz_x, settings.frequency * along.arc(point));
            };
        });
}

Groom flyaways(Groom groom, const FlyawaySettings& settings, std::uint32_t seed) {
    if (settings.share == 0.0f || settings.reach == 0.0f) return groom;
    static constexpr double kWays = 1.5;  // changes of direction from root to tip
    return displace(
        std::move(groom), 0.0, [&](const Groom&, std::uint32_t strand, const AlongStrand& along) {
            const bool apart = random01(seed, strand, purpose::flyaway_choice) < settings.share;
            const double reach =
                apart ? double{settings.reach} * random01(seed, strand, purpose::flyaway_reach)
                      : 0.0;
            return [&, reach, own = hash(seed, strand, purpose::flyaway_x)](std::uint32_t point) {
                if (reach == 0.0) return glm::dvec3(0.0);
                const double fraction = along.fraction(point);
                return reach * ease(settings.start, 1.0, fraction) *
                       smoothNoise(own, purpose::flyaway_x, kWays * fraction);
            };
        });
}

Groom wave(Groom groom, const WaveSettings& settings, std::uint32_t seed) {
    if (settings.amplitude == 0.0f) return groom;
    const Phases phases(groom, settings, seed, purpose::wave_phase, purpose::wave_drift);
    return displace(
        std::move(groom), settings.start,
        [&](const Groom& before, std::uint32_t strand, const AlongStrand& along) {
            return [&, strand,
                    frames = strandFrames(before.strand(strand), rootNormalOf(before, strand))](
                       std::uint32_t point) {
                const double waves = settings.frequency * along.arc(point);
                const double angle = 2.0 * std::numbers::pi * (waves + phases(strand, waves));
                return settings.amplitude * std::sin(angle) * frames[point].normal;
            };
        });
}

// ---- Clumps -------------------------------------------------------------------------------------

namespace {

// Centre strands by the place of their root, in cells as wide as the distance between centres.
class Centres {
public:
    Centres(const Groom& groom, double spacing) : groom_(groom), spacing_(spacing) {}

    void add(std::uint32_t strand) { cells_[cell(strand)].push_back(strand); }

    // The centre nearest to a strand's root, if one is nearer than the spacing.
    std::optional<std::uint32_t> nearest(std::uint32_t strand) const {
        std::optional<std::uint32_t> found;
        double least = spacing_;
        const Cell home = cell(strand);
        for (int neighbour = 0; neighbour < 27; ++neighbour) {
            const auto at = cells_.find(
                {home.x + neighbour % 3 - 1, home.y + neighbour / 3 % 3 - 1,
                 home.z + neighbour / 9 - 1});
            if (at == cells_.end()) continue;
            for (const std::uint32_t centre : at->second) {
                const double distance = glm::distance(root(centre), root(strand));
                if (distance >= least) continue;
                least = distance;
                found = centre;
            }
        }
        return found;
    }

private:
    struct Cell {
        int x, y, z;
        friend bool operator==(const Cell&, const Cell&) = default;
    };
    struct CellHash {
        std::size_t operator()(const Cell& cell) const {
            return hash(
                static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                static_cast<std::uint32_t>(cell.z));
        }
    };

    glm::dvec3 root(std::uint32_t strand) const { return groom_.strand(strand).front(); }

    Cell cell(std::uint32_t strand) const {
        static constexpr double kLimit = 1e9;  // points farther out share the last cell
        const glm::dvec3 place = glm::floor(root(strand) / spacing_);
        const auto whole = [](double x) {
            return static_cast<int>(std::clamp(x, -kLimit, kLimit));
        };
        return {whole(place.x), whole(place.y), whole(place.z)};
    }

    const Groom& groom_;
    double spacing_;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

}  // namespace

std::vector<std::uint32_t> clumpCentres(const Groom& groom, double spacing, std::uint32_t seed) {
    std::vector<std::uint32_t> order(groom.strand_count);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [seed](std::uint32_t strand) {
        return std::pair(hash(seed, strand, purpose::clump_centre), strand);
    });
    Centres centres(groom, spacing);
    engine::Step step("finds clumps", 2 * std::uint64_t{groom.strand_count});
    for (const std::uint32_t strand : order) {
        step.advance();
        if (!centres.nearest(strand)) centres.add(strand);
    }
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) {
        step.advance();
        order[i] = centres.nearest(i).value();
    }
    return order;
}

}  // namespace hair::groom
