#include "hair/simulation/solver_rod.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/buffer_image.h"
#include "engine/transfer.h"
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

// ---- Rods at rest -------------------------------------------------------------------------------

// Rods at rest, in the solver's form. A segment shorter than 1e-9 m takes the direction of the
// segment before it, or +y if it is the first. It bends with its neighbours and has mass.
struct RodRest {
    std::vector<glm::vec4> segments;  // [vertex][gpu::kRodSegmentRows][strand]
    std::vector<float> units;  // [strand], m
    std::vector<glm::vec4> set;  // [vertex][strand], if hair takes a set: gpu::RodParameters
    std::optional<RestBalance> balance;
};

namespace {

using engine::Access;

constexpr double kShortest = 1e-9;  // m
constexpr double kShortestUnit = 1e-6;  // m, for strands without length
constexpr double kLeastMass = 0.01;  // of a vertex, relative to the mean
constexpr double kMostStiffness = 1e15;  // rigid against any inertia; its square still fits a float
// An ellipse with the area of a circle has the second moments I e and I / e and the torsion
// constant 4 I / (e + 1 / e), where I is the circle's second moment and e the ratio of the
// ellipse's axes: Timoshenko and Goodier 1951, Theory of elasticity. Returns 4 / (e + 1 / e).
double torsionOf(double ellipticity) { return 4.0 / (ellipticity + 1.0 / ellipticity); }

// Bound on the ratio of bending to twisting stiffness and on its inverse, far beyond any material.
// At a ratio of 10^7, 32-bit floats lose the smaller stiffness.
constexpr double kMostAnisotropy = 1e3;

glm::dquat halfOf(glm::dquat rotation) {
    if (rotation.w < 0.0) rotation = -rotation;
    return glm::normalize(rotation + glm::dquat(1.0, 0.0, 0.0, 0.0));
}

glm::vec4 toGpu(const glm::dquat& q) { return glm::dvec4(q.x, q.y, q.z, q.w); }

struct Strand {
    HangingRod rod;  // without weights, in the strand's units
    std::vector<double> masses;  // [vertex], relative to a segment of unit length
    std::vector<glm::dquat> half_rotations;  // at joints; entry 0: the follicle's orientation
    double unit;  // m
};

// Turns a section round its tangent, the z axis, by an angle in rad.
glm::dquat turned(double angle) { return {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)}; }

// `bending` is h^2 E I / lambda, m^4. Divided by the fourth power of a length, it is the stiffness
// of a joint of that length in its own units. `twisting` is G J / (E I).
Strand restOfStrand(
    std::span<const glm::vec3> points, double bending, double twisting,
    const MaterialSettings& material) {
    const double angle = glm::radians(double{material.section_angle});
    const double twist = material.twist;
    const std::size_t size = points.size();
    std::vector<double> lengths{0.0};
    for (std::size_t i = 1; i < size; ++i)
        lengths.push_back(glm::distance(glm::dvec3(points[i]), glm::dvec3(points[i - 1])));
    double unit = 0.0;
    for (const double length : lengths) unit += length / static_cast<double>(size - 1);
    unit = std::max(unit, kShortestUnit);

    Strand strand{
        .rod = {.ellipticity = double{material.ellipticity}},
        .masses = {},
        .half_rotations = {},
        .unit = unit};
    glm::dvec3 tangent{0.0, 1.0, 0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t segment = std::max<std::size_t>(i, 1);  // the first is the follicle's too
        glm::dvec3 next = tangent;
        if (lengths[segment] >= kShortest)
            next = glm::normalize(glm::dvec3(points[segment]) - glm::dvec3(points[segment - 1]));
        const glm::dquat above = orientation;
        orientation = i == 0 ? rotationBetween({0.0, 0.0, 1.0}, next) * turned(angle)
                             : glm::normalize(rotationBetween(tangent, next) * orientation);
        tangent = next;

        // The first joint is half of one between the segment and its mirror image in the follicle.
        const double joint = i < 2 ? lengths[segment] / 2.0 : (lengths[i] + lengths[i - 1]) / 2.0;
        const double stiffness = bending / (std::max(joint, kShortest) * unit * unit * unit);
        const double below = i + 1 < size ? lengths[i + 1] : 0.0;
        strand.rod.orientations.push_back(orientation);
        strand.rod.edges.push_back(lengths[i] / unit * tangent);
        strand.rod.bend_stiffness.push_back(stiffness);
        strand.rod.twist_stiffness.push_back(stiffness * twisting);
        strand.masses.push_back(std::max((lengths[i] + below) / (2.0 * unit), kLeastMass));
        strand.half_rotations.push_back(
            i == 0 ? orientation
                   : halfOf(glm::conjugate(above) * orientation * turned(twist * joint)));
    }
    return strand;
}

// `pull`: h^2 g, m. `lasting`: the share of the stiffness that does not yield, which has to bear
// the weight.
void balance(
    Strand& strand, std::uint32_t index, const glm::dvec3& pull, double most_stiffening,
    double lasting, RestBalance& result) {
    for (const double mass : strand.masses) strand.rod.weights.push_back(mass / strand.unit * pull);
    HangingRod hanging = strand.rod;
    for (double& stiffness : hanging.bend_stiffness) stiffness *= lasting;
    for (double& stiffness : hanging.twist_stiffness) stiffness *= lasting;
    const std::optional<BalancedRod> balanced = balanceRod(hanging, most_stiffening);
    if (!balanced) {
        result.unbalanced.push_back(index);
        return;
    }
    result.add(balanced->stiffening);
    std::ranges::copy(
        std::span(balanced->half_rotations).subspan(1), strand.half_rotations.begin() + 1);
    for (double& stiffness : strand.rod.bend_stiffness) stiffness *= balanced->stiffening;
    for (double& stiffness : strand.rod.twist_stiffness) stiffness *= balanced->stiffening;
}

RodRest
restOfRods(const groom::Groom& groom, const SimulationSettings& settings, const gpu::Step& step) {
    // A round section has I / A = R^2 / 4.
    const MaterialSettings& material = settings.material;
    const double radius = material.radius;
    const double substep = step.sub;
    const double bending = substep * substep * double{material.youngs_modulus} * radius * radius /
                           (4.0 * wetDensity(material));
    const double twisting = std::clamp(
        torsionOf(double{material.ellipticity}) * double{material.shear_modulus} /
            double{material.youngs_modulus},
        1.0 / kMostAnisotropy, kMostAnisotropy);
    // The groom is that of dry hair.
    const double dry = double{material.density} / wetDensity(material);
    const glm::dvec3 pull = dry * substep * substep * gravityOnGroom(settings);

    RodRest rest;
    // Balancing only knows the energy of `rod`.
    if (settings.rest == RestShape::balanced && settings.solver == Solver::rod)
        rest.balance.emplace();
    rest.segments.resize(groom.points.size() * gpu::kRodSegmentRows);
    const double set_share = double{material.set_share};
    const bool sets = set_share > 0.0 && settings.solver == Solver::rod;
    if (sets) rest.set.resize(groom.points.size());
    for (std::uint32_t s = 0; s < groom.strand_count; ++s) {
        Strand strand = restOfStrand(groom.strand(s), bending, twisting, material);
        const std::vector<glm::dquat> groomed = strand.half_rotations;
        if (rest.balance)
            balance(
                strand, s, pull, double{settings.most_stiffening}, sets ? 1.0 - set_share : 1.0,
                *rest.balance);
        rest.units.push_back(static_cast<float>(strand.unit));
        // Hair has had the groom's shape for long.
        for (std::size_t i = 0; sets && i < strand.masses.size(); ++i) {
            const glm::dquat back = glm::conjugate(strand.half_rotations[i]);
            rest.set[i * groom.strand_count + s] =
                toGpu(halfOf(back * groomed[i] * groomed[i] * back));
        }
        for (std::size_t i = 0; i < strand.masses.size(); ++i) {
            const auto row = [&](std::size_t which) -> glm::vec4& {
                return rest.segments[(i * gpu::kRodSegmentRows + which) * groom.strand_count + s];
            };
            row(gpu::kRodHalfRotation) = toGpu(strand.half_rotations[i]);
            row(gpu::kRodStiffness) = glm::dvec4(
                glm::length(strand.rod.edges[i]), strand.masses[i],
                std::min(strand.rod.bend_stiffness[i], kMostStiffness),
                std::min(strand.rod.twist_stiffness[i], kMostStiffness));
        }
    }
    return rest;
}

static_assert(offsetof(gpu::RodParameters, accelerations) == 32);
static_assert(offsetof(gpu::RodParameters, most_strands) == 40);
static_assert(offsetof(gpu::RodParameters, stretching) == 48);
static_assert(offsetof(gpu::RodParameters, ellipticity) == 52);
static_assert(offsetof(gpu::RodParameters, damping) == 64);
static_assert(offsetof(gpu::RodParameters, set) == 72 && sizeof(gpu::RodParameters) == 88);

// Scratch memory takes at most 1 / kScratchShare of the device-local heap. It depends on the heap's
// size, not on the free memory, so that the same case always has the same dispatches.
constexpr std::uint64_t kScratchShare = 16;

std::uint64_t scratchOfStrand(const groom::GroomSize& size, std::uint32_t rows) {
    return sizeof(glm::vec4) * rows * size.vertices_per_guide;
}

// Returns the strands per dispatch: all, or whole groups with scratch memory that fits, at least
// one.
std::uint32_t strandsInDispatch(
    const engine::DeviceInfo& device, const groom::GroomSize& size, std::uint32_t rows) {
    const std::uint64_t scratch = std::min<std::uint64_t>(
        device.limits.maxStorageBufferRange, device.local_bytes / kScratchShare);
    const std::uint64_t groups = scratch / (gpu::kRodGroupSize * scratchOfStrand(size, rows));
    const std::uint64_t most = gpu::kRodGroupSize * std::max<std::uint64_t>(groups, 1);
    return static_cast<std::uint32_t>(std::min(most, size.guides));
}

// Returns the way in which `rod` keeps segments out of bodies.
std::uint32_t segmentsOf(const SimulationSettings& settings) {
    if (settings.collision.parts == CollisionParts::vertices) return gpu::kRodNoSegments;
    return settings.rest == RestShape::balanced ? gpu::kRodSegmentsAtRest : gpu::kRodSegments;
}

}  // namespace

// ---- The solver ---------------------------------------------------------------------------------

engine::MemoryRows RodSolver::rows(
    const engine::DeviceInfo& device, const groom::GroomSize& size, const RodMethod& method) {
    const auto vectors = [&](std::uint64_t rows) {
        return engine::bytesOf<glm::vec4>(rows * size.vertices());
    };
    engine::MemoryRows rows(
        "simulation", {{"rod segments", vectors(gpu::kRodSegmentRows)},
                       {"rod units", engine::bytesOf<float>(size.guides)},
                       {"rod motion", vectors(gpu::kRodMotionRows)},
                       {"settled state", vectors(gpu::kRodMotionRows)},
                       {"rod scratch", scratchOfStrand(size, method.scratch_rows) *
                                           strandsInDispatch(device, size, method.scratch_rows)},
                       {"rod parameters", sizeof(gpu::RodParameters)}});
    if (method.integrator != RodIntegrator::implicit_euler)
        rows.add(
            "simulation", {{"rod accelerations", vectors(gpu::kRodAccelerationRows)},
                           {"settled state", vectors(gpu::kRodAccelerationRows)}});
    if (method.set_share > 0.0)
        rows.add("simulation", {{"rod set", vectors(1)}, {"settled state", vectors(1)}});
    return rows;
}

RodMethod rodMethod(const SimulationSettings& settings) {
    return {
        .shader = "simulation/rod.comp",
        .scratch_rows = gpu::kRodScratchRows +
                        (settings.collision.warm_start ? gpu::kRodContactScratchRows : 0) +
                        (segmentsOf(settings) == gpu::kRodNoSegments ? 0 : 1),
        .iterations = settings.rod.iterations,
        .integrator = settings.rod.integrator,
        .damping = settings.material.damping,
        .set_share = settings.material.set_share,
        .set_time = settings.material.set_time};
}

RodMethod stableCosseratMethod(const SimulationSettings& settings) {
    return {
        .shader = "simulation/stable_cosserat.comp",
        .scratch_rows = gpu::kStableCosseratScratchRows,
        .iterations = settings.stable_cosserat.iterations,
        .stretching =
            double{settings.stable_cosserat.stretch_modulus} / wetDensity(settings.material),
        .cosserat = settings.stable_cosserat.method};
}

RodMethod positionBasedMethod(const SimulationSettings& settings) {
    return {
        .shader = "simulation/position_based_rod.comp",
        .scratch_rows = gpu::kPositionBasedScratchRows,
        .iterations = settings.position_based_rod.iterations,
        .stretching = double{settings.material.youngs_modulus} / wetDensity(settings.material)};
}

RodMethod augmentedMassSpringMethod(const SimulationSettings& settings) {
    const AugmentedMassSpringSettings& springs = settings.augmented_mass_spring;
    return {
        .shader = "simulation/augmented_mass_spring.comp",
        .scratch_rows = gpu::kMassSpringScratchRows,
        .iterations = springs.iterations,
        .stretching = double{springs.spring_modulus} / wetDensity(settings.material),
        .integrity = springs.integrity,
        .angular = springs.angular_stiffness};
}

RodSolver::RodSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step, const RodMethod& method)
    : RodSolver(device, groom, settings, step, method, restOfRods(groom, settings, step)) {}

RodSolver::RodSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step, const RodMethod& method, const RodRest& rest)
    : balance_(rest.balance), stretches_(method.stretching > 0.0),
      strand_count_(groom.strand_count),
      most_strands_(strandsInDispatch(device.info(), sizeOf(groom), method.scratch_rows)),
      step_(
          device,
          {.shader = std::string(method.shader) +
                     (device.has(engine::Feature::long_integers) ? "+packed" : ""),
           .constants =
               {{gpu::kContinuousCollisionConstant, settings.collision.continuous},
                {gpu::kEllipticSectionConstant, settings.material.ellipticity != 1.0f},
                {gpu::kWarmStartConstant, settings.collision.warm_start},
                {gpu::kRodSegmentsConstant, segmentsOf(settings)},
                {gpu::kRodAlphaConstant, method.integrator != RodIntegrator::implicit_euler},
                {gpu::kRodDampedConstant, method.damping > 0.0},
                {gpu::kRodSetConstant, method.set_share > 0.0},
                {gpu::kCosseratDescentConstant, method.cosserat == CosseratMethod::descent},
                {gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)}},
           .push_size = sizeof(gpu::SubstepPush)}),
      adopt_(
          device, {.shader = "simulation/rod_adopt.comp",
                   .constants = {{gpu::kSkinnedRootsConstant, hasSkinnedRoots(settings)}},
                   .push_size = sizeof(gpu::SubstepPush)}) {
    const engine::MemoryRows rows = RodSolver::rows(device.info(), sizeOf(groom), method);
    segments_ = engine::makeBuffer(device, rest.segments, rows, "rod segments");
    units_ = engine::makeBuffer(device, rest.units, rows, "rod units");
    motion_ = {device, rows["rod motion"]};
    if (method.integrator != RodIntegrator::implicit_euler)
        accelerations_.emplace(device, rows["rod accelerations"]);
    if (method.set_share > 0.0) set_ = engine::makeBuffer(device, rest.set, rows, "rod set");
    const double relaxation = double{step.sub} / method.set_time;
    scratch_ = {device, rows["rod scratch"]};
    parameters_ = engine::makeBuffer(
        device,
        std::array{gpu::RodParameters{
            .segments = segments_.address(),
            .units = units_.address(),
            .motion = motion_.address(),
            .scratch = scratch_.address(),
            .accelerations = accelerations_ ? accelerations_->address() : 0,
            .most_strands = most_strands_,
            .iterations = method.iterations,
            .stretching = static_cast<float>(method.stretching * step.sub * step.sub),
            .ellipticity = settings.material.ellipticity,
            .integrity = static_cast<float>(method.integrity * step.sub * step.sub),
            .angular = static_cast<float>(method.angular * step.sub * step.sub),
            .damping = static_cast<float>(method.damping / step.sub),
            .set_share = static_cast<float>(method.set_share),
            .set = set_ ? set_->address() : 0,
            .set_kept = static_cast<float>(std::exp(-relaxation)),
            .set_mean = static_cast<float>(-std::expm1(-relaxation) / relaxation)}},
        rows, "rod parameters");
}

void RodSolver::record(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    for (std::uint32_t first = 0; first < strand_count_; first += most_strands_) {
        push.first_strand = first;
        commands.bind(step_, push);
        if (first > 0) commands.usesAgain();
        commands.uses({{motion_, Access::compute_write}, {scratch_, Access::compute_write}});
        if (accelerations_) commands.uses({{*accelerations_, Access::compute_write}});
        if (set_) commands.uses({{*set_, Access::compute_write}});
        commands.dispatchInvocations(
            std::min(most_strands_, strand_count_ - first), gpu::kRodGroupSize);
    }
}

std::vector<const engine::Buffer*> RodSolver::state() const {
    std::vector<const engine::Buffer*> state{&motion_};
    if (accelerations_) state.push_back(&*accelerations_);
    if (set_) state.push_back(&*set_);
    return state;
}

// Rods that stretch have another energy.
ElasticRods RodSolver::elasticRods() const {
    if (stretches_) return {};
    return {
        .parameters = parameters_.address(),
        .motion = motion_.address(),
        .set = set_ ? set_->address() : 0};
}

void RodSolver::recordAdopt(engine::Commands& commands, gpu::SubstepPush push) const {
    push.solver = parameters_.address();
    commands.bind(adopt_, push);
    commands.uses({{motion_, Access::compute_write}});
    if (accelerations_) commands.uses({{*accelerations_, Access::compute_write}});
    commands.dispatchInvocations(strand_count_, gpu::kRodGroupSize);
}

}  // namespace hair::simulation
