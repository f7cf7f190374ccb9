#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/shading_settings.h"

// The papers' definitions, evaluated from the settings by brute force: sums over points for
// integrals, paths traced through the fibre's cross-section, and series term by term. The code
// shares nothing with the program. The program makes the device's parameters and tables from its
// own reference, so an error there would be in both. Directions, h and the lobes are as in fiber.h.
namespace hair::rendering::published {

inline constexpr double kPi = std::numbers::pi;
inline constexpr std::size_t kLobes = 4;  // R, TT, TRT, and the rest

// Mean of f at the middles of `steps` parts of [from, to].
template <class Function>
auto meanOver(double from, double to, int steps, const Function& f) {
    auto sum = f(from + 0.5 / steps * (to - from));
    for (int i = 1; i < steps; ++i) sum += f(from + (i + 0.5) / steps * (to - from));
    return sum / static_cast<double>(steps);
}

struct Fiber {
    glm::dvec3 absorption;
    double eta;
    std::array<double, kLobes> variances;
    std::array<double, kLobes> shifts;  // theta_i + theta_o at which a lobe is strongest
    double scale;  // s of the logistic distribution
    double inside;  // its integral over [-pi, pi]
};

inline double logistic(double x, double scale) {
    const double e = std::exp(-std::abs(x) / scale);
    return e / (scale * (1.0 + e) * (1.0 + e));
}

// Chiang et al. 2016, (7), (8) and section 4; the pigments' absorption is that of d'Eon et al.
// 2011, section 6.1.
inline Fiber makeFiber(const ShadingSettings& shading) {
    const double m = shading.longitudinal_roughness;
    const double n = shading.azimuthal_roughness;
    const double deviation = 0.726 * m + 0.812 * m * m + 3.7 * std::pow(m, 20.0);
    const double v = deviation * deviation;
    const double tilt = shading.cuticle_tilt * kPi / 180.0;
    Fiber fiber{
        .absorption = double{shading.eumelanin} * glm::dvec3(0.419, 0.697, 1.37) +
                      double{shading.pheomelanin} * glm::dvec3(0.187, 0.4, 1.05),
        .eta = shading.refractive_index,
        .variances = {v, 0.25 * v, 4.0 * v, 4.0 * v},
        .shifts = {-2.0 * tilt, tilt, 4.0 * tilt, 0.0},
        .scale = 0.626657069 * (0.265 * n + 1.194 * n * n + 5.372 * std::pow(n, 22.0)),
        .inside = 0.0};
    fiber.inside =
        2.0 * kPi * meanOver(-kPi, kPi, 20000, [&](double x) { return logistic(x, fiber.scale); });
    return fiber;
}

// M_p of d'Eon et al. 2011, (7), with I_0(x) = mean of exp(x cos t) over a turn: the sum of a
// smooth periodic function converges faster than any power of the step.
inline double longitudinal(double theta_i, double theta_o, double v) {
    const double across = std::cos(theta_i) * std::cos(theta_o);
    const double along = std::sin(theta_i) * std::sin(theta_o);
    const double mean = meanOver(0.0, 2.0 * kPi, 512, [&](double t) {
        return std::exp((across * std::cos(t) - along - 1.0) / v);
    });
    return mean / (v * (1.0 - std::exp(-2.0 / v)));
}

// N_p at an angle from Phi(p), round the circle.
inline double azimuthal(const Fiber& fiber, double angle) {
    const double nearest = std::arg(std::polar(1.0, angle));
    return logistic(nearest, fiber.scale) / fiber.inside;
}

// Fresnel's equations in their original form, with the angles on both sides.
inline double fresnel(double angle, double eta) {
    if (angle < 1e-6) return std::pow((eta - 1.0) / (eta + 1.0), 2.0);
    const double refracted = std::asin(std::sin(angle) / eta);
    const double across = std::sin(angle - refracted) / std::sin(angle + refracted);
    const double parallel = std::tan(angle - refracted) / std::tan(angle + refracted);
    return 0.5 * (across * across + parallel * parallel);
}

struct Path {
    std::array<glm::dvec3, kLobes> attenuations;
    std::array<double, 3> azimuths;  // phi_i - phi_o of a smooth fibre
};

// Traces the ray from the eye, at azimuth 0, through a circle of radius 1. In the cross-section
// the ray's projection has Bravais's index of refraction (Marschner et al. 2003, section 4).
inline Path trace(const Fiber& fiber, double theta_o, double h) {
    const double index =
        std::sqrt(std::pow(fiber.eta, 2.0) - std::pow(std::sin(theta_o), 2.0)) / std::cos(theta_o);
    const glm::dvec2 towards(-1.0, 0.0);
    const double cos_o = std::sqrt(1.0 - h * h);
    glm::dvec2 at(cos_o, -h);
    const double cos_t = std::sqrt(1.0 - h * h / (index * index));
    glm::dvec2 ray = towards / index + (cos_o / index - cos_t) * at;
    const auto azimuthOf = [](const glm::dvec2& v) { return std::atan2(v.y, v.x); };

    // The chords are longer by 1 / cos theta_t in space.
    const double inclined = std::sqrt(1.0 - std::pow(std::sin(theta_o) / fiber.eta, 2.0));
    const double length = -2.0 * glm::dot(ray, at) / inclined;
    const glm::dvec3 passed = glm::exp(-fiber.absorption * length);
    const double reflected = fresnel(std::acos(std::cos(theta_o) * cos_o), fiber.eta);

    Path path{};
    path.attenuations[0] = glm::dvec3(reflected);
    path.azimuths[0] = azimuthOf(towards - 2.0 * glm::dot(towards, at) * at);
    glm::dvec3 carried = (1.0 - reflected) * passed;
    for (std::size_t p = 1; p < 3; ++p) {
        at -= 2.0 * glm::dot(ray, at) * ray;
        path.attenuations[p] = (1.0 - reflected) * carried;
        path.azimuths[p] = azimuthOf(index * ray - (index * glm::dot(ray, at) - cos_o) * at);
        ray -= 2.0 * glm::dot(ray, at) * at;
        carried *= reflected * passed;
    }
    for (int p = 3; p < 2000; ++p) {
        path.attenuations[3] += (1.0 - reflected) * carried;
        carried *= reflected * passed;
    }
    return path;
}

struct View {
    double theta_i;
    double theta_o;
    double phi;  // phi_i - phi_o
};

inline View viewOf(const glm::dvec3& wo, const glm::dvec3& wi) {
    return {std::asin(wi.x), std::asin(wo.x), std::atan2(wi.z, wi.y) - std::atan2(wo.z, wo.y)};
}

// f |cos theta_i|, Chiang et al. 2016, (1) to (3), for light with an inclination changed by
// `change` with the variance `spread`. `n` is the azimuthal part at an angle from Phi(p).
template <class Azimuthal>
glm::dvec3 sumOfLobes(
    const Fiber& fiber, const View& view, double h, double change, double spread,
    const Azimuthal& n) {
    const Path path = trace(fiber, view.theta_o, h);
    glm::dvec3 sum(0.0);
    for (std::size_t p = 0; p < kLobes; ++p)
        sum +=
            path.attenuations[p] * (longitudinal(
                                        view.theta_i - change, view.theta_o - fiber.shifts[p],
                                        fiber.variances[p] + spread) *
                                    (p < 3 ? n(view.phi - path.azimuths[p]) : 1.0 / (2.0 * kPi)));
    return sum;
}

inline glm::dvec3 scattering(const Fiber& fiber, const View& view, double h) {
    return sumOfLobes(
        fiber, view, h, 0.0, 0.0, [&](double angle) { return azimuthal(fiber, angle); });
}

// The part of the light that a fibre scatters into a half turn, and the mean and variance of
// theta_i + theta_o.
struct Half {
    glm::dvec3 part{0.0};
    double shift = 0.0;
    double variance = 0.0;
};

// Zinke et al. 2008, (6) and (12): averages over the fibre's width and the half turn round
// `middle` from the light's azimuth. The means are those of the lobes, weighted by the light that
// they carry.
inline Half halfOf(const Fiber& fiber, double theta, double middle) {
    constexpr int kPlaces = 96;
    constexpr int kAngles = 384;
    std::array<glm::dvec3, kLobes> carried{};
    for (int i = 0; i < kPlaces; ++i) {
        // h = sin gamma, dh = cos gamma dgamma, because the attenuations are then smooth up to the
        // edge.
        const double gamma = ((i + 0.5) / kPlaces - 0.5) * kPi;
        const double weight = 0.5 * kPi / kPlaces * std::cos(gamma);
        const Path path = trace(fiber, theta, std::sin(gamma));
        for (std::size_t p = 0; p < kLobes; ++p) {
            const double inside =
                p == 3 ? 0.5 : kPi * meanOver(-0.5 * kPi, 0.5 * kPi, kAngles, [&](double x) {
                                   return azimuthal(fiber, middle + x - path.azimuths[p]);
                               });
            carried[p] += weight * inside * path.attenuations[p];
        }
    }
    Half half;
    double weights = 0.0;
    for (std::size_t p = 0; p < kLobes; ++p) {
        const double weight = (carried[p].r + carried[p].g + carried[p].b) / 3.0;
        half.part += carried[p];
        weights += weight;
        half.shift += weight * fiber.shifts[p];
    }
    half.shift /= weights;
    for (std::size_t p = 0; p < kLobes; ++p)
        half.variance += (carried[p].r + carried[p].g + carried[p].b) / 3.0 / weights *
                         (fiber.variances[p] + std::pow(fiber.shifts[p] - half.shift, 2.0));
    return half;
}

// Light that has taken several paths: the sum, and means over all of them.
struct Ways {
    glm::dvec3 part{0.0};
    double shift = 0.0;
    double variance = 0.0;
    double weights = 0.0;

    void add(double weight, double its_shift, double its_variance) {
        weights += weight;
        shift += weight * its_shift;
        variance += weight * its_variance;
    }
    void finish() {
        shift /= weights;
        variance /= weights;
    }
};

// Zinke et al. 2008, (13) to (15): light that goes forward through i fibres, back, and through i
// again; and all paths that go back three times. Here the first i fibres are a mean of Poisson's
// distribution: exp(-i (1 - f)) of the light gets there, and meets i f fibres. For light that goes
// back three times, there are m paths that pass m fibres in and out, and n more twice inside.
inline Ways backThroughNeighbours(const Half& forward, const Half& backward) {
    Ways ways;
    for (int channel = 0; channel < 3; ++channel) {
        const double f = forward.part[channel];
        const double b = backward.part[channel];
        const auto add = [&](double weight, double forwards, int backwards) {
            ways.part[channel] += weight;
            ways.add(
                weight, forwards * forward.shift + backwards * backward.shift,
                forwards * forward.variance + backwards * backward.variance);
        };
        for (int m = 1; m < 400; ++m) {
            const double in_and_out = std::exp(-m * (1.0 - f)) * std::pow(f, m);
            add(b * in_and_out, m * (1.0 + f), 1);
            double within = 1.0;
            for (int n = 0; n < 200; ++n, within *= f * f)
                add(b * b * b * m * in_and_out * within, m * (1.0 + f) + 2.0 * n, 3);
        }
    }
    ways.finish();
    return ways;
}

// Forward through a number of fibres with Poisson's distribution, at least one.
inline Ways forwardThrough(const Half& forward, double strands) {
    Ways ways;
    const double mean = (forward.part.r + forward.part.g + forward.part.b) / 3.0;
    double chance = std::exp(-strands);
    for (int n = 1; n < 200; ++n) {
        chance *= strands / n;
        ways.part += chance * glm::pow(forward.part, glm::dvec3(n));
        ways.add(chance * std::pow(mean, n), n * forward.shift, n * forward.variance);
    }
    ways.finish();
    return ways;
}

// Zinke et al. 2008, (5) to (11): the fibre's own light and the light that its neighbours send
// back. It counts the light that nothing stops and the light that others have scattered evenly over
// a half turn. `density` is the part of each fibre's scattered light that meets others. Light from
// the neighbours comes back round the light's azimuth as (1 + cos phi) / (2 pi). From the light
// behind the fibre, `ended` leaves the hair, and `returned` comes back.
inline glm::dvec3 dualScattering(
    const Fiber& fiber, double density, const View& view, double h, double strands, double ended,
    double returned) {
    Half forward = halfOf(fiber, view.theta_i, kPi);
    Half backward = halfOf(fiber, view.theta_i, 0.0);
    forward.part *= density;
    backward.part *= density;
    const Ways back = backThroughNeighbours(forward, backward);
    const auto backwards = [&](double change, double spread, double round) {
        return 2.0 * round * ((1.0 - ended) * back.part + returned * forward.part) *
               longitudinal(
                   view.theta_i - change - back.shift, view.theta_o, back.variance + spread);
    };
    const auto round = [](double phi) { return (1.0 + std::cos(phi)) / (2.0 * kPi); };
    const auto overHalfTurn = [](const auto& f) {
        return [f](double angle) {
            return meanOver(-0.5 * kPi, 0.5 * kPi, 768, [&](double x) { return f(angle + x); });
        };
    };
    glm::dvec3 sum =
        std::exp(-strands) * (scattering(fiber, view, h) + backwards(0.0, 0.0, round(view.phi)));
    if (strands > 0.0) {
        const Ways others = forwardThrough(forward, strands);
        const auto n = [&](double angle) { return azimuthal(fiber, angle); };
        sum += others.part *
               (sumOfLobes(fiber, view, h, others.shift, others.variance, overHalfTurn(n)) +
                backwards(others.shift, others.variance, overHalfTurn(round)(view.phi)));
    }
    return sum;
}

}  // namespace hair::rendering::published
