#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/settings.h"
#include "hair/simulation/stiffness.h"
#include "tests/largest_difference.h"

// Grooms and states for the simulation tests. They are the same on every platform.
namespace hair::simulation {

// Returns a number in [-1, 1).
inline double randomSigned(std::mt19937& random) {
    return static_cast<double>(random()) / 2147483648.0 - 1.0;
}

inline glm::dvec3 randomVector(std::mt19937& random) {
    const double x = randomSigned(random);
    const double y = randomSigned(random);
    return {x, y, randomSigned(random)};
}

// Returns strands that hang from points 5 cm apart. Each segment is `segment` long.
inline groom::Groom
straightGroom(std::uint32_t strands, std::uint32_t vertices, double segment = kReferenceSegment) {
    groom::Groom groom{.strand_count = strands, .vertices_per_strand = vertices};
    for (std::uint32_t s = 0; s < strands; ++s)
        for (std::uint32_t v = 0; v < vertices; ++v)
            groom.points.emplace_back(0.05 * s, -segment * v, 0.0);
    return groom;
}

// Returns wavy strands: each segment turns from the previous one by a random angle up to about 40
// degrees.
inline groom::Groom
wavyGroom(std::uint32_t strands, std::uint32_t vertices, double segment = kReferenceSegment) {
    groom::Groom groom{.strand_count = strands, .vertices_per_strand = vertices};
    std::mt19937 random(7);
    for (std::uint32_t s = 0; s < strands; ++s) {
        glm::dvec3 point = 0.1 * randomVector(random);
        glm::dvec3 direction = glm::normalize(randomVector(random) + glm::dvec3(0.0, 0.01, 0.0));
        for (std::uint32_t v = 0; v < vertices; ++v) {
            groom.points.emplace_back(point);
            direction = glm::normalize(direction + 0.5 * randomVector(random));
            point += segment * direction;
        }
    }
    return groom;
}

// Returns the groom's points with all except the roots moved by up to `amount` along each axis, m.
inline std::vector<glm::vec3>
disturbed(const groom::Groom& groom, double amount, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<glm::vec3> points = groom.points;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (i % groom.vertices_per_strand != 0)
            points[i] += glm::vec3(amount * randomVector(random));
    return points;
}

inline std::vector<glm::dvec3> toDouble(std::span<const glm::vec3> points) {
    return {points.begin(), points.end()};
}

// Returns the length of the groom's longest strand, m. Errors are relative to it.
inline double longestStrand(const groom::Groom& groom) {
    Extremes lengths;
    for (std::uint32_t s = 0; s < groom.strand_count; ++s) {
        double length = 0.0;
        for (std::uint32_t v = 1; v < groom.vertices_per_strand; ++v)
            length +=
                glm::distance(glm::dvec3(groom.strand(s)[v]), glm::dvec3(groom.strand(s)[v - 1]));
        lengths.add(length);
    }
    return lengths.greatest();
}

// Returns settings with every force and constraint off. Each test switches on its subject.
inline SimulationSettings nothingActs() {
    SimulationSettings settings;
    settings.gravity = glm::vec3(0.0f);
    settings.friction = 0.0f;
    settings.global.stiffness = 0.0f;
    settings.local = {.stiffness = 0.0f, .iterations = 0};
    settings.length.iterations = 0;
    return settings;
}

}  // namespace hair::simulation
