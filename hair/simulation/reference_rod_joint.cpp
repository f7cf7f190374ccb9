#include "hair/simulation/reference_rod_joint.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace hair::reference {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSteepest = 2.0 * kPi / 3.0;  // rad, of a whole joint: where tangents turn lines

// Energy of bending over stiffness with its first two derivatives by the angle.
struct Bend {
    double energy, torque, stiffness;
};

Bend bendBy(double angle, double copies) {
    const auto elastica = [&](double b) {
        const double cosine = std::cos(copies * b / 2.0);
        return Bend{
            -4.0 / (copies * copies) * std::log(cosine), 2.0 / copies * std::tan(copies * b / 2.0),
            1.0 / (cosine * cosine)};
    };
    const double end = kSteepest / copies;
    if (angle <= end) return elastica(angle);
    const Bend last = elastica(end);
    const double more = angle - end;
    return {
        last.energy + last.torque * more + last.stiffness * more * more / 2.0,
        last.torque + last.stiffness * more, last.stiffness};
}

}  // namespace

Joint bendAndTwist(
    const glm::dquat& first, const glm::dquat& second, double bend_stiffness,
    double twist_stiffness, Clamp clamp) {
    // The relative rotation: first a twist round the third axis, then a bend by `angle`. Opposite
    // third axes leave w = z = 0; which twist they get is of no account.
    glm::dquat r = glm::conjugate(first) * second;
    if (r.w < 0.0) r = -r;
    if (r.w * r.w + r.z * r.z < 1e-12) r.w = 1e-6;
    const double cosine = std::sqrt(r.w * r.w + r.z * r.z);  // of half of the angle
    const double sine = std::sqrt(r.x * r.x + r.y * r.y);
    const double angle = 2.0 * std::atan2(sine, cosine);
    const double twist = 2.0 * std::atan2(r.z, r.w);

    // Both have length sine * cosine: `across` is the axis that the angle grows round, `beside` is
    // perpendicular to it and to the first frame's third axis.
    const glm::dvec3 across(r.w * r.x - r.z * r.y, r.w * r.y + r.z * r.x, 0.0);
    const glm::dvec3 beside(across.y, -across.x, 0.0);
    const glm::dvec3 axis(0.0, 0.0, 1.0);

    const Bend bend = bendBy(angle, clamp == Clamp::yes ? 2.0 : 1.0);
    const glm::dvec3 bend_axis = sine > 0.0 ? across / (sine * cosine) : glm::dvec3(1.0, 0.0, 0.0);

    // fade = min(1, (cosine / cosine_at_120_degrees)^4), with cosine^2 as the variable.
    const double square = cosine * cosine;
    const double square_there = std::pow(std::cos(kSteepest / 2.0), 2.0);
    const bool fades = square < square_there;
    const double fade = fades ? std::pow(square / square_there, 2.0) : 1.0;
    const double fade_slope = fades ? 2.0 * square / (square_there * square_there) : 0.0;

    const glm::dvec3 twist_gradient = axis + beside / square;
    const glm::dvec3 gradient = bend_stiffness * bend.torque * bend_axis +
                                twist_stiffness * (twist * fade * twist_gradient -
                                                   0.5 * twist * twist * fade_slope * across);
    // What the small rotations make of it; the torque is exact, and so is where Newton's method
    // goes.
    const glm::dmat3 stiffness =
        bend_stiffness * (glm::dmat3(1.0) - glm::outerProduct(axis, axis) +
                          (bend.stiffness - 1.0) * glm::outerProduct(bend_axis, bend_axis)) +
        twist_stiffness * glm::outerProduct(axis, axis);

    const glm::dmat3 to_space = glm::mat3_cast(first);
    return {
        .energy = bend_stiffness * bend.energy + twist_stiffness * fade * twist * twist / 2.0,
        .torque = -(to_space * gradient),
        .stiffness = to_space * stiffness * glm::transpose(to_space)};
}

glm::dquat rotationBetween(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 middle = from + to;
    if (glm::length(middle) < 1e-6) {
        const glm::dvec3 size = glm::abs(from);
        glm::dvec3 least(0.0);
        least[size.x <= size.y && size.x <= size.z ? 0 : (size.y <= size.z ? 1 : 2)] = 1.0;
        return {0.0, glm::normalize(glm::cross(from, least))};
    }
    const glm::dvec3 half = glm::normalize(middle);
    return {glm::dot(from, half), glm::cross(from, half)};
}

glm::dquat halfOf(const glm::dquat& rotation) {
    const glm::dquat near = rotation.w < 0.0 ? -rotation : rotation;
    return glm::normalize(near + glm::dquat(1.0, 0.0, 0.0, 0.0));
}

}  // namespace hair::reference
