// Light that reaches a fibre through other fibres: Zinke et al. 2008, Dual scattering approximation
// for fast multiple scattering in hair.
#ifndef HAIRBENCH_DUAL_SCATTERING_GLSL
#define HAIRBENCH_DUAL_SCATTERING_GLSL

#include "shading/fiber_bsdf.glsl"
#include "shading/lights.glsl"
#include "strands/options.glsl"

layout(buffer_reference, scalar) readonly buffer FiberAverages { FiberAverage at[]; };

FiberAverage mixed(FiberAverage a, FiberAverage b, float part) {
    return FiberAverage(mix(a.forward, b.forward, part), mix(a.local, b.local, part),
                        mix(a.shifts, b.shifts, part), mix(a.own, b.own, part));
}

// An entry of a row and the part of the way to the next one.
struct AverageEntry {
    uint first;
    float part;
};

AverageEntry averageEntry(float cos_theta) {
    float place = cos_theta * float(kFiberAverages - 1u);
    uint first = min(uint(place), kFiberAverages - 2u);
    return AverageEntry(first, place - float(first));
}

FiberAverage averageInRow(HairOptics optics, AverageEntry place, uint row) {
    uint first = row * kFiberAverages + place.first;
    return mixed(FiberAverages(optics.averages).at[first],
                 FiberAverages(optics.averages).at[first + 1u], place.part);
}

// The averages of the strands around.
FiberAverage fiberAverage(HairOptics optics, float cos_theta) {
    AverageEntry place = averageEntry(cos_theta);
    if (kOwnColors == 0u) return averageInRow(optics, place, 0u);
    uint row = min(uint(optics.mean_row), kFiberAverageRows - 2u);
    return mixed(averageInRow(optics, place, row), averageInRow(optics, place, row + 1u),
                 optics.mean_row - float(row));
}

// a_f of the strand itself.
vec3 ownForward(HairOptics optics, float cos_theta) {
    AverageEntry place = averageEntry(cos_theta);
    uint row = min(uint(optics.own_row), kFiberAverageRows - 2u);
    uint at = row * kFiberAverages + place.first;
    FiberAverages table = FiberAverages(optics.averages);
    uint next = at + kFiberAverages;
    return mix(mix(table.at[at].own, table.at[at + 1u].own, place.part),
               mix(table.at[next].own, table.at[next + 1u].own, place.part),
               optics.own_row - float(row));
}

// The part of N_p in the half turn with its middle at these distances from the lobe's own. The
// logistic distribution wraps round the fibre.
vec4 azimuthalHalfIntegrals(HairOptics optics, vec3 distances) {
    const float half_pi = 1.57079633;
    float k = optics.inverse_azimuthal_scale;
    vec3 begin = 1.0 / (1.0 + exp(min(k * (half_pi - distances), 80.0)));
    bvec3 wraps = greaterThan(distances, vec3(half_pi));
    vec3 end = distances + mix(vec3(half_pi), vec3(-3.0 * half_pi), wraps);
    vec3 cdf = 1.0 / (1.0 + exp(min(-k * end, 80.0)));
    return vec4(mix(vec3(0.0), vec3(1.0), wraps) + optics.trimmed * (cdf - begin), 0.5);
}

// The part of the light from that direction that a fibre scatters forward to other fibres.
vec3 forwardScattering(HairOptics optics, vec3 to_light) {
    return fiberAverage(optics, sqrt(max(1.0 - to_light.x * to_light.x, 0.0))).forward.rgb;
}

// The fibre has its own colour, and those around it the mean colour. Light that they send back
// leaves through the fibre itself, so it has a_f of this one instead of the mean.
//
// f |cos theta_i| of a fibre whose light has come along `path`, which was computed with
// forwardScattering(). The result includes the losses on the path, except those by meshes.
// Directions are as in fiberBsdf(); `view` belongs to to_eye.
vec3 dualScattering(HairOptics optics, FiberView view, vec3 to_eye, vec3 to_light,
                    LightPath path) {
    float sin_i = clamp(to_light.x, -1.0, 1.0);
    float cos_i = sqrt(1.0 - sin_i * sin_i);
    float sin_o = clamp(to_eye.x, -1.0, 1.0);
    float cos_o = sqrt(1.0 - sin_o * sin_o);
    vec2 light = azimuthDirection(to_light);
    vec3 distances = azimuthalDistances(view, light);
    float cos_phi = dot(light, view.eye);
    FiberAverage average = fiberAverage(optics, cos_i);

    float forward_shift = path.scatter_count * average.shifts.x;
    float forward_variance = path.scatter_count * average.forward.w;

    // Shifts of the mean of theta_i: none, forward, backward, both.
    vec4 changes =
        vec4(0.0, forward_shift, average.shifts.y, forward_shift + average.shifts.y);
    vec4 sines = sin(changes);
    vec4 cosines = cos(changes);
    vec4 sin_from = sin_i * cosines - cos_i * sines;
    vec4 cos_from = abs(cos_i * cosines + sin_i * sines);

    // Local scattering: light from theta_i less the shift, seen from theta_o.
    vec4 local_variances = average.local.w + vec4(0.0, forward_variance, 0.0, 0.0);
    vec4 behind = longitudinalLobes(
        sin_o, cos_o, sin_from.zwzw, cos_from.zwzw, local_variances);
    vec2 around = kHalfInversePi * (1.0 + vec2(1.0, 2.0 * kInversePi) * cos_phi);
    vec2 local = 2.0 * behind.xy * around;
    // With m fibres behind, the paths that turn back once among them sum to 1 - q^m of the infinite
    // series. q is the part that one fibre passes there and back. A surface behind them sends back
    // the light that passes them.
    vec3 albedo = path.multiple_scattering *
                  (average.local.rgb * (1.0 - path.ended) + average.forward.rgb * path.returned);
    albedo *= optics.body;
    if (kOwnColors != 0u)
        albedo *= ownForward(optics, cos_i) / max(average.forward.rgb, vec3(1e-6));

    vec4 through = longitudinalLobes(
        sin_i, cos_i, view.sin_tilted, view.cos_tilted, optics.variances);
    through *= azimuthalLobes(optics, view, distances);
    vec3 sum = path.direct * (view.attenuations * through + local.x * albedo);
    vec4 spread = longitudinalLobes(
        sin_from.y, cos_from.y, view.sin_tilted, view.cos_tilted,
        optics.variances + forward_variance);
    spread *= kInversePi * azimuthalHalfIntegrals(optics, distances);
    return sum + path.scattered * (view.attenuations * spread + local.y * albedo);
}

#endif
