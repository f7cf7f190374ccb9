#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/device.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"
#include "hair/shading_settings.h"

// Light scattering of one fibre and of many fibres, and the buffers of both that shaders read.
namespace hair::rendering {

// HairOptics and FiberAverages on the device; the averages only if the model needs them.
class HairOpticsBuffers {
public:
    HairOpticsBuffers(const engine::Device& device, const Settings& settings);

    static engine::MemoryRows rows(const ShadingSettings& shading);

    std::uint64_t address() const { return optics_.address(); }  // of gpu::HairOptics

private:
    engine::Buffer averages_;
    engine::Buffer optics_;
};

// Scattering of light by one fibre, in double precision: Chiang et al. 2016, A practical and
// controllable hair and fur model for production path tracing, in the notation of pbrt-v4 (Pharr,
// Jakob and Humphreys 2023, Physically based rendering, 4th ed., section 9.9). The shaders have an
// implementation of their own in shaders/shading/fiber_bsdf.glsl, which shares no mathematics with
// this one. hair/reference/fiber.h derives the scattering between a pair of directions, which only
// tests ask for.
//
// Directions are unit vectors away from the fibre, x along it towards the tip. theta is their angle
// with the plane across the fibre, and phi = atan2(z, y). h in [-1, 1] is the place across the
// fibre where a ray from `wo` meets it: at the azimuth phi_o - asin(h).

// Lobes: reflected (R), through the fibre (TT), reflected inside once (TRT), and the rest.
inline constexpr std::size_t kFiberLobes = 4;

template <class Value>
using PerLobe = std::array<Value, kFiberLobes>;

// A fibre as the shading settings describe it.
struct Fiber {
    glm::dvec3 absorption{0};  // sigma_a, over a radius
    double eta = 0;  // refractive index
    PerLobe<double> variances{};  // v_p of M_p, rad^2
    // theta_i + theta_o where lobe p is strongest, rad. It follows from the *tilt* alpha of the
    // cuticle's scales, which turn their outer faces towards the root: -2 alpha, alpha, 4 alpha, 0
    // (Chiang et al. 2016). It is not the *shift* alpha_R = -alpha of Marschner et al. 2003, which
    // refers to the half angle. pbrt-v4 and Mitsuba 3.9 have all signs reversed where the curve's
    // parameter grows towards the tip.
    PerLobe<double> shifts{};
    double azimuthal_scale = 0;  // s of N_p
    // Variance of the directions of the fibres around this one in each plane along it, rad^2. Only
    // averageOverFiber() uses it.
    double tilt_variance = 0;
};

Fiber makeFiber(const ShadingSettings& shading);

// Returns the part of unpolarised light that a dielectric reflects. `cosine` is the cosine of the
// angle of incidence, >= 0; `eta` is above 1.
double fresnel(double cosine, double eta);

// Cumulative distribution function of the logistic distribution trimmed to [-pi, pi].
double trimmedLogisticCdf(double x, double scale);

// Returns the integral of N_p, the logistic distribution of width `scale`, over the half turn round
// an azimuth at `x` from Phi(p).
double halfTurn(double x, double scale);

// Attenuation and azimuth of a ray's lobes in the fibre.
struct FiberPath {
    PerLobe<glm::dvec3> attenuations{};  // A_p
    // Phi(p): phi_i - phi_o of a smooth fibre; none for the last lobe.
    std::array<double, 3> azimuths{};
};

FiberPath fiberPath(const Fiber& fiber, double theta_o, double h);

// Scattering of light by many fibres, in double precision: Zinke, Yuksel, Weber and Keyser 2008,
// Dual scattering approximation for fast multiple scattering in hair. Forward means away from the
// light: the half turn of azimuths round phi_i + pi.

// Averages over the width of a fibre and over a half turn, for light at an angle theta with the
// plane across the fibre.
struct FiberAverages {
    glm::dvec3 forward{0};  // a_f, equation (6): part of the light that goes on forward
    glm::dvec3 backward{0};  // a_b, equation (12)
    double forward_shift = 0;  // mean of theta_i + theta_o, rad
    double backward_shift = 0;
    double forward_variance = 0;  // beta_f^2, rad^2; a mean, because variances add up
    double backward_variance = 0;
};

FiberAverages averageOverFiber(const Fiber& fiber, double theta);

// Returns the part of the light that a strand lets through to surfaces behind it. With dual
// scattering this is density_factor times a_f of the mean strand, for light from all directions;
// with other models it is 1 - /shading/shadows/stopped.
glm::dvec3 surfaceTransmittance(const ShadingSettings& shading);

// Powers of the strands' own colours (shaders/strands/own_color.glsl): the colour c^a belongs to
// a^2 times the absorption (hair/rendering/render_assets.h).
struct OwnPowers {
    double least = 1;
    double greatest = 1;
};
OwnPowers ownPowers(const ShadingSettings& shading);

// Light that passes fibres forward, is scattered backward behind them once or three times and
// passes fibres forward again, which adds to a fibre's own scattering. The light leaves through the
// i fibres in front of the fibre that turns it back, which let a_f^i through. It arrives by another
// path, on which it meets a random number of fibres with mean i, so exp(-i (1 - a_f)) gets there.
// (In the paper both factors are a_f^i, as if light and eye were in one place. The paper's result
// is a fifth too dark if a_f is 0.6, and a third if it is 0.4.)
struct LocalScattering {
    glm::dvec3 albedo{0};  // A_b, equations (13) to (15) with these factors
    double shift = 0;  // mean of theta_i + theta_o, rad
    double variance = 0;  // rad^2
};

// Shift and variance are the means over the series that the paper's (16) and (17) approximate.
LocalScattering localScattering(const FiberAverages& averages);

}  // namespace hair::rendering
