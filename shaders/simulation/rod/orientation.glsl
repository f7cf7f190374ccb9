#ifndef HAIRBENCH_SIMULATION_ROD_ORIENTATION_GLSL
#define HAIRBENCH_SIMULATION_ROD_ORIENTATION_GLSL

#include "common/quaternion.glsl"

// The orientation of a segment that balances its edge and its neighbours: Hsu, Wang, Wu and Yuksel
// 2025, Stable Cosserat rods. hair/reference/compared_rods.h has the energies.

// Coefficients of a linear function of r that bounds the loss of a joint's energy. r is the
// rotation from one frame to the other, (0, 0, 0, 1) at rest. The bound touches the energy at this
// r and is nowhere smaller.
vec4 pullOfJoint(vec4 r, float bend_stiffness, float twist_stiffness) {
    float greatest = max(bend_stiffness, twist_stiffness);
    return 4.0 * vec4(
                     (greatest - bend_stiffness) * r.xy, (greatest - twist_stiffness) * r.z,
                     r.w < 0.0 ? -greatest : greatest);
}

// The bound's coefficients for the orientation of the joint's second segment. `half_rotation` is
// half of the rest rotation between the two.
vec4 pullFromAbove(
    vec4 above, vec4 orientation, vec4 half_rotation, float bend_stiffness,
    float twist_stiffness) {
    vec4 frame = multiply(above, half_rotation);
    vec4 r = multiply(conjugate(frame), multiply(orientation, conjugate(half_rotation)));
    vec4 pull = pullOfJoint(r, bend_stiffness, twist_stiffness);
    return multiply(multiply(frame, pull), half_rotation);
}

// The bound's coefficients for the orientation of the joint's first segment.
vec4 pullFromBelow(
    vec4 orientation, vec4 below, vec4 half_rotation, float bend_stiffness,
    float twist_stiffness) {
    vec4 frame = multiply(below, conjugate(half_rotation));
    vec4 r = multiply(conjugate(multiply(orientation, half_rotation)), frame);
    vec4 pull = pullOfJoint(r, bend_stiffness, twist_stiffness);
    return multiply(multiply(frame, conjugate(pull)), conjugate(half_rotation));
}

// Newton steps that leave only rounding errors: they begin at most at 1.5 times the multiplier.
const uint kMultiplierSteps = 3u;

// The unit quaternion q that maximises b . q + edge . d3(q), where d3 is the third axis of its
// frame. The last term is q . P q with the linear map P q = -edge q e3, with eigenvalues |edge| and
// -|edge|, so that
//     q = with / t + against / (t + 4 |edge|),
// with the parts of b in both eigenspaces. Hebden's iteration finds the t > 0 at which q has unit
// length: More and Sorensen 1983, Computing a trust region step. b must not be 0. Without steps it
// is the paper's: t = |b|.
vec4 balancedOrientation(vec4 b, vec3 edge, uint steps) {
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
    for (uint i = 0; i < steps; ++i) {
        float nearer = with2 / (t * t);
        float farther = against2 / ((t + gap) * (t + gap));
        float size2 = nearer + farther;
        float slope = nearer / t + farther / (t + gap);
        t = max(t + size2 / slope * (sqrt(size2) - 1.0), least);
    }
    return normalize(with + t / (t + gap) * against);
}

#endif
