#include "benchmarks/physics/vibration.h"

#include <algorithm>
#include <cmath>

namespace benchmarks::physics {

namespace {

constexpr double kFirstBesselRoot = 2.404825557695773;  // of J0, Abramowitz and Stegun table 9.5
constexpr double kFirstBeamRoot = 1.8751040687119611;  // of cos z cosh z = -1

// The root of L_n between two points where it has different signs.
double bisect(unsigned n, double low, double high) {
    const bool rising = laguerre(n, low) < 0.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        ((laguerre(n, middle) < 0.0) == rising ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

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

// The roots of L_(m-1) part those of L_m, which all lie below 4 m.
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
