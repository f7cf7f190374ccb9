#include "hair/simulation/rod_balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "hair/simulation/stiffness.h"

namespace hair::simulation {
namespace {

// ---- A joint ------------------------------------------------------------------------------------

// The energy of simulation/rod/joint.glsl, up to kMostBend. A bend b between the third axes and a
// twist t round the axis between them cost -(4 / n^2) K ln cos(n b / 2) + K' t^2 / 2, with n = 1,
// or 2 at the follicle. For an elliptic section, K becomes K (e cos^2 p + sin^2 p / e), where p is
// the direction of the bend's axis in the halfway frame.
struct JointStiffness {
    double bend, twist;
    bool at_follicle;
    double ellipticity;
};

struct Strain {
    double bend;  // rad
    glm::dquat rotation;  // of the second frame relative to the first
};

glm::dquat shortestRotation(const glm::dquat& q) { return q.w < 0.0 ? -q : q; }

// Returns half of a rotation, of unit length.
glm::dquat rootOf(const glm::dquat& rotation) {
    return glm::normalize(shortestRotation(rotation) + glm::dquat(1.0, 0.0, 0.0, 0.0));
}

// Returns the energy's gradient by rotations of the second frame, in axes of the first.
glm::dvec3 gradientOf(const glm::dquat& strain, const JointStiffness& joint) {
    const glm::dquat r = shortestRotation(strain);
    const double cosine2 = r.w * r.w + r.z * r.z;  // cos^2 of half the bend
    const double cosine = cosine2 - r.x * r.x - r.y * r.y;  // cosine of the bend
    // Sine times cosine of half the bend, along the bend's axis, and perpendicular to it.
    const glm::dvec3 across{r.w * r.x - r.z * r.y, r.w * r.y + r.z * r.x, 0.0};
    const glm::dvec3 beside{across.y, -across.x, 0.0};
    const double twist = 2.0 * std::atan2(r.z, r.w);
    const glm::dvec3 axis(0.0, 0.0, 1.0);
    const glm::dvec3 twisting = joint.twist * twist * (axis + beside / cosine2);
    const double sine2 = r.x * r.x + r.y * r.y;
    if (joint.ellipticity == 1.0 || sine2 == 0.0)
        return joint.bend * 2.0 / (joint.at_follicle ? cosine : cosine2) * across + twisting;
    const double e = joint.ellipticity;
    const double directed = joint.bend * (e * r.x * r.x + r.y * r.y / e) / sine2;
    const double energy = joint.at_follicle ? -std::log1p(-2.0 * sine2) : -2.0 * std::log1p(-sine2);
    return directed * 2.0 / (joint.at_follicle ? cosine : cosine2) * across + twisting +
           joint.bend * (1.0 / e - e) * energy * r.x * r.y / sine2 * (axis - beside / sine2);
}

// Returns the change of the gradient per rotation of the second frame, in space axes, by central
// differences. The square of the step, and rounding over the step, are at most 1e-10 of the
// stiffness.
glm::dmat3
hessianOf(const glm::dquat& first, const glm::dquat& second, const JointStiffness& joint) {
    constexpr double kTurn = 1e-5;
    glm::dmat3 change;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 turn{0.0};
        turn[axis] = kTurn / 2.0;
        const auto at = [&](double sign) {
            const glm::dquat turned = glm::normalize(glm::dquat(1.0, sign * turn)) * second;
            return first * gradientOf(glm::conjugate(first) * turned, joint);
        };
        change[axis] = (at(1.0) - at(-1.0)) / (2.0 * kTurn);
    }
    return change;
}

// Returns the strain with this gradient for a round section: the inverse of gradientOf(). Across
// the axis the gradient is tan(b / 2) (A u + B u'), with the bend's axis u, u' = (u.y, -u.x), A = 2
// K, or K tan(b) / tan(b / 2) at the follicle, and B = K' t.
Strain strainOfRound(const glm::dvec3& gradient, const JointStiffness& joint) {
    const double twist = gradient.z / joint.twist;
    const std::complex<double> across(gradient.x, gradient.y);
    const double beside = joint.twist * twist;
    double tangent = 0.0;  // of half the bend
    double along = 2.0 * joint.bend;
    if (!joint.at_follicle) {
        tangent = std::abs(across) / std::hypot(along, beside);
    } else {
        // tan(b) = 2 u / (1 - u^2) with u = tan(b / 2). The gradient grows with u, so bisection
        // works.
        double low = 0.0, high = 1.0;
        for (int i = 0; i < 60; ++i) {
            tangent = (low + high) / 2.0;
            along = 2.0 * joint.bend / (1.0 - tangent * tangent);
            (tangent * std::hypot(along, beside) < std::abs(across) ? low : high) = tangent;
        }
    }
    if (std::abs(across) == 0.0)
        return {0.0, {std::cos(twist / 2.0), 0.0, 0.0, std::sin(twist / 2.0)}};
    const std::complex<double> axis = across / std::complex<double>(along, -beside);
    const double bend = 2.0 * std::atan(tangent);
    const std::complex<double> turned =
        std::polar(std::sin(bend / 2.0), std::arg(axis) - twist / 2.0);
    const std::complex<double> kept = std::polar(std::cos(bend / 2.0), twist / 2.0);
    return {bend, {kept.real(), turned.real(), turned.imag(), kept.imag()}};
}

// Returns the strain with this gradient. For an elliptic section it uses Newton's method, starting
// from a round section with each axis's own stiffness for its part of the gradient. Absent if the
// joint would have to bend too far.
std::optional<Strain> strainOf(const glm::dvec3& gradient, const JointStiffness& joint) {
    const double most_bend = joint.at_follicle ? kMostBend / 2.0 : kMostBend;
    const double e = joint.ellipticity;
    Strain strain = strainOfRound({gradient.x / e, gradient.y * e, gradient.z}, joint);
    if (e == 1.0) return strain.bend <= most_bend ? std::optional(strain) : std::nullopt;

    constexpr int kMostIterations = 50;
    constexpr double kMostTurn = 0.2;  // rad, per step
    constexpr double kSolved = 1e-12;
    const glm::dquat none(1.0, 0.0, 0.0, 0.0);
    if (!(strain.bend <= most_bend)) strain.rotation = none;
    for (int i = 0; i < kMostIterations; ++i) {
        const glm::dvec3 residual = gradient - gradientOf(strain.rotation, joint);
        glm::dvec3 turn = glm::inverse(hessianOf(none, strain.rotation, joint)) * residual;
        const double size = glm::length(turn);
        if (!(size < 1e9)) return std::nullopt;
        turn *= kMostTurn / std::max(size, kMostTurn);
        strain.rotation = shortestRotation(
            glm::normalize(glm::normalize(glm::dquat(1.0, turn / 2.0)) * strain.rotation));
        strain.bend =
            2.0 * std::asin(std::min(1.0, std::hypot(strain.rotation.x, strain.rotation.y)));
        if (!(strain.bend <= most_bend)) return std::nullopt;
        if (size < kSolved) return strain;
    }
    return std::nullopt;
}

// Returns half of the rest rotation at which the joint between these frames has this gradient, in
// space axes: first h S h = second with the strain S in the axes of first h. Absent if the joint
// would have to bend too far.
std::optional<glm::dquat> halfRotationOf(
    const glm::dquat& first, const glm::dquat& second, const glm::dvec3& gradient,
    const JointStiffness& joint) {
    constexpr int kMostIterations = 200;
    constexpr double kSolved = 1e-13;
    const glm::dquat between = glm::conjugate(first) * second;
    glm::dquat half = rootOf(between);
    double last_change = 1.0;
    for (int i = 0; i < kMostIterations; ++i) {
        const std::optional<Strain> found =
            strainOf(glm::conjugate(first * half) * gradient, joint);
        if (!found || !(std::abs(found->rotation.z) < 0.9)) return std::nullopt;
        const Strain& strain = *found;
        // (h S)^2 = between S.
        const glm::dquat next =
            shortestRotation(rootOf(between * strain.rotation) * glm::conjugate(strain.rotation));
        const double change = glm::length(next - half);
        if (change < kSolved) return next;
        // A full step can be too far for a strongly bent joint; then take half.
        half = change < 0.7 * last_change ? next : glm::normalize(half + next);
        last_change = change;
    }
    return std::nullopt;
}

// ---- A rod --------------------------------------------------------------------------------------

glm::dmat3 symmetric(const glm::dmat3& m) { return 0.5 * (m + glm::transpose(m)); }

// For a symmetric matrix.
bool isPositiveDefinite(const glm::dmat3& m) {
    return m[0][0] > 0.0 && m[0][0] * m[1][1] - m[0][1] * m[1][0] > 0.0 &&
           glm::determinant(m) > 0.0;
}

// Returns the unloaded joint's resistance to rotations: its stiffness without the gradient's own
// part, as in the solver.
glm::dmat3
unloadedOf(const glm::dquat& first, const glm::dquat& second, const JointStiffness& joint) {
    const glm::dvec3 axis = first * glm::dvec3(0.0, 0.0, 1.0);
    const glm::dmat3 along = glm::outerProduct(axis, axis);
    const glm::dvec3 tangent = second * glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 across = glm::cross(axis, tangent);  // has the bend's sine as its length
    const double cosine = glm::dot(axis, tangent);
    const double more =
        joint.at_follicle ? 1.0 / (cosine * cosine) : 1.0 / ((1.0 + cosine) * (1.0 + cosine));
    if (joint.ellipticity == 1.0)
        return joint.bend * (glm::dmat3(1.0) - along + more * glm::outerProduct(across, across)) +
               joint.twist * along;
    const double e = joint.ellipticity;
    const glm::dquat r = shortestRotation(glm::conjugate(first) * second);
    const double sine2 = std::max(r.x * r.x + r.y * r.y, 1e-30);
    const double length = std::hypot(r.w, r.z);
    const double energy = joint.at_follicle ? -std::log1p(-2.0 * sine2) : -2.0 * std::log1p(-sine2);
    const glm::dvec3 stiff =
        first * glm::dvec3(r.w / length, r.z / length, -r.y * std::sqrt(energy / (2.0 * sine2)));
    const double directed = (e * r.x * r.x + r.y * r.y / e) / sine2;
    return joint.bend *
               ((glm::dmat3(1.0) - along) / e + (e - 1.0 / e) * glm::outerProduct(stiff, stiff) +
                directed * more * glm::outerProduct(across, across)) +
           joint.twist * along;
}

// The weights below every joint: their sum, and their moment round the joint, which is the joint's
// gradient at rest.
struct Loads {
    std::vector<glm::dvec3> forces;  // at vertices: the sum of all weights from there on
    std::vector<glm::dvec3> moments;  // at joints
};

Loads loadsOf(const HangingRod& rod) {
    const std::size_t size = rod.edges.size();
    Loads loads{std::vector(size, glm::dvec3(0.0)), std::vector(size, glm::dvec3(0.0))};
    glm::dvec3 force{0.0};
    glm::dvec3 moment{0.0};
    for (std::size_t i = size - 1; i > 0; --i) {
        force += rod.weights[i];
        moment += glm::cross(rod.edges[i], force);
        loads.forces[i] = force;
        loads.moments[i] = moment;
    }
    return loads;
}

JointStiffness stiffnessOf(const HangingRod& rod, std::size_t i, double stiffening) {
    return {
        stiffening * rod.bend_stiffness[i], stiffening * rod.twist_stiffness[i], i == 1,
        rod.ellipticity};
}

std::optional<std::vector<glm::dquat>>
halfRotations(const HangingRod& rod, const Loads& loads, double stiffening) {
    std::vector<glm::dquat> halves(rod.edges.size(), glm::dquat(1.0, 0.0, 0.0, 0.0));
    for (std::size_t i = 1; i < halves.size(); ++i) {
        const auto half = halfRotationOf(
            rod.orientations[i - 1], rod.orientations[i], loads.moments[i],
            stiffnessOf(rod, i, stiffening));
        if (!half) return std::nullopt;
        halves[i] = *half;
    }
    return halves;
}

// Whether the energy has a minimum there, with the segments' rotations as unknowns. A potential of
// a rotation exp(t) with gradient g has the Hessian sym(dg/dt). A potential between two frames has
// this block for both frames and -dg/dt between them.
bool isStable(
    const HangingRod& rod, const Loads& loads, const std::vector<glm::dquat>& halves,
    double stiffening) {
    glm::dmat3 below(0.0);  // resistance of the lower segments to this one's rotation
    for (std::size_t i = rod.edges.size() - 1; i > 0; --i) {
        const glm::dquat first = rod.orientations[i - 1] * halves[i];
        const glm::dquat second = rod.orientations[i] * glm::conjugate(halves[i]);
        const JointStiffness joint = stiffnessOf(rod, i, stiffening);
        const glm::dmat3 unloaded = unloadedOf(first, second, joint);
        const glm::dmat3 change =
            unloaded + kLoadMargin * (hessianOf(first, second, joint) - unloaded);
        const glm::dmat3 own = symmetric(change);

        const glm::dvec3& edge = rod.edges[i];
        const glm::dvec3& force = loads.forces[i];
        const glm::dmat3 geometric =
            glm::dot(force, edge) * glm::dmat3(1.0) - symmetric(glm::outerProduct(force, edge));
        const glm::dmat3 pivot = own + below + kLoadMargin * geometric;
        if (!isPositiveDefinite(pivot)) return false;
        below = own - symmetric(change * glm::inverse(pivot) * glm::transpose(change));
    }
    return true;
}

}  // namespace

std::optional<BalancedRod> balanceRod(const HangingRod& rod, double most_stiffening) {
    const Loads loads = loadsOf(rod);
    const auto balanced = [&](double stiffening) -> std::optional<BalancedRod> {
        auto halves = halfRotations(rod, loads, stiffening);
        if (!halves || !isStable(rod, loads, *halves, stiffening)) return std::nullopt;
        return BalancedRod{stiffening, std::move(*halves)};
    };
    constexpr double kPrecision = 1.05;
    double low = 1.0;
    double high = low;
    std::optional<BalancedRod> found = balanced(low);
    while (!found && high < most_stiffening) {
        low = high;
        high = std::min(2.0 * high, most_stiffening);
        found = balanced(high);
    }
    while (found && high > low * kPrecision) {
        const double middle = std::sqrt(low * high);
        if (auto better = balanced(middle)) {
            found = std::move(better);
            high = middle;
        } else {
            low = middle;
        }
    }
    return found;
}

}  // namespace hair::simulation
