#include "hair/groom/growth/flatten.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "engine/error.h"

namespace hair {
namespace {

constexpr int kCandidates = 256;  // centres tried

struct Facet {
    glm::dvec3 centroid;
    glm::dvec3 area_vector;
    std::array<glm::dvec3, 3> corners;
};

std::vector<Facet> facets(const Scalp& scalp) {
    std::vector<Facet> facets;
    for (const auto& [i, j, k] : scalp.triangles) {
        const glm::dvec3 a(scalp.positions[i]);
        const glm::dvec3 b(scalp.positions[j]);
        const glm::dvec3 c(scalp.positions[k]);
        const glm::dvec3 area_vector = 0.5 * glm::cross(b - a, c - a);
        if (glm::length(area_vector) > 0.0)
            facets.push_back({(a + b + c) / 3.0, area_vector, {a, b, c}});
    }
    return facets;
}

// The smallest cosine between a facet's normal and the direction to one of its corners.
double worstView(const std::vector<Facet>& facets, const glm::dvec3& centre) {
    double worst = 1.0;
    for (const Facet& facet : facets) {
        const double area = glm::length(facet.area_vector);
        for (const glm::dvec3& corner : facet.corners) {
            const glm::dvec3 view = corner - centre;
            const double cosine = glm::dot(facet.area_vector, view) / (area * glm::length(view));
            worst = std::min(worst, std::isfinite(cosine) ? cosine : -1.0);
        }
    }
    return worst;
}

// Whether the direction -axis, which has no image, meets a facet that is seen from its inner side.
bool coversAntipode(const std::vector<Facet>& facets, const Flattening& flattening) {
    return std::ranges::any_of(facets, [&](const Facet& facet) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 from = facet.corners[i] - flattening.centre;
            const glm::dvec3 to = facet.corners[(i + 1) % 3] - flattening.centre;
            if (glm::dot(glm::cross(from, to), -flattening.axis) < 0.0) return false;
        }
        return true;
    });
}

glm::dvec3 anyPerpendicular(const glm::dvec3& axis) {
    const glm::dvec3 other =
        std::abs(axis.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(other - glm::dot(other, axis) * axis);
}

}  // namespace

glm::dvec2 Flattening::operator()(const glm::vec3& position) const {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(position) - centre);
    const glm::dvec2 across(glm::dot(direction, right), glm::dot(direction, up));
    return across / (1.0 + glm::dot(direction, axis));
}

Flattening flatten(const Scalp& scalp) {
    const std::vector<Facet> scalp_facets = facets(scalp);
    glm::dvec3 centroid(0.0);
    glm::dvec3 area_vector(0.0);
    for (const Facet& facet : scalp_facets) {
        centroid += facet.centroid * (glm::length(facet.area_vector) / scalp.area());
        area_vector += facet.area_vector;
    }
    // From a closed surface the vectors cancel: a scalp needs a side that it faces.
    if (glm::length(area_vector) < 1e-3 * scalp.area()) {
        throw engine::Error("the scalp wraps all the way round and can't be flattened");
    }
    Flattening flattening;
    flattening.axis = glm::normalize(area_vector);
    flattening.right = anyPerpendicular(flattening.axis);
    flattening.up = glm::cross(flattening.axis, flattening.right);

    const double size = std::sqrt(scalp.area());  // a hemisphere's radius is 0.4 of it
    double best = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kCandidates; ++i) {
        const double depth = size * i / (kCandidates - 1);
        const glm::dvec3 centre = centroid - depth * flattening.axis;
        const double view = worstView(scalp_facets, centre);
        if (view <= best) continue;
        best = view;
        flattening.centre = centre;
    }
    if (best <= 0.0) {
        throw engine::Error(
            "the scalp folds over itself when flattened: there is no point inside from "
            "which every triangle is seen from behind");
    }
    if (coversAntipode(scalp_facets, flattening)) {
        throw engine::Error("the scalp wraps all the way round and can't be flattened");
    }
    return flattening;
}

}  // namespace hair
