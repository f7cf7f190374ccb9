#include "hair/simulation/rod_rest.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "hair/simulation/rotation_between.h"

namespace hair {

namespace {

constexpr double kShortest = 1e-9;       // m
constexpr double kShortestUnit = 1e-6;   // m, for strands without length
constexpr double kLeastMass = 0.01;      // of a vertex, over the mean
constexpr double kMostStiffness = 1e15;  // rigid beside any inertia; its square is a float
// Bound of the ratio of bending to twisting stiffness and of its inverse, far beyond any material:
// where the two differ by 10^7, 32 bits lose the lesser one.
constexpr double kMostAnisotropy = 1e3;

glm::dquat halfOf(glm::dquat rotation) {
    if (rotation.w < 0.0) rotation = -rotation;
    return glm::normalize(rotation + glm::dquat(1.0, 0.0, 0.0, 0.0));
}

glm::vec4 toGpu(const glm::dquat& q) { return glm::dvec4(q.x, q.y, q.z, q.w); }

struct Strand {
    std::vector<gpu::RodSegment> segments;
    double unit;
};

// `bending` is h^2 E I / lambda, m^4: over the fourth power of a length, the stiffness of a joint
// of that length in its own units. `twisting` is G J / (E I).
Strand restOfStrand(std::span<const glm::vec3> points, double bending, double twisting) {
    const std::size_t size = points.size();
    std::vector<double> lengths{0.0};
    for (std::size_t i = 1; i < size; ++i)
        lengths.push_back(glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i - 1])));
    double unit = 0.0;
    for (const double length : lengths) unit += length / static_cast<double>(size - 1);
    unit = std::max(unit, kShortestUnit);

    Strand strand{.segments = {}, .unit = unit};
    glm::dvec3 tangent{0.0, 1.0, 0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t segment = std::max<std::size_t>(i, 1);  // the first is the follicle's too
        glm::dvec3 next = tangent;
        if (lengths[segment] >= kShortest)
            next = glm::normalize(glm::dvec3(points[segment]) - glm::dvec3(points[segment - 1]));
        const glm::dquat above = orientation;
        orientation = i == 0 ? rotationBetween({0.0, 0.0, 1.0}, next)
                             : glm::normalize(rotationBetween(tangent, next) * orientation);
        tangent = next;

        // The first joint is half of one between the segment and its mirror image in the follicle.
        const double joint = i < 2 ? lengths[segment] / 2.0 : (lengths[i] + lengths[i - 1]) / 2.0;
        const double stiffness = bending / (std::max(joint, kShortest) * unit * unit * unit);
        const double below = i + 1 < size ? lengths[i + 1] : 0.0;
        strand.segments.push_back(
            {.half_rotation =
                 toGpu(i == 0 ? orientation : halfOf(glm::conjugate(above) * orientation)),
             .rest_length = static_cast<float>(lengths[i] / unit),
             .mass = static_cast<float>(std::max((lengths[i] + below) / (2.0 * unit), kLeastMass)),
             .bend_stiffness = static_cast<float>(std::min(stiffness, kMostStiffness)),
             .twist_stiffness =
                 static_cast<float>(std::min(stiffness * twisting, kMostStiffness))});
    }
    return strand;
}

}  // namespace

RodRest restOfRods(const Groom& groom, const MaterialSettings& material, const gpu::Step& step) {
    // I / A = R^2 / 4 and J = 2 I of a round section.
    const double radius = material.radius;
    const double substep = step.sub;
    const double bending = substep * substep * double{material.youngs_modulus} * radius * radius /
                           (4.0 * double{material.density});
    const double twisting = std::clamp(
        2.0 * double{material.shear_modulus} / double{material.youngs_modulus},
        1.0 / kMostAnisotropy, kMostAnisotropy);

    RodRest rest;
    rest.segments.resize(groom.points.size());
    for (std::uint32_t s = 0; s < groom.strand_count; ++s) {
        const Strand strand = restOfStrand(groom.strand(s), bending, twisting);
        rest.units.push_back(static_cast<float>(strand.unit));
        for (std::size_t i = 0; i < strand.segments.size(); ++i)
            rest.segments[i * groom.strand_count + s] = strand.segments[i];
    }
    return rest;
}

}  // namespace hair
