#include "hair/reference/wind.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "hair/random.h"

namespace hair::reference {
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
    return force / (double{material.density} * std::numbers::pi * radius * radius);
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

}  // namespace hair::reference
