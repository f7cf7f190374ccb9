#include "hair/reference/hair_hair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace hair::reference {
namespace {

// Twice the position of a cell's centre, cells: three odd numbers in the first grid, three even
// ones in the second.
using Cell = std::array<int, 3>;

struct Sum {
    double share = 0.0;
    glm::dvec3 momentum{0.0};
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

}  // namespace

std::vector<glm::dvec3>
volumeAccelerations(const SimulationSettings& settings, const VolumeState& state) {
    const HairHairSettings& contact = settings.hair_hair;
    std::vector<glm::dvec3> accelerations(state.positions.size(), glm::dvec3(0.0));
    if (contact.friction == 0.0f && contact.repulsion == 0.0f) return accelerations;

    const double step = state.step.whole;
    const Box box = boxOf(state, contact.resolution);
    const std::vector<double> shares = sharesOf(state);
    const double crowded = contact.crowding * meanDensityAtRest(state.rest, box, shares);
    // The exact solution over a step, including friction's effect on everything else that acts.
    const double decay = std::pow(1.0 - contact.friction, 60.0 * step);
    const double exponent = -60.0 * step * std::log(1.0 - contact.friction);
    const double predicted =
        contact.friction > 0.0f
            ? std::min(1.0 - (1.0 - decay) / exponent, contact.repulsion > 0.0f ? decay : 0.75)
            : 0.0;
    std::vector<glm::dvec3> left;
    const double repulsion =
        std::min(double(contact.repulsion), 0.5 * (box.cell / step) * (box.cell / step));

    std::vector<glm::dvec3> points;
    std::vector<glm::dvec3> velocities;
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
        velocities.push_back((state.positions[i] - state.previous[i]) / state.step.sub);
        const glm::dvec3 later = state.positions[i] + step * velocities[i];
        const glm::dvec3 on_head =
            glm::inverse(state.frame.rotation) * (later - state.frame.translation);
        points.push_back(glm::clamp((on_head - box.corner) / box.cell, 2.0, box.side - 2.001));
    }
    const Grid all = splat(points, velocities, shares);

    const std::size_t vertices = state.vertices;
    for (std::size_t first = 0; first < points.size(); first += vertices) {
        Grid own = splat(
            std::span(points).subspan(first, vertices),
            std::span(velocities).subspan(first, vertices),
            std::span(shares).subspan(first, vertices));
        const auto potential = [&](double share) {
            return share > crowded ? repulsion * std::log(share / crowded) : 0.0;
        };
        for (std::size_t p = first; p < first + vertices; ++p) {
            glm::dvec3 drag(0.0);
            glm::dvec3 push(0.0);
            for (const Cell& cell : cellsRound(points[p])) {
                const double part = weight(cell, points[p]);
                const Sum whole = at(all, cell);
                const Sum mine = at(own, cell);
                if (whole.share <= 0.0) continue;
                drag +=
                    part *
                    (whole.momentum - mine.momentum - (whole.share - mine.share) * velocities[p]) /
                    whole.share;
                push -= (potential(whole.share) - potential(mine.share)) / box.cell *
                        weightGradient(cell, points[p]);
            }
            drag /= 2.0;
            push /= 2.0;
            const double greatest = box.cell / (step * step);
            if (glm::length(push) > greatest) push *= greatest / glm::length(push);
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
