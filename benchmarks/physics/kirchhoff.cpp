#include "benchmarks/physics/kirchhoff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "benchmarks/physics/theory.h"

namespace benchmarks::physics {
namespace {

constexpr int kRodSteps = 500;

// Integrates with fourth-order Runge-Kutta from the tip of a rod of length 1 to its clamp, by the
// distance z from the tip.
template <std::size_t kSize, class Slope>
std::array<double, kSize> integrate(std::array<double, kSize> at, const Slope& slope) {
    constexpr double h = 1.0 / kRodSteps;
    using State = std::array<double, kSize>;
    const auto moved = [](const State& from, double by, const State& along) {
        State to = from;
        for (std::size_t i = 0; i < kSize; ++i) to[i] += by * along[i];
        return to;
    };
    for (int i = 0; i < kRodSteps; ++i) {
        const double z = i * h;
        const State k1 = slope(z, at);
        const State k2 = slope(z + h / 2.0, moved(at, h / 2.0, k1));
        const State k3 = slope(z + h / 2.0, moved(at, h / 2.0, k2));
        const State k4 = slope(z + h, moved(at, h, k3));
        for (std::size_t j = 0; j < kSize; ++j)
            at[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
    }
    return at;
}

// Finds a root near `at` by Newton's method with finite differences. Steps are at most `most` long.
// NaN if it is not found.
template <class Function>
double rootNear(double at, double most, const Function& function) {
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 50; ++i) {
        const double slope = (function(at + kStep) - function(at - kStep)) / (2.0 * kStep);
        const double change = std::clamp(-function(at) / slope, -most, most);
        at += change;
        if (std::abs(change) < 1e-11) return at;
    }
    return std::nan("");
}

// Finds a root of a system of equations by Newton's method with differences.
template <class Vector, class Matrix, class Function>
std::optional<Vector> rootsNear(Vector at, double most, const Function& function) {
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 50; ++i) {
        Matrix slopes;
        for (int j = 0; j < Vector::length(); ++j) {
            Vector more = at;
            Vector less = at;
            more[j] += kStep;
            less[j] -= kStep;
            slopes[j] = (function(more) - function(less)) / (2.0 * kStep);
        }
        Vector change = glm::inverse(slopes) * -function(at);
        const double size = glm::length(change);
        if (!(size < 1e9)) return {};
        change *= most / std::max(size, most);
        at += change;
        if (size < 1e-9) return at;
    }
    return {};
}

// ---- A rod in its plane, and small rotations out of it ------------------------------------------

// In units of the length and the strong stiffness.
struct UnitRod {
    double weak, twisting;
    double weight;
    double clamp;
    double turn;
};

UnitRod unitRod(const ClampedRod& rod) {
    return {
        .weak = rod.section.weak / rod.section.strong,
        .twisting = rod.section.twisting / rod.section.strong,
        .weight = rod.weight * std::pow(rod.length, 3.0) / rod.section.strong,
        .clamp = rod.clamp,
        .turn = rod.turn};
}

// Angle from -y and its derivative by s, then a2, a3, M2 and M3 of two states that begin at the
// tip.
using PlanarState = std::array<double, 10>;

PlanarState fromTip(const UnitRod& rod, double tip) {
    const auto slope = [&](double z, const PlanarState& at) {
        const double below = rod.weight * z;
        const double n2 = below * std::sin(at[0]);
        const double n3 = below * std::cos(at[0]);
        const double curvature = at[1];
        const double moment = curvature - rod.turn;
        PlanarState change{-curvature, -n2};
        for (std::size_t first = 2; first < 10; first += 4) {
            const double a2 = at[first];
            const double a3 = at[first + 1];
            const double m2 = at[first + 2];
            const double m3 = at[first + 3];
            change[first] = -((m2 - moment * a3) / rod.weak + curvature * a3);
            change[first + 1] = -((m3 + moment * a2) / rod.twisting - curvature * a2);
            change[first + 2] = -(curvature * m3 + n3 * a2);
            change[first + 3] = curvature * m2 + n2 * a2;
        }
        return change;
    };
    return integrate<10>({tip, rod.turn, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0}, slope);
}

// The tip's angle of the rod at rest in its plane, starting from that of a slightly different rod.
double tipNear(const UnitRod& rod, double tip) {
    return rootNear(tip, 0.2, [&](double angle) { return fromTip(rod, angle)[0] - rod.clamp; });
}

double stabilityOf(const UnitRod& rod, double tip) {
    const PlanarState at = fromTip(rod, tip);
    return at[2] * at[7] - at[3] * at[6];
}

// Follows the planar states as the weight grows from 0.
class GrowingWeight {
public:
    explicit GrowingWeight(const UnitRod& rod) : rod_(rod), tip_(rod.clamp + rod.turn) {
        rod_.weight = 0.0;
    }

    void growTo(double weight) {
        while (rod_.weight < weight) {
            rod_.weight = std::min(weight, next());
            tip_ = tipNear(rod_, tip_);
        }
    }

    // The next weight, to which the planar state can be followed in one step. On the way the rod
    // leaves its plane at most once: it does so above 12 sqrt(B C).
    double next() const {
        return std::max(
            1.03 * rod_.weight, rod_.weight + 0.2 * std::sqrt(rod_.weak * rod_.twisting));
    }

    const UnitRod& rod() const { return rod_; }
    double tip() const { return tip_; }
    double stability() const { return stabilityOf(rod_, tip_); }

private:
    UnitRod rod_;
    double tip_;
};

// The state in which the rod leaves its plane, up to its own weight.
std::optional<GrowingWeight> leavingPlane(const UnitRod& rod) {
    GrowingWeight growing(rod);
    GrowingWeight before = growing;
    while (growing.stability() > 0.0) {
        if (!(growing.rod().weight < rod.weight)) return {};
        before = growing;
        growing.growTo(std::min(rod.weight, before.next()));
    }
    if (!(growing.stability() <= 0.0)) return {};
    double high = growing.rod().weight;
    for (int i = 0; i < 40; ++i) {
        GrowingWeight middle = before;
        middle.growTo((before.rod().weight + high) / 2.0);
        if (middle.stability() > 0.0)
            before = middle;
        else
            high = middle.rod().weight;
    }
    return before;
}

}  // namespace

SectionStiffness sectionStiffness(const hair::MaterialSettings& material) {
    const double longer = double{material.radius} * std::sqrt(double{material.ellipticity});
    const double shorter = double{material.radius} / std::sqrt(double{material.ellipticity});
    const double young = double{material.youngs_modulus};
    return {
        .strong = young * kPi * std::pow(longer, 3.0) * shorter / 4.0,
        .weak = young * kPi * longer * std::pow(shorter, 3.0) / 4.0,
        .twisting = double{material.shear_modulus} * kPi * std::pow(longer * shorter, 3.0) /
                    (longer * longer + shorter * shorter)};
}

double outOfPlaneStability(const ClampedRod& rod) {
    GrowingWeight growing(unitRod(rod));
    growing.growTo(unitRod(rod).weight);
    return growing.stability();
}

std::optional<double> bucklingLength(ClampedRod rod, double most) {
    rod.length = most;
    const auto leaving = leavingPlane(unitRod(rod));
    if (!leaving) return {};
    return std::cbrt(leaving->rod().weight * rod.section.strong / rod.weight);
}

std::optional<double> leavingTurn(ClampedRod rod, double most) {
    const auto stays = [&](double turn) {
        rod.turn = turn;
        return outOfPlaneStability(rod) > 0.0;
    };
    double high = 1.0;
    while (stays(high))
        if (++high > most) return {};
    double low = high - 1.0;
    for (int i = 0; i < 13; ++i) {
        const double middle = (low + high) / 2.0;
        (stays(middle) ? low : high) = middle;
    }
    return low;
}

namespace {

// ---- A rod out of its plane ---------------------------------------------------------------------

// Position and orientation of the clamp if the tip is at the origin with the given orientation. The
// third axis of frames is the tangent; strong bending is round the first.
struct FromTip {
    glm::dvec3 clamp;
    glm::dquat frame;
};

// Position, frame and moment by the distance z from the tip: m' = -t x n. The frame turns with the
// curvature m.d1 + turn, m.d2 / B, m.d3 / C.
FromTip spaceFromTip(const UnitRod& rod, const glm::dquat& tip) {
    using SpaceState = std::array<double, 10>;
    const auto slope = [&](double z, const SpaceState& at) {
        const glm::dquat frame = glm::normalize(glm::dquat(at[3], at[4], at[5], at[6]));
        const glm::dvec3 moment(at[7], at[8], at[9]);
        const glm::dvec3 tangent = frame * glm::dvec3(0.0, 0.0, 1.0);
        const glm::dvec3 own = glm::conjugate(frame) * moment;
        const glm::dvec3 curvature(own.x + rod.turn, own.y / rod.weak, own.z / rod.twisting);
        const glm::dquat turned = glm::dquat(0.0, -0.5 * (frame * curvature)) * frame;
        const glm::dvec3 change = glm::cross(tangent, glm::dvec3(0.0, -rod.weight * z, 0.0));
        return SpaceState{-tangent.x, -tangent.y, -tangent.z, turned.w, turned.x,
                          turned.y,   turned.z,   change.x,   change.y, change.z};
    };
    const SpaceState at =
        integrate<10>({0.0, 0.0, 0.0, tip.w, tip.x, tip.y, tip.z, 0.0, 0.0, 0.0}, slope);
    return {{at[0], at[1], at[2]}, glm::normalize(glm::dquat(at[3], at[4], at[5], at[6]))};
}

// The frame of a section in the plane; its first axis is +z.
glm::dquat planarFrame(double angle) {
    const glm::dvec3 tangent(std::sin(angle), -std::cos(angle), 0.0);
    const glm::dvec3 out(0.0, 0.0, 1.0);
    return glm::quat_cast(glm::dmat3(out, glm::cross(tangent, out), tangent));
}

// The rotation by a vector, to second order.
glm::dquat rotationBy(const glm::dvec3& vector) {
    return glm::normalize(glm::dquat(1.0, 0.5 * vector));
}

}  // namespace

std::optional<glm::dvec3> buckledTip(const ClampedRod& rod) {
    UnitRod unit = unitRod(rod);
    const double weight = unit.weight;
    const auto leaving = leavingPlane(unit);
    if (!leaving) return {};
    const glm::dquat planar_tip = planarFrame(leaving->tip());
    const glm::dquat clamp = planarFrame(unit.clamp);
    // Rotation from the clamp's required orientation to the computed one.
    const auto missed = [&](const glm::dvec3& turn, double with_weight) {
        unit.weight = with_weight;
        const FromTip end = spaceFromTip(unit, planar_tip * rotationBy(turn));
        const glm::dquat off = glm::conjugate(clamp) * end.frame;
        return glm::dvec3(off.x, off.y, off.z) * (off.w < 0.0 ? -2.0 : 2.0);
    };
    // Follows the branch by the tip's rotation round its second axis, with the weight as an
    // unknown, up to the rod's own weight.
    glm::dvec3 at(0.0, 0.0, leaving->rod().weight);  // rotations round the other axes, and weight
    double sideways = 0.0;
    while (at.z < weight) {
        sideways += 0.05;
        if (sideways > 3.0) return {};
        const auto next = rootsNear<glm::dvec3, glm::dmat3>(
            at, 0.3, [&](const glm::dvec3& x) { return missed({x.x, sideways, x.y}, x.z); });
        if (!next) return {};
        at = *next;
    }
    const auto turn = rootsNear<glm::dvec3, glm::dmat3>(
        {at.x, sideways, at.y}, 0.3, [&](const glm::dvec3& x) { return missed(x, weight); });
    if (!turn) return {};
    glm::dvec3 tip = -rod.length * spaceFromTip(unit, planar_tip * rotationBy(*turn)).clamp;
    tip.z = std::abs(tip.z);
    return tip;
}

namespace {

// ---- A rod pressed onto the ground --------------------------------------------------------------

// Angle from the vertical, its slope, x and y at the clamp.
std::array<double, 4> pressedFromTip(double tip, const glm::dvec2& forces, double length) {
    const auto slope = [&](double, const std::array<double, 4>& at) {
        const double bends = forces.x * std::cos(at[0]) - forces.y * std::sin(at[0]);
        return std::array{
            length * at[1], length * bends, length * std::sin(at[0]), length * std::cos(at[0])};
    };
    return integrate<4>({tip, 0.0, 0.0, 0.0}, slope);
}

}  // namespace

std::optional<PressedRod> pressedRod(double force_ratio) {
    // Where the straight rod buckles, Q / P is 0.1785 of the tip's angle: psi = c (cos k z - cos k)
    // with tan k = k.
    constexpr double kBuckling = 4.493409457909064;
    glm::dvec2 forces(0.0, kBuckling * kBuckling);
    glm::dvec2 forces_before = forces;
    const auto solve = [&](double tip, const glm::dvec2& near) {
        return rootsNear<glm::dvec2, glm::dmat2>(near, 3.0, [&](const glm::dvec2& x) {
            const auto clamp = pressedFromTip(tip, x, 1.0);
            return glm::dvec2(clamp[0], clamp[2]);
        });
    };
    constexpr double kStep = 0.02;  // rad, of the tip's angle
    double tip = 0.0;
    while (std::abs(forces.x) < force_ratio * forces.y) {
        forces_before = forces;
        tip += kStep;
        if (tip > kPi / 2.0) return {};
        const auto next = solve(tip, forces);
        if (!next) return {};
        forces = *next;
    }
    double low = tip - kStep;
    for (double high = tip; high - low > 1e-12;) {
        tip = (low + high) / 2.0;
        const auto between = solve(tip, forces_before);
        if (!between) return {};
        forces = *between;
        (std::abs(forces.x) < force_ratio * forces.y ? low : high) = tip;
    }
    const auto clamp = pressedFromTip(tip, forces, 1.0);
    const auto middle = pressedFromTip(tip, forces, 0.5);
    return PressedRod{
        .compression = 1.0 - clamp[3],
        .pressure = forces.y,
        .shear = std::abs(forces.x),
        .middle = {std::abs(middle[2]), middle[3]}};
}

namespace {

// ---- A rod of segments in its plane -------------------------------------------------------------

// A square matrix, row by row.
class Dense {
public:
    explicit Dense(std::size_t size) : size_(size), entries_(size * size, 0.0) {}

    std::size_t size() const { return size_; }
    double& operator()(std::size_t row, std::size_t column) {
        return entries_[row * size_ + column];
    }
    double operator()(std::size_t row, std::size_t column) const {
        return entries_[row * size_ + column];
    }
    std::vector<double>& entries() { return entries_; }

private:
    std::size_t size_;
    std::vector<double> entries_;
};

Dense operator*(const Dense& a, const Dense& b) {
    Dense product(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < a.size(); ++k) {
            const double factor = a(i, k);
            for (std::size_t j = 0; j < a.size(); ++j) product(i, j) += factor * b(k, j);
        }
    return product;
}

// Scales the matrix to the norm 1 and returns its norm (of Frobenius).
double normalise(Dense& matrix) {
    double squares = 0.0;
    for (const double entry : matrix.entries()) squares += entry * entry;
    const double norm = std::sqrt(squares);
    for (double& entry : matrix.entries()) entry /= norm;
    return norm;
}

// Gauss's elimination with row pivots: the columns become the solutions of matrix * x = column.
void solve(Dense matrix, std::vector<std::vector<double>>& columns) {
    const std::size_t size = matrix.size();
    for (std::size_t i = 0; i < size; ++i) {
        std::size_t pivot = i;
        for (std::size_t row = i + 1; row < size; ++row)
            if (std::abs(matrix(row, i)) > std::abs(matrix(pivot, i))) pivot = row;
        for (std::size_t j = 0; j < size; ++j) std::swap(matrix(i, j), matrix(pivot, j));
        for (auto& column : columns) std::swap(column[i], column[pivot]);
        for (std::size_t row = i + 1; row < size; ++row) {
            const double factor = matrix(row, i) / matrix(i, i);
            for (std::size_t j = i; j < size; ++j) matrix(row, j) -= factor * matrix(i, j);
            for (auto& column : columns) column[row] -= factor * column[i];
        }
    }
    for (auto& column : columns)
        for (std::size_t i = size; i-- > 0;) {
            for (std::size_t j = i + 1; j < size; ++j) column[i] -= matrix(i, j) * column[j];
            column[i] /= matrix(i, i);
        }
}

glm::dvec2 tangentAt(double angle) { return {std::sin(angle), -std::cos(angle)}; }
glm::dvec2 normalAt(double angle) { return {std::cos(angle), std::sin(angle)}; }

// The air presses on both ends of a segment, half of it on each, because the mass is there.
// Pressure on its middle alone would not damp a zigzag. The places are parts of its length.
constexpr double kPressed[] = {0.0, 1.0};

// The generalised force on each angle, N m, at these rates, 1/s.
std::vector<double>
planarForce(const PlanarRod& rod, std::span<const double> angles, std::span<const double> rates) {
    const std::size_t count = angles.size();
    const double segment = rod.length / static_cast<double>(count);
    std::vector<double> force(count);
    std::vector<glm::dvec2> loads;  // on vertices and on whole segments, N
    glm::dvec2 point = rod.root;
    glm::dvec2 velocity(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 normal = normalAt(angles[i]);
        const double turning = segment * rates[i];
        double pressure = 0.0;
        if (rod.pressure)
            for (const double part : kPressed) {
                const double across = glm::dot(rod.wind - velocity, normal) - part * turning;
                const double half = 0.5 * segment * rod.pressure(across);
                pressure += half;
                force[i] += segment * (part - 1.0) * half;  // of the whole, which is added below
            }
        point += segment * tangentAt(angles[i]);
        velocity += turning * normal;
        loads.push_back(rod.masses[i] * rod.field(point) + pressure * normal);
    }
    glm::dvec2 below(0.0);
    for (std::size_t i = count; i-- > 0;) {
        below += loads[i];
        force[i] += segment * glm::dot(normalAt(angles[i]), below);
        const double natural = rod.turn / static_cast<double>(count);
        const double above = i == 0 ? 2.0 * (angles[0] - rod.clamp - natural / 2.0)
                                    : angles[i] - angles[i - 1] - natural;
        const double next = i + 1 < count ? angles[i + 1] - angles[i] - natural : 0.0;
        force[i] += rod.stiffness / segment * (next - above);
    }
    return force;
}

// The derivatives of the generalised force, [angle] -> change of all forces, by central
// differences.
std::vector<std::vector<double>>
forceSlopes(const PlanarRod& rod, std::span<const double> angles, bool by_rates) {
    constexpr double kStep = 1e-5;
    std::vector<std::vector<double>> slopes;
    std::vector<double> at(angles.begin(), angles.end());
    std::vector<double> rates(at.size(), 0.0);
    std::vector<double>& varied = by_rates ? rates : at;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double middle = varied[i];
        varied[i] = middle + kStep;
        std::vector<double> slope = planarForce(rod, at, rates);
        varied[i] = middle - kStep;
        const std::vector<double> less = planarForce(rod, at, rates);
        varied[i] = middle;
        for (std::size_t j = 0; j < slope.size(); ++j)
            slope[j] = (slope[j] - less[j]) / (2.0 * kStep);
        slopes.push_back(std::move(slope));
    }
    return slopes;
}

// l^2 times the mass below both segments.
Dense levers(const PlanarRod& rod) {
    const std::size_t count = rod.masses.size();
    const double square = std::pow(rod.length / static_cast<double>(count), 2.0);
    Dense lever(count);
    double below = 0.0;
    for (std::size_t i = count; i-- > 0;) {
        below += square * rod.masses[i];
        for (std::size_t k = 0; k <= i; ++k) lever(i, k) = lever(k, i) = below;
    }
    return lever;
}

Dense massMatrix(const Dense& lever, std::span<const double> angles) {
    Dense mass(angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i)
        for (std::size_t k = 0; k < angles.size(); ++k)
            mass(i, k) = lever(i, k) * std::cos(angles[i] - angles[k]);
    return mass;
}

// The angles' second derivatives by time, 1/s^2.
std::vector<double> planarAcceleration(
    const PlanarRod& rod, std::span<const double> angles, std::span<const double> rates) {
    const Dense lever = levers(rod);
    std::vector<std::vector<double>> columns{planarForce(rod, angles, rates)};
    for (std::size_t i = 0; i < angles.size(); ++i)
        for (std::size_t k = 0; k < angles.size(); ++k)
            columns[0][i] += lever(i, k) * std::sin(angles[k] - angles[i]) * rates[k] * rates[k];
    solve(massMatrix(lever, angles), columns);
    return std::move(columns[0]);
}

}  // namespace

PlanarRod
planarHair(const hair::SimulationSettings& settings, std::size_t segments, double length) {
    const glm::dvec2 gravity(glm::dvec3(settings.gravity));
    PlanarRod rod{
        .stiffness = bendingStiffness(settings.material),
        .length = length,
        .clamp = 0.0,
        .masses = std::vector<double>(
            segments, lineDensity(settings.material) * length / static_cast<double>(segments)),
        .field = [gravity](const glm::dvec2&) { return gravity; }};
    rod.masses.back() /= 2.0;
    if (settings.wind.mode != hair::WindMode::drag) return rod;
    rod.wind = {double{settings.wind.speed}, 0.0};
    rod.pressure = [settings](double across) {
        return std::copysign(dragPerLength(settings, std::abs(across)), across);
    };
    return rod;
}

std::vector<glm::dvec2> planarPoints(const PlanarRod& rod, std::span<const double> angles) {
    std::vector<glm::dvec2> points{rod.root};
    for (const double angle : angles)
        points.push_back(
            points.back() + rod.length / static_cast<double>(angles.size()) * tangentAt(angle));
    return points;
}

std::optional<std::vector<double>> planarRest(const PlanarRod& rod, std::vector<double> angles) {
    constexpr double kMost = 0.3;  // rad in a step
    const std::vector<double> still(angles.size(), 0.0);
    for (int i = 0; i < 100; ++i) {
        const auto slopes = forceSlopes(rod, angles, false);
        Dense matrix(angles.size());
        for (std::size_t column = 0; column < angles.size(); ++column)
            for (std::size_t row = 0; row < angles.size(); ++row)
                matrix(row, column) = -slopes[column][row];
        std::vector<std::vector<double>> change{planarForce(rod, angles, still)};
        solve(std::move(matrix), change);
        double greatest = 0.0;
        for (const double each : change[0]) greatest = worst(greatest, std::abs(each));
        if (!std::isfinite(greatest)) return {};
        const double scale = kMost / std::max(greatest, kMost);
        for (std::size_t j = 0; j < angles.size(); ++j) angles[j] += scale * change[0][j];
        if (greatest < 1e-9) return angles;
    }
    return {};
}

double planarGrowth(const PlanarRod& rod, std::span<const double> rest) {
    // M a'' = K a + C a'. In units of the fastest rate, the matrix has entries of similar size.
    const std::size_t count = rest.size();
    const Dense mass = massMatrix(levers(rod), rest);
    std::vector<std::vector<double>> by_angles = forceSlopes(rod, rest, false);
    std::vector<std::vector<double>> by_rates = forceSlopes(rod, rest, true);
    solve(mass, by_angles);
    solve(mass, by_rates);
    double greatest = 0.0;
    for (const auto& column : by_angles)
        for (const double entry : column) greatest = std::max(greatest, std::abs(entry));
    const double unit = std::sqrt(greatest);
    Dense small(2 * count);  // A times a short time
    const double time = 0.1 / (unit * static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
        small(i, count + i) = time * unit;
        for (std::size_t j = 0; j < count; ++j) {
            small(count + i, j) = time * by_angles[j][i] / unit;
            small(count + i, count + j) = time * by_rates[j][i];
        }
    }
    // exp of the short time by its series, whose terms fall by 0.2 and more.
    Dense power(2 * count);
    Dense term(2 * count);
    for (std::size_t i = 0; i < 2 * count; ++i) power(i, i) = term(i, i) = 1.0;
    for (int i = 1; i <= 16; ++i) {
        term = term * small;
        for (double& entry : term.entries()) entry /= i;
        for (std::size_t j = 0; j < power.entries().size(); ++j)
            power.entries()[j] += term.entries()[j];
    }
    // ln |exp(A t)| at t, 2 t, 4 t ... up to some 1,000 s.
    double logarithm = std::log(normalise(power));
    double span = time;
    double before = 0.0;
    while (span < 1000.0) {
        before = logarithm;
        power = power * power;
        logarithm = 2.0 * logarithm + std::log(normalise(power));
        span *= 2.0;
    }
    return (logarithm - before) / (span / 2.0);
}

void advancePlanar(
    const PlanarRod& rod, std::vector<double>& angles, std::vector<double>& rates, double step) {
    const auto moved = [](const std::vector<double>& from, double by,
                          const std::vector<double>& along) {
        std::vector<double> to = from;
        for (std::size_t i = 0; i < to.size(); ++i) to[i] += by * along[i];
        return to;
    };
    const auto a1 = planarAcceleration(rod, angles, rates);
    const auto r2 = moved(rates, step / 2.0, a1);
    const auto a2 = planarAcceleration(rod, moved(angles, step / 2.0, rates), r2);
    const auto r3 = moved(rates, step / 2.0, a2);
    const auto a3 = planarAcceleration(rod, moved(angles, step / 2.0, r2), r3);
    const auto r4 = moved(rates, step, a3);
    const auto a4 = planarAcceleration(rod, moved(angles, step, r3), r4);
    for (std::size_t i = 0; i < angles.size(); ++i) {
        angles[i] += step / 6.0 * (rates[i] + 2.0 * r2[i] + 2.0 * r3[i] + r4[i]);
        rates[i] += step / 6.0 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
    }
}

}  // namespace benchmarks::physics
