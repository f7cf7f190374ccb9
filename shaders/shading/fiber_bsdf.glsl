// Scattering of one fibre, Chiang et al. 2016, in the notation of pbrt-v4.
#ifndef HAIRBENCH_FIBER_BSDF_GLSL
#define HAIRBENCH_FIBER_BSDF_GLSL

#include "common/picture.glsl"

layout(buffer_reference, scalar) readonly buffer HairOpticsReference { HairOptics optics; };

const float kInversePi = 0.318309886;
const float kHalfInversePi = 0.159154943;

// I_0(x) e^-x: Abramowitz and Stegun 1964, Handbook of mathematical functions, 9.8.1 and 9.8.2. The
// relative errors are below 2e-7.
vec4 scaledBessel0(vec4 x) {
    vec4 t = min(x * (1.0 / 3.75), 1.0);
    t *= t;
    vec4 near = 1.0 + t * (3.5156229 + t * (3.0899424 + t * (1.2067492 + t * (0.2659732 +
                      t * (0.0360768 + t * 0.0045813)))));
    vec4 u = 3.75 / max(x, 3.75);
    vec4 far = 0.39894228 + u * (0.01328592 + u * (0.00225319 + u * (-0.00157565 +
               u * (0.00916281 + u * (-0.02057706 + u * (0.02635537 + u * (-0.01647633 +
               u * 0.00392377)))))));
    return mix(far * inversesqrt(max(x, 3.75)), near * exp(-min(x, 3.75)), lessThan(x, vec4(3.75)));
}

// M_p of four lobes, d'Eon et al. 2011: e^(-sin sin / v) I_0(cos cos / v) / (2 v sinh(1 / v)). The
// exponents are combined to -(1 - cos(theta_i + theta_o)) / v, which never overflows. Here 1 - cos
// is half the squared distance from wi to the mirror image of wo, which keeps its digits.
vec4 longitudinalLobes(float sin_i, float cos_i, vec4 sin_o, vec4 cos_o, vec4 variances) {
    vec4 inverse = 1.0 / variances;
    vec4 up = sin_i + sin_o;
    vec4 across = cos_i - cos_o;
    vec4 scale = inverse / (1.0 - exp(-2.0 * inverse));
    return scale * exp(-0.5 * inverse * (up * up + across * across)) *
           scaledBessel0(cos_i * cos_o * inverse);
}

// The reflected part of unpolarised light. `cosine` is that of the angle of incidence.
float fiberFresnel(float cosine, float eta) {
    float transmitted = sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
    float parallel = (eta * cosine - transmitted) / (eta * cosine + transmitted);
    float across = (cosine - eta * transmitted) / (cosine + eta * transmitted);
    return 0.5 * (parallel * parallel + across * across);
}

// The part of a fibre's scattering that does not depend on the light.
struct FiberView {
    vec4 sin_tilted;  // theta_o, tilted for each lobe
    vec4 cos_tilted;
    vec3 centre_y;  // directions phi_o + Phi(p) in which a smooth fibre would send R, TT and TRT
    vec3 centre_z;
    vec2 eye;  // direction phi_o
    mat4x3 attenuations;  // A_p
    vec3 reaches;  // rad: half width over which N_p is averaged round those directions; 0: no
                   // averaging
};

// Turns `v` by the angle of the direction `by`.
vec2 turned(vec2 v, vec2 by) { return vec2(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x); }

vec2 azimuthDirection(vec3 direction) {
    float size = length(direction.yz);
    return size > 1e-6 ? direction.yz / size : vec2(1.0, 0.0);
}

FiberView fiberView(HairOptics optics, vec3 to_eye, float h) {
    float sin_o = clamp(to_eye.x, -1.0, 1.0);
    float cos_o = sqrt(1.0 - sin_o * sin_o);
    FiberView view;
    view.sin_tilted = sin_o * optics.cos_tilts + cos_o * optics.sin_tilts;
    view.cos_tilted = abs(cos_o * optics.cos_tilts - sin_o * optics.sin_tilts);
    view.eye = azimuthDirection(to_eye);

    // eta' cos theta_o = sqrt(eta^2 - sin^2 theta_o) also equals eta cos theta_t.
    float inner = sqrt(optics.eta * optics.eta - sin_o * sin_o);
    float cos_gamma_o = sqrt(1.0 - h * h);
    float sin_gamma_t = h * cos_o / inner;
    float cos_gamma_t = sqrt(1.0 - sin_gamma_t * sin_gamma_t);

    // Phi(p) = 2 p gamma_t - 2 gamma_o + p pi, as directions.
    vec2 reflected = vec2(1.0 - 2.0 * h * h, -2.0 * h * cos_gamma_o);
    vec2 through = vec2(2.0 * sin_gamma_t * sin_gamma_t - 1.0, -2.0 * sin_gamma_t * cos_gamma_t);
    vec2 r = turned(view.eye, reflected);
    vec2 tt = turned(r, through);
    vec2 trt = turned(tt, through);
    view.centre_y = vec3(r.x, tt.x, trt.x);
    view.centre_z = vec3(r.y, tt.y, trt.y);

    vec3 transmitted = exp(-optics.absorption * (2.0 * cos_gamma_t * optics.eta / inner));
    float f = fiberFresnel(cos_o * cos_gamma_o, optics.eta);
    view.attenuations[0] = vec3(f);
    view.attenuations[1] = (1.0 - f) * (1.0 - f) * optics.body * transmitted;
    view.attenuations[2] = view.attenuations[1] * transmitted * f;
    view.attenuations[3] =
        view.attenuations[2] * transmitted * f / max(1.0 - transmitted * f, 1e-6);
    view.reaches = vec3(0.0);
    return view;
}

// The same, averaged over a range of width `turn` in gamma round `gamma`. Phi(p) is taken as linear
// over this range.
FiberView fiberViewRound(HairOptics optics, vec3 to_eye, float gamma, float turn) {
    float h = sin(gamma);
    FiberView view = fiberView(optics, to_eye, h);
    float sin_o = clamp(to_eye.x, -1.0, 1.0);
    float inverse = sqrt((1.0 - sin_o * sin_o) / (optics.eta * optics.eta - sin_o * sin_o));
    float inside = inverse * cos(gamma) * inversesqrt(1.0 - h * h * inverse * inverse);
    // dPhi/dgamma.
    vec3 slopes = vec3(-2.0, 2.0 * inside - 2.0, 4.0 * inside - 2.0);
    view.reaches = max(0.5 * turn * abs(slopes), 1e-3);
    return view;
}

// The distances |phi_i - phi_o - Phi(p)|, 0 to pi.
vec3 azimuthalDistances(FiberView view, vec2 light) {
    vec3 along = light.x * view.centre_y + light.y * view.centre_z;
    vec3 across = light.y * view.centre_y - light.x * view.centre_z;
    return atan(abs(across), along);
}

// The mean of N_p from distances - reaches to distances + reaches, by the integral of the logistic
// distribution.
vec4 averageAzimuthalLobes(HairOptics optics, vec3 reaches, vec3 distances) {
    float k = optics.inverse_azimuthal_scale;
    vec3 near = 1.0 / (1.0 + exp(min(k * (distances - reaches), 80.0)));
    vec3 far = 1.0 / (1.0 + exp(min(k * (distances + reaches), 80.0)));
    return vec4(optics.trimmed * (near - far) / (2.0 * reaches), kHalfInversePi);
}

// N_p at distances from azimuthalDistances(). The remaining lobe is uniform.
vec4 azimuthalLobes(HairOptics optics, FiberView view, vec3 distances) {
    if (view.reaches.x > 0.0) return averageAzimuthalLobes(optics, view.reaches, distances);
    vec3 e = exp(-distances * optics.inverse_azimuthal_scale);
    float scale = optics.inverse_azimuthal_scale * optics.trimmed;
    return vec4(scale * e / ((1.0 + e) * (1.0 + e)), kHalfInversePi);
}

// f |cos theta_i|; the cosine cancels.
vec3 fiberScattering(HairOptics optics, FiberView view, vec3 to_light) {
    float sin_i = clamp(to_light.x, -1.0, 1.0);
    float cos_i = sqrt(1.0 - sin_i * sin_i);
    vec4 lobes = longitudinalLobes(
        sin_i, cos_i, view.sin_tilted, view.cos_tilted, optics.variances);
    lobes *= azimuthalLobes(optics, view, azimuthalDistances(view, azimuthDirection(to_light)));
    return view.attenuations * lobes;
}

// f of pbrt-v4: radiance = sum over lights of f |cos theta_i| times the irradiance of a plane that
// faces the light. Directions are unit vectors away from the fibre, with x along it towards the
// tip. h in [-1, 1] is the position across it as seen from `to_eye`, positive towards cross(to_eye,
// x).
vec3 fiberBsdf(HairOptics optics, vec3 to_eye, vec3 to_light, float h) {
    float cos_i = sqrt(max(1.0 - to_light.x * to_light.x, 1e-8));
    return fiberScattering(optics, fiberView(optics, to_eye, h), to_light) / cos_i;
}

#endif
