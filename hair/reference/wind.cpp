#include "hair/reference/wind.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "hair/random.h"

namespace hair::reference {

// ---- Wind ---------------------------------------------------------------------------------------

namespace {

// A value and its gradient.
struct Dual {
    double value = 0.0;
    glm::dvec3 gradient{0.0};
};

Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.gradient + b.gradient};
}

Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.gradient - b.gradient};
}

Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
}

Dual constant(double value) { return {value, glm::dvec3(0.0)}; }

Dual absolute(const Dual& a) { return a.value < 0.0 ? constant(0.0) - a : a; }

Dual fade(const Dual& t) {
    const Dual cube = t * t * t;
    return constant(6.0) * t * t * cube - constant(15.0) * t * cube + constant(10.0) * cube;
}

std::uint32_t lattice(double whole) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(whole));
}

glm::dvec3 latticeGradient(const glm::dvec3& node, std::uint32_t seed, std::uint32_t component) {
    const std::uint32_t column = hash(seed, lattice(node.x), lattice(node.y));
    const std::uint32_t bits = hash(column, lattice(node.z), component);
    glm::dvec3 gradient{0.0};
    for (int axis = 0; axis < 3; ++axis)
        gradient[axis] = ((bits / (4u << (10 * axis)) % 1024u) * 2.0 + 1.0) / 1024.0 - 1.0;
    return gradient;
}

constexpr double kFolded = 1e-3;

glm::dvec3 unit(const glm::dvec3& edge) {
    return glm::length(edge) < kShortest ? glm::dvec3(0.0) : glm::normalize(edge);
}

}  // namespace

// ---- Turbulence ---------------------------------------------------------------------------------

glm::dvec3 curlNoise(const glm::dvec3& point, std::uint32_t seed) {
    std::array<Dual, 3> potential;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 node = glm::floor(point) + glm::dvec3(i / 4, i / 2 % 2, i % 2);
        std::array<Dual, 3> d;
        Dual weight = constant(1.0);
        for (int axis = 0; axis < 3; ++axis) {
            Dual& along = d[static_cast<std::size_t>(axis)];
            along.value = point[axis] - node[axis];
            along.gradient[axis] = 1.0;
            weight = weight * (constant(1.0) - fade(absolute(along)));
        }
        for (std::uint32_t r = 0; r < 3; ++r) {
            const glm::dvec3 g = latticeGradient(node, seed, r);
            const Dual slope = constant(g.x) * d[0] + constant(g.y) * d[1] + constant(g.z) * d[2];
            potential[r] = potential[r] + weight * slope;
        }
    }
    const glm::dvec3 curl{
        potential[2].gradient.y - potential[1].gradient.z,
        potential[0].gradient.z - potential[2].gradient.x,
        potential[1].gradient.x - potential[0].gradient.y};
    // The mean square of a component over the cell, an integral of polynomials.
    return curl / std::sqrt(238536280.0 / 480729249.0);
}

glm::dvec3 turbulence(const glm::dvec3& point, std::uint32_t octaves, std::uint32_t seed) {
    constexpr std::uint32_t kPurpose = 0x54555242;  // kTurbulencePurpose of the GPU
    glm::dvec3 sum{0.0};
    double squares = 0.0;
    for (std::uint32_t i = 0; i < octaves; ++i) {
        const double finer = std::exp2(i);
        const glm::dvec3 at = finer * point + (finer - 1.0) * glm::dvec3(0.37, 0.61, 0.23);
        const double amplitude = std::pow(finer, -1.0 / 3.0);
        sum += amplitude * curlNoise(at, hash(seed, i, kPurpose));
        squares += amplitude * amplitude;
    }
    return sum / std::sqrt(squares);
}

// ---- Wind and drag ------------------------------------------------------------------------------

std::array<double, 4> windWeights(std::uint32_t seed, std::uint32_t strand) {
    constexpr std::uint32_t kPurpose = 0x57494e44;  // kWindWeightPurpose of the GPU
    std::array<double, 4> weights{};
    double sum = 0.0;
    for (std::uint32_t i = 0; i < 4; ++i) {
        weights[i] = double{random01(seed, strand, kPurpose + i)};
        sum += weights[i];
    }
    for (double& w : weights) w = sum > 0.0 ? w / sum : 0.25;
    return weights;
}

glm::dvec3 strandWind(const WindSettings& settings, const std::array<double, 4>& weights) {
    if (settings.strength == 0.0f) return glm::dvec3(0.0);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(settings.direction));
    const glm::dvec3 u = sideways(direction);
    const glm::dvec3 v = glm::cross(direction, u);
    const double angle = double{settings.cone_angle} * std::numbers::pi / 180.0;
    glm::dvec3 wind{0.0};
    for (int i = 0; i < 4; ++i) {
        const double turned = i * std::numbers::pi / 2.0;
        const glm::dvec3 radial = std::cos(turned) * u + std::sin(turned) * v;
        wind += weights[static_cast<std::size_t>(i)] *
                (std::cos(angle) * direction + std::sin(angle) * radial);
    }
    return double{settings.strength} * wind;
}

std::vector<glm::dvec3>
windAccelerations(ConstPoints positions, const glm::dvec3& wind, double magnitude) {
    std::vector<glm::dvec3> accelerations(positions.size(), glm::dvec3(0.0));
    for (std::size_t i = 1; i < positions.size(); ++i) {
        const glm::dvec3 edge = positions[i] - positions[i - 1];
        if (glm::length(edge) < kShortest) continue;
        const glm::dvec3 t = glm::normalize(edge);
        accelerations[i] = magnitude * glm::cross(glm::cross(t, wind), t);
    }
    return accelerations;
}

glm::dvec3 airVelocity(
    const WindSettings& settings, std::uint32_t seed, const glm::dvec3& point, double time) {
    const double speed = settings.speed;
    if (speed == 0.0) return glm::dvec3(0.0);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(settings.direction));
    const glm::dvec3 carried = point - speed * time * direction;
    const glm::dvec3 w =
        turbulence(carried / double{settings.turbulence_scale}, settings.turbulence_octaves, seed);
    return speed * (direction + double{settings.turbulence} * w);
}

double
dragAcceleration(const WindSettings& settings, const MaterialSettings& material, double speed) {
    const double density = settings.air_density;
    const double radius = material.radius;
    if (speed == 0.0 || density == 0.0) return 0.0;
    const double reynolds = density * speed * 2.0 * radius / double{settings.air_viscosity};
    const double coefficient = 1.0 + 10.0 / std::pow(reynolds, 2.0 / 3.0);
    const double force = density / 2.0 * coefficient * 2.0 * radius * speed * speed;  // N/m
    return force / (wetDensity(material) * std::numbers::pi * radius * radius);
}

std::vector<glm::dvec3> tangentsBetween(ConstPoints directions) {
    std::vector<glm::dvec3> tangents{glm::dvec3(0.0)};
    for (std::size_t i = 1; i < directions.size(); ++i) {
        const glm::dvec3 below = i + 1 < directions.size() ? directions[i + 1] : glm::dvec3(0.0);
        const glm::dvec3 sum = directions[i] + below;
        tangents.push_back(glm::length(sum) < kFolded ? directions[i] : glm::normalize(sum));
    }
    return tangents;
}

std::vector<glm::dvec3> tangentsAt(ConstPoints positions) {
    std::vector<glm::dvec3> directions{glm::dvec3(0.0)};
    for (std::size_t i = 1; i < positions.size(); ++i)
        directions.push_back(unit(positions[i] - positions[i - 1]));
    return tangentsBetween(directions);
}

std::vector<glm::dmat3> dragRates(
    ConstPoints tangents, ConstPoints velocities, ConstPoints air,
    const SimulationSettings& settings) {
    std::vector<glm::dmat3> rates(tangents.size(), glm::dmat3(0.0));
    for (std::size_t i = 1; i < tangents.size(); ++i) {
        const glm::dvec3& t = tangents[i];
        if (t == glm::dvec3(0.0)) continue;
        const double speed = glm::length(glm::cross(t, air[i] - velocities[i]));
        if (speed == 0.0) continue;
        const double k = dragAcceleration(settings.wind, settings.material, speed) / speed;
        rates[i] = k * (glm::dmat3(1.0) - glm::outerProduct(t, t));
    }
    return rates;
}

std::vector<glm::dvec3> alongAccelerations(
    ConstPoints positions, ConstPoints velocities, ConstPoints air,
    const SimulationSettings& settings, double step) {
    const double radius = settings.material.radius;
    const double line = std::numbers::pi * radius * radius * wetDensity(settings.material);
    const double rate = std::min(
        double{settings.wind.drag_along} * double{settings.wind.air_viscosity} / line, 1.0 / step);
    std::vector<glm::dvec3> accelerations;
    const std::vector<glm::dvec3> tangents = tangentsAt(positions);
    for (std::size_t i = 0; i < tangents.size(); ++i)
        accelerations.push_back(rate * glm::dot(tangents[i], air[i] - velocities[i]) * tangents[i]);
    return accelerations;
}

Air airAt(
    ConstPoints positions, const SimulationSettings& settings, std::uint32_t seed,
    std::uint32_t strand, double time) {
    Air air;
    if (settings.wind.mode == WindMode::drag) {
        air.accelerations.assign(positions.size(), glm::dvec3(0.0));
        for (const glm::dvec3& point : positions)
            air.velocities.push_back(airVelocity(settings.wind, seed, point, time));
        return air;
    }
    const double wave = std::sin(double{settings.wind.gust_rate} * time);
    air.accelerations = windAccelerations(
        positions, strandWind(settings.wind, windWeights(seed, strand)), wave * wave + 0.5);
    return air;
}

// ---- Hair on hair -------------------------------------------------------------------------------

namespace {

// Twice the position of a cell's centre, cells: three odd numbers in the first grid, three even
// ones in the second.
using Cell = std::array<int, 3>;

struct Sum {
    double share = 0.0;
    glm::dvec3 momentum{0.0};
    double away = 0.0;  // share times the distance from the mean, m/s, by addSpreads()
    double away_squared = 0.0;
};

using Grid = std::map<Cell, Sum>;

struct Box {
    glm::dvec3 corner;
    double cell;
    double side;  // cells
};

double lengthBetween(std::span<const glm::dvec3> points, std::size_t first, std::size_t last) {
    double length = 0.0;
    for (std::size_t i = first; i < last; ++i) length += glm::length(points[i + 1] - points[i]);
    return length;
}

// Returns the cube of the roots plus 1.1 of the longest strand on every side, two cells inside the
// grid.
Box boxOf(const VolumeState& state, std::uint32_t resolution) {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    double longest = 0.0;
    for (std::size_t root = 0; root < state.rest.size(); root += state.vertices) {
        low = glm::min(low, state.rest[root]);
        high = glm::max(high, state.rest[root]);
        longest = std::max(longest, lengthBetween(state.rest, root, root + state.vertices - 1));
    }
    const glm::dvec3 roots = high - low;
    const double width =
        std::max(roots.x, std::max(roots.y, roots.z)) + 2.0 * std::max(1.1 * longest, 0.001);
    const double cell = width / (resolution - 4.0);
    return {(low + high) / 2.0 - resolution * cell / 2.0, cell, double(resolution)};
}

std::vector<double> sharesOf(const VolumeState& state) {
    std::vector<double> lengths;
    double sum = 0.0;
    for (std::size_t root = 0; root < state.rest.size(); root += state.vertices) {
        const std::size_t tip = root + state.vertices - 1;
        for (std::size_t i = root; i <= tip; ++i) {
            lengths.push_back(
                lengthBetween(state.rest, i == root ? i : i - 1, i == tip ? i : i + 1));
            sum += lengths.back();
        }
    }
    for (double& length : lengths)
        length = sum > 0.0 ? length / sum : 1.0 / static_cast<double>(lengths.size());
    return lengths;
}

// The quadratic B-spline as a difference of truncated powers.
double spline(double t) {
    const auto power = [](double x) { return x > 0.0 ? x * x : 0.0; };
    return (power(t + 1.5) - 3.0 * power(t + 0.5) + 3.0 * power(t - 0.5) - power(t - 1.5)) / 2.0;
}

// The slope of spline(): a difference of linear B-splines.
double splineSlope(double t) {
    const auto hat = [](double x) { return std::max(1.0 - std::abs(x), 0.0); };
    return hat(t + 0.5) - hat(t - 0.5);
}

glm::dvec3 offset(const Cell& cell, const glm::dvec3& point) {
    return point - 0.5 * glm::dvec3(cell[0], cell[1], cell[2]);
}

double weight(const Cell& cell, const glm::dvec3& point) {
    const glm::dvec3 t = offset(cell, point);
    return spline(t.x) * spline(t.y) * spline(t.z);
}

glm::dvec3 weightGradient(const Cell& cell, const glm::dvec3& point) {
    const glm::dvec3 t = offset(cell, point);
    return {
        splineSlope(t.x) * spline(t.y) * spline(t.z), spline(t.x) * splineSlope(t.y) * spline(t.z),
        spline(t.x) * spline(t.y) * splineSlope(t.z)};
}

// Returns the cells of both grids with centres within one and a half cells of the point.
std::vector<Cell> cellsRound(const glm::dvec3& point) {
    std::vector<Cell> cells;
    for (const int parity : {1, 0}) {
        const auto nearest = [&](double along) {
            return parity == 1 ? 2 * int(std::floor(along)) + 1 : 2 * int(std::floor(along + 0.5));
        };
        for (const int x : {-2, 0, 2})
            for (const int y : {-2, 0, 2})
                for (const int z : {-2, 0, 2})
                    cells.push_back(
                        {nearest(point.x) + x, nearest(point.y) + y, nearest(point.z) + z});
    }
    return cells;
}

Grid splat(
    std::span<const glm::dvec3> points, std::span<const glm::dvec3> velocities,
    std::span<const double> shares) {
    Grid grid;
    for (std::size_t p = 0; p < points.size(); ++p)
        for (const Cell& cell : cellsRound(points[p])) {
            const double part = weight(cell, points[p]) * shares[p];
            grid[cell].share += part;
            grid[cell].momentum += part * velocities[p];
        }
    return grid;
}

void addSpreads(
    Grid& grid, std::span<const glm::dvec3> points, std::span<const glm::dvec3> velocities,
    std::span<const double> shares) {
    for (std::size_t p = 0; p < points.size(); ++p)
        for (const Cell& cell : cellsRound(points[p])) {
            Sum& sum = grid[cell];
            if (sum.share <= 0.0) continue;
            const double away = glm::distance(velocities[p], sum.momentum / sum.share);
            const double part = weight(cell, points[p]) * shares[p];
            sum.away += part * away;
            sum.away_squared += part * away * away;
        }
}

Sum at(const Grid& grid, const Cell& cell) {
    const auto found = grid.find(cell);
    return found == grid.end() ? Sum{} : found->second;
}

double meanDensityAtRest(
    std::span<const glm::dvec3> rest, const Box& box, std::span<const double> shares) {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& point : rest) points.push_back((point - box.corner) / box.cell);
    const Grid grid = splat(points, std::vector<glm::dvec3>(points.size()), shares);
    double both = 0.0;  // sum of m_i^2: each vertex's share weights its gathered density
    for (const auto& [cell, sum] : grid) both += sum.share * sum.share;
    return both / 2.0;
}

// Returns the vertices at the end of the step, in cells.
std::vector<glm::dvec3>
pointsInCells(const VolumeState& state, const Box& box, ConstPoints velocities) {
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
        const glm::dvec3 later = state.positions[i] + state.step.whole * velocities[i];
        const glm::dvec3 on_head =
            glm::inverse(state.frame.rotation) * (later - state.frame.translation);
        points.push_back(glm::clamp((on_head - box.corner) / box.cell, 2.0, box.side - 2.001));
    }
    return points;
}

// Returns the length of the ray from `point` in the cube of side 1 round `centre`.
double
lengthInside(const glm::dvec3& point, const glm::dvec3& direction, const glm::dvec3& centre) {
    double first = 0.0;
    double last = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
        const double away = centre[axis] - point[axis];
        if (std::abs(direction[axis]) < 1e-12) {
            if (std::abs(away) > 0.5) return 0.0;
            continue;
        }
        const double a = (away - 0.5) / direction[axis];
        const double b = (away + 0.5) / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return std::max(last - first, 0.0);
}

// Returns the length of all strands at rest, m.
double lengthOf(const VolumeState& state) {
    double length = 0.0;
    for (std::size_t root = 0; root < state.rest.size(); root += state.vertices)
        length += lengthBetween(state.rest, root, root + state.vertices - 1);
    return length;
}

// Hair that sticks up to a yield stress. Returns the elastic displacement in a step, m/s, without
// flow in this step, and the potential, both in the head's axes.
struct Elastic {
    std::vector<glm::dvec3> displacements;
    std::vector<glm::dvec3> potentials;
};

Elastic elasticAt(const VolumeState& state) {
    const auto onHead = [](const simulation::RigidMotion& frame, const glm::dvec3& point) {
        return glm::inverse(frame.rotation) * (point - frame.translation);
    };
    const std::vector<glm::dvec3> velocities = state.velocities();
    Elastic elastic;
    for (std::size_t i = 0; i < velocities.size(); ++i) {
        const glm::dvec3 later = state.positions[i] + state.step.whole * velocities[i];
        const glm::dvec3 velocity =
            (onHead(state.frame, later) - onHead(state.frame_before, state.positions[i])) /
            state.step.whole;
        const bool known = state.kept != nullptr && !state.kept->empty();
        elastic.displacements.push_back(known ? (*state.kept)[i] + velocity : glm::dvec3(0.0));
        elastic.potentials.push_back(elastic.displacements.back() + velocity);
    }
    return elastic;
}

// Returns phi of a cell: its yield stress over the density, m^2/s^2, transmits a jump of the
// potential that is a mean of what a slip surface and an even slope need. `speed`: cells per step.
double heldPart(const Sum& sum, double strength, double speed) {
    if (sum.away <= 0.0) return 1.0;
    const double mean = sum.away / sum.share;
    const double jump = std::max(2.0 * sum.away_squared / sum.away, 2.0 * mean);
    const double yield = 0.5 * (840.0 / 239.0 + 64.0 / 13.0) * strength / speed;
    return std::min(1.0, yield / jump);
}

}  // namespace

std::vector<glm::dvec3> VolumeState::velocities() const {
    std::vector<glm::dvec3> velocities;
    for (std::size_t i = 0; i < positions.size(); ++i)
        velocities.push_back((positions[i] - previous[i]) / step.sub);
    return velocities;
}

void shelterAir(
    const SimulationSettings& settings, const VolumeState& state, std::vector<glm::dvec3>& air) {
    const double density = settings.wind.air_density;
    if (settings.hair_hair.shelter == 0.0f || density == 0.0) return;
    const Box box = boxOf(state, settings.hair_hair.resolution);
    const std::vector<glm::dvec3> velocities = state.velocities();
    const std::vector<glm::dvec3> points = pointsInCells(state, box, velocities);
    const Grid grid = splat(points, velocities, sharesOf(state));
    const double diameter = 2.0 * double{settings.material.radius};
    const double area =
        diameter * double{settings.hair_hair.shelter} * lengthOf(state) / (box.cell * box.cell);
    const double viscous =
        10.0 * std::pow(double{settings.wind.air_viscosity} / (density * diameter), 2.0 / 3.0);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const glm::dvec3 relative = air[p] - velocities[p];
        const double speed = glm::length(relative);
        if (speed == 0.0) continue;
        const glm::dvec3 upstream = glm::inverse(state.frame.rotation) * (-1.0 / speed * relative);
        double passed = 0.0;
        for (const auto& [cell, sum] : grid) {
            if (cell[0] % 2 == 0) continue;  // of the second grid
            const glm::dvec3 centre = 0.5 * glm::dvec3(cell[0], cell[1], cell[2]);
            passed += sum.share * lengthInside(points[p], upstream, centre);
        }
        const double power =
            (std::pow(speed, 2.0 / 3.0) + viscous) * std::exp(-area * passed / 3.0);
        const double left = std::pow(std::max(power - viscous, 0.0), 1.5);
        air[p] = velocities[p] + left / speed * relative;
    }
}

std::vector<glm::dvec3>
volumeAccelerations(const SimulationSettings& settings, const VolumeState& state) {
    const HairHairSettings& contact = settings.hair_hair;
    std::vector<glm::dvec3> accelerations(state.positions.size(), glm::dvec3(0.0));
    const bool sticks = yields(contact);
    if (contact.friction == 0.0f && contact.repulsion == 0.0f && contact.attraction == 0.0f &&
        !sticks)
        return accelerations;

    const double step = state.step.whole;
    const Box box = boxOf(state, contact.resolution);
    const std::vector<double> shares = sharesOf(state);
    const double crowded = contact.crowding * meanDensityAtRest(state.rest, box, shares);
    // The exact solution over a step, including friction's effect on everything else that acts.
    const double decay = std::pow(1.0 - contact.friction, 60.0 * step);
    const double exponent = -60.0 * step * std::log(1.0 - contact.friction);
    const double predicted =
        contact.friction > 0.0f
            ? std::min(
                  1.0 - (1.0 - decay) / exponent,
                  contact.repulsion > 0.0f || contact.attraction > 0.0f ? decay : 0.75)
            : 0.0;
    std::vector<glm::dvec3> left;
    const double stiffest = (sticks ? 0.25 : 0.5) * std::pow(box.cell / step, 2.0);
    const double repulsion = std::min(double(contact.repulsion), stiffest);
    // Two strands of the mass per length 1 / length release `attraction` times it.
    const double depth = std::min(
        double(contact.attraction) * crowded * lengthOf(state) / (0.55 * 0.55 * box.cell),
        stiffest);

    std::vector<glm::dvec3> velocities = state.velocities();
    const std::vector<glm::dvec3> points = pointsInCells(state, box, velocities);
    if (sticks) {
        Elastic elastic = elasticAt(state);
        left = std::move(elastic.displacements);
        velocities = std::move(elastic.potentials);
    }
    Grid all = splat(points, velocities, shares);
    if (sticks) addSpreads(all, points, velocities, shares);
    const auto strength = [&](double share) {
        return double{contact.cohesion} + double{contact.friction_coefficient} * repulsion *
                                              std::max(1.0 - crowded / share, 0.0);
    };

    const std::size_t vertices = state.vertices;
    for (std::size_t first = 0; first < points.size(); first += vertices) {
        Grid own = splat(
            std::span(points).subspan(first, vertices),
            std::span(velocities).subspan(first, vertices),
            std::span(shares).subspan(first, vertices));
        const auto potential = [&](double share) {
            return (share > crowded ? repulsion * std::log(share / crowded) : 0.0) -
                   depth * std::min(share / crowded, 1.0);
        };
        for (std::size_t p = first; p < first + vertices; ++p) {
            glm::dvec3 drag(0.0);
            glm::dvec3 held(0.0);
            glm::dvec3 push(0.0);
            for (const Cell& cell : cellsRound(points[p])) {
                const double part = weight(cell, points[p]);
                const Sum whole = at(all, cell);
                const Sum mine = at(own, cell);
                if (whole.share <= 0.0) continue;
                const glm::dvec3 pull =
                    part *
                    (whole.momentum - mine.momentum - (whole.share - mine.share) * velocities[p]) /
                    whole.share;
                drag += pull;
                if (sticks) held += heldPart(whole, strength(whole.share), box.cell / step) * pull;
                push -= (potential(whole.share) - potential(mine.share)) / box.cell *
                        weightGradient(cell, points[p]);
            }
            drag /= 2.0;
            held /= 2.0;
            push /= 2.0;
            const double greatest = box.cell / (step * step);
            if (glm::length(push) > greatest) push *= greatest / glm::length(push);
            if (sticks) {
                left[p] += drag - held;
                accelerations[p] = state.frame.rotation * (held / step + push);
                continue;
            }
            const bool known = state.kept != nullptr && !state.kept->empty();
            const glm::dvec3 driven = known ? drag - (*state.kept)[p] : glm::dvec3(0.0);
            const glm::dvec3 friction = (1.0 - decay) * drag + predicted * driven;
            left.push_back(drag - friction);
            accelerations[p] = friction / step + state.frame.rotation * push;
        }
    }
    if (state.kept != nullptr) *state.kept = left;
    return accelerations;
}

}  // namespace hair::reference
