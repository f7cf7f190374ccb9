#include "hair/rendering/reference_dual_scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/exponential.hpp>

namespace hair {

namespace {

constexpr double kPi = std::numbers::pi;

double square(double x) { return x * x; }
double mean(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3; }

// What N_p has in the half turn round an azimuth that is `x` from Phi(p).
double halfTurn(double x, double scale) {
    const double apart = std::abs(std::remainder(x, 2 * kPi));
    const double end = apart + kPi / 2;
    return trimmedLogisticCdf(std::min(end, kPi), scale) -
           trimmedLogisticCdf(apart - kPi / 2, scale) +
           (end > kPi ? trimmedLogisticCdf(end - 2 * kPi, scale) : 0.0);
}

// Means that are weighted by what lobes or paths carry.
struct WeightedMeans {
    double weight = 0;
    double shift = 0;
    double variance = 0;

    void add(double more, double its_shift, double its_variance) {
        weight += more;
        shift += more * its_shift;
        variance += more * its_variance;
    }
    double meanShift() const { return weight > 0 ? shift / weight : 0; }
    double meanVariance() const { return weight > 0 ? variance / weight : 0; }
};

// Every lobe, with light from inclination theta_i and, round the eye, the azimuths of `azimuthal`.
template <class Azimuthal>
glm::dvec3 sumOfLobes(
    const Fiber& fiber, const FiberPath& path, double theta_i, double theta_o, double more_variance,
    const Azimuthal& azimuthal) {
    glm::dvec3 sum(0);
    for (std::size_t p = 0; p < kFiberLobes; ++p) {
        const double m =
            longitudinal(theta_i, theta_o - fiber.shifts[p], fiber.variances[p] + more_variance);
        sum += path.attenuations[p] * (m * azimuthal(p));
    }
    return sum;
}

}  // namespace

FiberAverages averageOverFiber(const Fiber& fiber, double theta) {
    constexpr int kPlaces = 256;
    FiberAverages averages;
    WeightedMeans forward_means;
    WeightedMeans backward_means;
    for (int i = 0; i < kPlaces; ++i) {
        // h = sin gamma, for A_p has square roots of 1 - h^2; both halves of a fibre are alike.
        const double step = kPi / 2 / kPlaces;
        const double gamma = (i + 0.5) * step;
        const double width = std::sin(gamma + step / 2) - std::sin(gamma - step / 2);
        const FiberPath path = fiberPath(fiber, theta, std::sin(gamma));
        for (std::size_t p = 0; p < kFiberLobes; ++p) {
            const double forward = p < path.azimuths.size()
                                       ? halfTurn(kPi - path.azimuths[p], fiber.azimuthal_scale)
                                       : 0.5;
            const glm::dvec3 carried = width * path.attenuations[p];
            averages.forward += forward * carried;
            averages.backward += (1 - forward) * carried;
            // That lobes are not in one place spreads light too.
            const double shift = fiber.shifts[p];
            const double spread = fiber.variances[p] + square(shift);
            forward_means.add(forward * mean(carried), shift, spread);
            backward_means.add((1 - forward) * mean(carried), shift, spread);
        }
    }
    averages.forward_shift = forward_means.meanShift();
    averages.backward_shift = backward_means.meanShift();
    averages.forward_variance = forward_means.meanVariance() - square(averages.forward_shift);
    averages.backward_variance = backward_means.meanVariance() - square(averages.backward_shift);
    return averages;
}

LocalScattering localScattering(const FiberAverages& averages) {
    LocalScattering local;
    WeightedMeans means;
    for (int channel = 0; channel < 3; ++channel) {
        const double b = averages.backward[channel];
        const double passed = square(averages.forward[channel]);
        const double rest = std::max(1 - passed, 1e-9);
        const double once = b * passed / rest;
        const double thrice = b * b * b * passed / (rest * rest * rest);
        local.albedo[channel] = once + thrice;
        // Fibres that are passed forward: sum over i of 2 i a^(2 i), over sum of a^(2 i); and the
        // same for three scatterings backward, whose series is a^2 / (1 - a^2)^3.
        const double passes_once = 2 / rest;
        const double passes_thrice = 2 * (1 + 2 * passed) / rest;
        means.add(
            once, averages.backward_shift + passes_once * averages.forward_shift,
            averages.backward_variance + passes_once * averages.forward_variance);
        means.add(
            thrice, 3 * averages.backward_shift + passes_thrice * averages.forward_shift,
            3 * averages.backward_variance + passes_thrice * averages.forward_variance);
    }
    local.shift = means.meanShift();
    local.variance = means.meanVariance();
    return local;
}

GlobalScattering globalScattering(const FiberAverages& averages, double strands) {
    GlobalScattering global;
    if (strands <= 0) return global;
    global.direct = std::exp(-strands);
    // The expectation of a_f^N is exp(-n (1 - a_f)).
    global.forward = glm::exp(-strands * (1.0 - averages.forward)) - global.direct;
    // The mean of N where it is not 0, weighted by a_f^N.
    const double passed = std::max(strands * mean(averages.forward), 1e-9);
    const double met = passed / -std::expm1(-passed);
    global.shift = met * averages.forward_shift;
    global.variance = met * averages.forward_variance;
    return global;
}

glm::dvec3 dualScattering(
    const Fiber& fiber, double density_factor, const glm::dvec3& wo, const glm::dvec3& wi, double h,
    double strands) {
    const double theta_i = std::asin(std::clamp(wi.x, -1.0, 1.0));
    const double theta_o = std::asin(std::clamp(wo.x, -1.0, 1.0));
    const double phi = std::atan2(wi.z, wi.y) - std::atan2(wo.z, wo.y);
    const FiberPath path = fiberPath(fiber, theta_o, h);
    const FiberAverages averages = averageOverFiber(fiber, theta_i);
    const LocalScattering local = localScattering(averages);
    const GlobalScattering global = globalScattering(averages, strands);

    // Twice A_b, as in equation (11), round the direction of the light: (1 + cos phi) / 2 pi
    // instead of 1 / pi in the nearer half turn, which would end in an edge.
    const auto behind = [&](double change, double more_variance, double azimuthal) {
        return 2.0 * density_factor * azimuthal * local.albedo *
               longitudinal(
                   theta_i - change - local.shift, theta_o, local.variance + more_variance);
    };
    const glm::dvec3 direct =
        scattering(fiber, wo, wi, h) + behind(0, 0, (1 + std::cos(phi)) / (2 * kPi));
    // S_f: the light is spread evenly over the half turn round phi_i.
    const glm::dvec3 scattered =
        sumOfLobes(
            fiber, path, theta_i - global.shift, theta_o, global.variance,
            [&](std::size_t p) {
                return p < path.azimuths.size()
                           ? halfTurn(phi - path.azimuths[p], fiber.azimuthal_scale) / kPi
                           : 1 / (2 * kPi);
            }) +
        behind(global.shift, global.variance, (1 + 2 / kPi * std::cos(phi)) / (2 * kPi));
    return global.direct * direct + density_factor * global.forward * scattered;
}

}  // namespace hair
