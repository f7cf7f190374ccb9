#include "benchmarks/physics/theory.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace benchmarks::physics {
namespace {

// ---- Catenary -----------------------------------------------------------------------------------

// Solves 2 a sinh(span / 2 a) = length for a by bisection on u = span / 2 a; sinh(u) / u is
// increasing.
double solveParameter(double span, double length) {
    double low = 1e-9;
    double high = 700.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (std::sinh(middle) / middle < length / span ? low : high) = middle;
    }
    return span / (low + high);
}

}  // namespace

Catenary::Catenary(double span, double length)
    : span_(span), length_(length), parameter_(solveParameter(span, length)) {
    assert(0.0 < span && span < length);
}

glm::dvec2 Catenary::at(double s) const {
    const double a = parameter_;
    const double u = s - length_ / 2.0;  // from the lowest point
    return {span_ / 2.0 + a * std::asinh(u / a), std::hypot(a, u) - std::hypot(a, length_ / 2.0)};
}

namespace {

// ---- Small deflections of a strand --------------------------------------------------------------

// The greatest slope of a strand in a small vibration. Its effect on a pendulum's frequency is
// 0.03^2 / 16, 6e-5.
inline constexpr double kSmallSlope = 0.03;

// A strand from the origin along `direction` with vertices displaced along `sideways` in proportion
// to `shape` (root first). Its steepest segment has kSmallSlope, and segments keep their length.
// Both vectors are unit vectors, perpendicular to each other. m
std::vector<glm::dvec3> deflected(
    std::span<const double> shape, double segment, const glm::dvec3& direction,
    const glm::dvec3& sideways) {
    double steepest = 0.0;
    for (std::size_t i = 1; i < shape.size(); ++i)
        steepest = std::max(steepest, std::abs(shape[i] - shape[i - 1]));
    std::vector<glm::dvec3> points{glm::dvec3(0.0)};
    for (std::size_t i = 1; i < shape.size(); ++i) {
        const double slope = kSmallSlope * (shape[i] - shape[i - 1]) / steepest;
        points.push_back(
            points.back() +
            segment * (slope * sideways + std::sqrt(1.0 - slope * slope) * direction));
    }
    return points;
}

// Sum of displacement along `sideways` times shape: the amplitude of the shape, in arbitrary scale.
double amountOf(
    std::span<const double> shape, std::span<const glm::dvec3> positions,
    const glm::dvec3& sideways) {
    double sum = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i)
        sum += shape[i] * glm::dot(positions[i], sideways);
    return sum;
}

// ---- Energy -------------------------------------------------------------------------------------

// The clamp's joint is half a segment long; the other half would be in the skin.
double bendingEnergy(
    std::span<const glm::dvec3> points, double stiffness, double segment,
    const glm::dvec3& clamp_tangent) {
    double energy = 0.0;
    glm::dvec3 before = clamp_tangent;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 tangent = glm::normalize(points[i] - points[i - 1]);
        const double angle =
            std::atan2(glm::length(glm::cross(before, tangent)), glm::dot(before, tangent));
        energy += 0.5 * stiffness * angle * angle / (i == 1 ? segment / 2.0 : segment);
        before = tangent;
    }
    return energy;
}

}  // namespace

double energyOf(
    std::span<const glm::dvec3> before, std::span<const glm::dvec3> after,
    const hair::SimulationSettings& settings, double length) {
    const std::size_t count = after.size();
    const double segment = length / static_cast<double>(count - 1);
    // A file's solver may store elastic energy in any way, so none is counted.
    const bool rod =
        settings.solver != hair::Solver::extension && !lack(settings.solver, Need::material);
    std::vector<glm::dvec3> points{after[0]};
    double energy = 0.0;
    for (std::size_t i = 1; i < count; ++i) {
        points.push_back(0.5 * (before[i] + after[i]));
        const glm::dvec3 velocity = (after[i] - before[i]) / double{settings.time_step};
        // In a solver with heavy segments, only one segment ends at the tip.
        const bool half = lack(settings.solver, Need::equal_masses) && i + 1 == count;
        const double mass = lineDensity(settings.material) * segment * (half ? 0.5 : 1.0);
        energy += mass * (0.5 * glm::dot(velocity, velocity) + kGravity * points[i].y);
    }
    if (rod)
        energy +=
            bendingEnergy(points, bendingStiffness(settings.material), segment, {1.0, 0.0, 0.0});
    return energy;
}

// ---- Frequency of samples -----------------------------------------------------------------------

std::optional<double> frequencyOf(std::span<const double> samples, double interval) {
    double first = 0.0;
    double last = 0.0;
    int crossings = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double a = samples[i - 1];
        const double b = samples[i];
        if ((a < 0.0) == (b < 0.0)) continue;
        last = static_cast<double>(i - 1) + a / (a - b);
        if (crossings++ == 0) first = last;
    }
    if (crossings < 3) return {};
    return (crossings - 1) / (2.0 * interval * (last - first));
}

namespace {

// ---- Cantilever under its weight ----------------------------------------------------------------

constexpr int kSteps = 4000;

struct Hanging {
    double angle;  // from the vertical, rad
    double drop, reach;
};

// Integrates with fourth-order Runge-Kutta from the tip, where the angle from the vertical is
// `angle`, to the clamp: phi = pi / 2 - theta and z = 1 - s give phi'' = gamma z sin phi.
Hanging hangFromTip(double gamma, double natural_turn, double angle) {
    const double h = 1.0 / kSteps;
    double slope = natural_turn;
    Hanging hanging{.angle = angle, .drop = 0.0, .reach = 0.0};
    for (int i = 0; i < kSteps; ++i) {
        const double z = i * h;
        const auto bend = [&](double at, double phi) { return gamma * at * std::sin(phi); };
        const double k1 = bend(z, angle);
        const double p2 = angle + h / 2.0 * slope;
        const double k2 = bend(z + h / 2.0, p2);
        const double p3 = angle + h / 2.0 * (slope + h / 2.0 * k1);
        const double k3 = bend(z + h / 2.0, p3);
        const double p4 = angle + h * (slope + h / 2.0 * k2);
        const double k4 = bend(z + h, p4);
        const double next = angle + h * slope + h * h / 6.0 * (k1 + k2 + k3);
        slope += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        // Simpson's rule; the angle in the middle is the mean of its two estimates.
        const double middle = (p2 + p3) / 2.0;
        hanging.drop += h / 6.0 * (std::cos(angle) + 4.0 * std::cos(middle) + std::cos(next));
        hanging.reach += h / 6.0 * (std::sin(angle) + 4.0 * std::sin(middle) + std::sin(next));
        angle = next;
        if (std::abs(angle) > kPi) break;  // over the top: other solutions lie beyond
    }
    hanging.angle = angle;
    return hanging;
}

}  // namespace

double cantileverRatio(double gamma, double natural_turn) {
    // Bisection over the tip's angle. For a long rod it is exponentially close to the vertical, so
    // steps are logarithmic, for either sign.
    constexpr double kNearest = 1e-40;
    const auto tip = [](double y) { return kNearest * std::sinh(y); };
    double high = std::asinh(kPi / kNearest);
    double low = -high;
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2.0;
        const bool beyond = hangFromTip(gamma, natural_turn, tip(middle)).angle > kPi / 2.0;
        (beyond ? high : low) = middle;
    }
    const Hanging hanging = hangFromTip(gamma, natural_turn, tip(low));
    return hanging.drop / hanging.reach;
}

namespace {

// ---- Drag of air --------------------------------------------------------------------------------

constexpr int kDragSteps = 1000;

struct DraggedRod {
    double stiffness;  // EI, N m^2
    double weight;  // N/m
    double speed;  // m/s
    const hair::SimulationSettings& settings;
};

// A section of the rod; `reach` and `drop` are from the tip.
struct Section {
    double angle;  // of the tangent from the wind's direction, pi / 2 - theta
    double curvature = 0.0;  // theta'
    double shear = 0.0;  // N
    double tension = 0.0;  // T
    double reach = 0.0;
    double drop = 0.0;
};

Section operator+(const Section& a, const Section& b) {
    return {a.angle + b.angle,     a.curvature + b.curvature, a.shear + b.shear,
            a.tension + b.tension, a.reach + b.reach,         a.drop + b.drop};
}

Section operator*(double h, const Section& a) {
    return {h * a.angle, h * a.curvature, h * a.shear, h * a.tension, h * a.reach, h * a.drop};
}

double dragAlongPerLength(const hair::SimulationSettings& settings, double speed) {
    return double{settings.wind.drag_along} * double{settings.wind.air_viscosity} * speed;  // N/m
}

// The derivative by the length z from the tip.
Section slopeAt(const DraggedRod& rod, const Section& at) {
    const double sine = std::sin(at.angle);
    const double cosine = std::cos(at.angle);
    const double across = rod.speed * sine;
    const double pressed = std::copysign(dragPerLength(rod.settings, std::abs(across)), across);
    return {
        .angle = at.curvature,
        .curvature = at.shear / rod.stiffness,
        .shear = pressed + at.tension * at.curvature - rod.weight * cosine,
        .tension = rod.weight * sine + dragAlongPerLength(rod.settings, rod.speed * cosine) -
                   at.shear * at.curvature,
        .reach = cosine,
        .drop = sine};
}

// Integrates with fourth-order Runge-Kutta from the tip, where the angle is `angle`, to the clamp.
Section draggedFromTip(const DraggedRod& rod, double length, double angle) {
    const double h = length / kDragSteps;
    Section at{.angle = angle};
    for (int i = 0; i < kDragSteps && std::abs(at.angle) <= kPi; ++i) {
        const Section k1 = slopeAt(rod, at);
        const Section k2 = slopeAt(rod, at + h / 2.0 * k1);
        const Section k3 = slopeAt(rod, at + h / 2.0 * k2);
        const Section k4 = slopeAt(rod, at + h * k3);
        at = at + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return at;
}

}  // namespace

double dragPerLength(const hair::SimulationSettings& settings, double speed) {
    const double density = settings.wind.air_density;
    const double diameter = 2.0 * double{settings.material.radius};
    if (speed == 0.0 || density == 0.0) return 0.0;
    const double reynolds = density * speed * diameter / double{settings.wind.air_viscosity};
    const double coefficient = 1.0 + 10.0 * std::pow(reynolds, -2.0 / 3.0);
    return density / 2.0 * coefficient * diameter * speed * speed;
}

double terminalSpeed(const hair::SimulationSettings& settings) {
    const double weight =
        lineDensity(settings.material) * glm::length(glm::dvec3(settings.gravity));
    double slow = 0.0;
    double fast = 100.0;
    for (int i = 0; i < 100; ++i) {
        const double speed = (slow + fast) / 2.0;
        (dragPerLength(settings, speed) > weight ? fast : slow) = speed;
    }
    return slow;
}

double shelteredSpeed(const hair::SimulationSettings& settings, double speed, double area) {
    const double diameter = 2.0 * double{settings.material.radius};
    const double density = settings.wind.air_density;
    // The derivative of p = u^(2/3) by the area, which is 2/3 u^(-1/3) u'.
    const auto slope = [&](double power) {
        if (power <= 0.0) return 0.0;
        const double u = std::pow(power, 1.5);
        const double slowing = dragPerLength(settings, u) / (density * diameter * u);
        return -2.0 / 3.0 * slowing / std::cbrt(u);
    };
    constexpr int kSteps = 1000;
    const double h = area / kSteps;
    double power = std::pow(speed, 2.0 / 3.0);
    for (int i = 0; i < kSteps; ++i) {
        const double k1 = slope(power);
        const double k2 = slope(power + h / 2.0 * k1);
        const double k3 = slope(power + h / 2.0 * k2);
        const double k4 = slope(power + h * k3);
        power = std::max(power + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4), 0.0);
    }
    return std::pow(power, 1.5);
}

double terminalSpeedAlong(const hair::SimulationSettings& settings) {
    return lineDensity(settings.material) * glm::length(glm::dvec3(settings.gravity)) /
           dragAlongPerLength(settings, 1.0);
}

// Bisection over the tip's angle from the wind. For a long rod without weight it is tiny, so steps
// are logarithmic.
glm::dvec2 draggedTip(const hair::SimulationSettings& settings, double speed, double length) {
    const DraggedRod rod{
        .stiffness = bendingStiffness(settings.material),
        .weight = lineDensity(settings.material) * glm::length(glm::dvec3(settings.gravity)),
        .speed = speed,
        .settings = settings};
    double low = std::log(1e-12);
    double high = std::log(kPi / 2.0);
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2.0;
        const bool beyond = draggedFromTip(rod, length, std::exp(middle)).angle > kPi / 2.0;
        (beyond ? high : low) = middle;
    }
    const Section clamp = draggedFromTip(rod, length, std::exp(low));
    return {clamp.reach, -clamp.drop};
}

namespace {

// ---- Frequency of a released strand -------------------------------------------------------------

constexpr int kPeriods = 5;
constexpr int kSamplesPerPeriod = 40;

}  // namespace

double slideDistance(double gravity, double angle, double radius, double friction, double time) {
    if (friction >= std::tan(angle)) return 0.0;
    const auto acceleration = [&](double s, double speed) {
        const double slope = angle + s / radius;
        return gravity * std::sin(slope) -
               friction * (gravity * std::cos(slope) - speed * speed / radius);
    };
    constexpr int kSteps = 1000;
    const double h = time / kSteps;
    double s = 0.0;
    double v = 0.0;
    for (int i = 0; i < kSteps; ++i) {  // Runge and Kutta's method of fourth order
        const double a1 = acceleration(s, v);
        const double a2 = acceleration(s + h / 2.0 * v, v + h / 2.0 * a1);
        const double a3 = acceleration(s + h / 2.0 * (v + h / 2.0 * a1), v + h / 2.0 * a2);
        const double a4 = acceleration(s + h * (v + h / 2.0 * a2), v + h * a3);
        s += h * v + h * h / 6.0 * (a1 + a2 + a3);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    return s;
}

double joiningLength(std::span<const double> apart, double distance, double segment) {
    for (std::size_t i = 1; i < apart.size(); ++i)
        if (apart[i] < distance / 2.0)
            return 2.0 * segment *
                   (static_cast<double>(i) - 1.0 +
                    (apart[i - 1] - distance / 2.0) / (apart[i - 1] - apart[i]));
    return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> measureFrequency(Experiment& experiment, const Vibration& vibration) {
    experiment.place(
        deflected(vibration.shape, vibration.segment, vibration.direction, vibration.sideways));
    const std::uint32_t steps =
        experiment.stepsIn(1.0 / (kSamplesPerPeriod * vibration.expected_frequency));
    std::vector<double> amounts;
    for (int i = 0; i < kPeriods * kSamplesPerPeriod; ++i) {
        experiment.advance(steps);
        amounts.push_back(amountOf(vibration.shape, experiment.positions(), vibration.sideways));
    }
    return frequencyOf(amounts, steps * experiment.timeStep());
}

namespace {

// ---- Modes and frequencies ----------------------------------------------------------------------

constexpr double kFirstBesselRoot = 2.404825557695773;  // of J0, Abramowitz and Stegun table 9.5
constexpr double kFirstBeamRoot = 1.8751040687119611;  // of cos z cosh z = -1

// Laguerre's polynomial L_n (Abramowitz and Stegun 1964, Handbook of mathematical functions,
// 22.7.12).
double laguerre(unsigned n, double x) {
    double before = 0.0;
    double value = 1.0;
    for (unsigned k = 0; k < n; ++k) {
        const double next = ((2.0 * k + 1.0 - x) * value - k * before) / (k + 1.0);
        before = value;
        value = next;
    }
    return value;
}

// The root of L_n between two points where its signs differ.
double bisect(unsigned n, double low, double high) {
    const bool rising = laguerre(n, low) < 0.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        ((laguerre(n, middle) < 0.0) == rising ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

// The roots of L_(m-1) separate those of L_m, which are all below 4 m.
std::vector<double> laguerreRoots(unsigned n) {
    std::vector<double> roots;
    for (unsigned m = 1; m <= n; ++m) {
        std::vector<double> bounds{0.0};
        bounds.insert(bounds.end(), roots.begin(), roots.end());
        bounds.push_back(4.0 * m);
        roots.clear();
        for (unsigned i = 0; i < m; ++i) roots.push_back(bisect(m, bounds[i], bounds[i + 1]));
    }
    return roots;
}

std::vector<PendulumMode> pendulumModes(unsigned n, double link, double gravity) {
    std::vector<PendulumMode> modes;
    for (const double root : laguerreRoots(n)) {
        PendulumMode mode{.frequency = std::sqrt(root * gravity / link) / (2.0 * kPi), .shape = {}};
        double greatest = 0.0;
        for (unsigned i = 0; i < n; ++i) {
            mode.shape.push_back(laguerre(n - 1 - i, root));
            greatest = std::max(greatest, std::abs(mode.shape.back()));
        }
        for (double& each : mode.shape) each /= greatest;
        modes.push_back(std::move(mode));
    }
    return modes;
}

double hangingChainPeriod(double length, double gravity) {
    return 4.0 * kPi / kFirstBesselRoot * std::sqrt(length / gravity);
}

namespace {

constexpr double kFirstZeroOfJ1 = 3.83170597020751;

}  // namespace

double chainPeriodInAir(double length, double gravity) {
    return 4.0 * kPi / kFirstZeroOfJ1 * std::sqrt(2.0 * length / gravity);
}

double chainShapeInAir(double x) {
    const double z = kFirstZeroOfJ1 * std::sqrt(x);
    return z == 0.0 ? 1.0 : 2.0 * std::cyl_bessel_j(1.0, z) / z;
}

double cantileverFrequency(double stiffness, double line_density, double length) {
    return kFirstBeamRoot * kFirstBeamRoot / (2.0 * kPi) *
           std::sqrt(stiffness / (line_density * std::pow(length, 4.0)));
}

double cantileverShape(double s) {
    const double z = kFirstBeamRoot;
    const double part = (std::cosh(z) + std::cos(z)) / (std::sinh(z) + std::sin(z));
    const auto shape = [&](double t) {
        return std::cosh(z * t) - std::cos(z * t) - part * (std::sinh(z * t) - std::sin(z * t));
    };
    return shape(s) / shape(1.0);
}

}  // namespace benchmarks::physics
