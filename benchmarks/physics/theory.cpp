#include "benchmarks/physics/theory.h"

#include <cmath>

namespace benchmarks::physics {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSteps = 4000;

struct Hanging {
    double angle;  // from the vertical, rad
    double drop, reach;
};

// Runge and Kutta's fourth order from the tip, where the angle from the vertical is `angle`, to the
// clamp: phi = pi / 2 - theta and z = 1 - s give phi'' = gamma z sin phi.
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
        // Simpson's rule, with the angle in the middle between its two estimates.
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
    // Bisection over the tip's angle, which is exponentially near the vertical for a long rod: in
    // steps of its logarithm, for either sign.
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

}  // namespace benchmarks::physics
