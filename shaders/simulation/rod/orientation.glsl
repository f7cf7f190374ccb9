#ifndef HAIRBENCH_SIMULATION_ROD_ORIENTATION_GLSL
#define HAIRBENCH_SIMULATION_ROD_ORIENTATION_GLSL

#include "common/quaternion.glsl"

// The orientation of a segment between what its edge and its neighbours want: Hsu, Wang, Wu and
// Yuksel 2025, Stable Cosserat rods. hair/reference/stable_cosserat.h has the energies.

// Of what a joint's energy loses with r, the rotation from one frame to the other where it is
// (0, 0, 0, 1) at rest: the coefficients of r, which touch the energy here and are nowhere less.
vec4 pullOfJoint(vec4 r, float bend_stiffness, float twist_stiffness) {
    float greatest = max(bend_stiffness, twist_stiffness);
    return 4.0 * vec4(
                     (greatest - bend_stiffness) * r.xy, (greatest - twist_stiffness) * r.z,
                     r.w < 0.0 ? -greatest : greatest);
}

// The same by the orientation of the joint's second segment. `half_rotation` is half of the way
// between the two at rest.
vec4 pullFromAbove(
    vec4 above, vec4 orientation, vec4 half_rotation, float bend_stiffness,
    float twist_stiffness) {
    vec4 frame = multiply(above, half_rotation);
    vec4 r = multiply(conjugate(frame), multiply(orientation, conjugate(half_rotation)));
    vec4 pull = pullOfJoint(r, bend_stiffness, twist_stiffness);
    return multiply(multiply(frame, pull), half_rotation);
}

// By that of its first segment.
vec4 pullFromBelow(
    vec4 orientation, vec4 below, vec4 half_rotation, float bend_stiffness,
    float twist_stiffness) {
    vec4 frame = multiply(below, conjugate(half_rotation));
    vec4 r = multiply(conjugate(multiply(orientation, half_rotation)), frame);
    vec4 pull = pullOfJoint(r, bend_stiffness, twist_stiffness);
    return multiply(multiply(frame, conjugate(pull)), conjugate(half_rotation));
}

// Newton steps of the multiplier; from 1.5 times its value they leave rounding.
const uint kMultiplierSteps = 3u;

// The unit quaternion q with the greatest b . q + edge . d3(q), d3 the third axis of its frame. That
// is q . P q with the linear map P q = -edge q e3, whose eigenvalues are |edge| and -|edge|, so that
//     q = with / t + against / (t + 4 |edge|),
// with what b has along either. Hebden's iteration finds the t > 0 at which that has the length 1:
// More and Sorensen 1983, Computing a trust region step. b must not be 0.
vec4 balancedOrientation(vec4 b, vec3 edge) {
    float size = length(edge);
    float gap = 4.0 * size;
    vec4 mapped = -multiply(multiply(vec4(edge, 0.0), b), vec4(0.0, 0.0, 1.0, 0.0));
    if (size > 0.0) mapped /= size;
    vec4 with = 0.5 * (b + mapped);
    vec4 against = 0.5 * (b - mapped);
    float with2 = dot(with, with);
    float against2 = dot(against, against);
    float t = length(b);
    float least = max(sqrt(with2), 1.0e-7 * t);
    for (uint i = 0; i < kMultiplierSteps; ++i) {
        float nearer = with2 / (t * t);
        float farther = against2 / ((t + gap) * (t + gap));
        float size2 = nearer + farther;
        float slope = nearer / t + farther / (t + gap);
        t = max(t + size2 / slope * (sqrt(size2) - 1.0), least);
    }
    return normalize(with + t / (t + gap) * against);
}

#endif
