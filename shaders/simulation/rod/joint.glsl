#ifndef HAIRBENCH_SIMULATION_ROD_JOINT_GLSL
#define HAIRBENCH_SIMULATION_ROD_JOINT_GLSL

#include "common/quaternion.glsl"
#include "shared/options.h"

// True if cross-sections are ellipses, so that a rod bends more easily round one axis.
layout(constant_id = kEllipticSectionConstant) const bool kEllipticSection = false;

// True if hair takes a set: rod_structs.h, RodParameters. hair/reference/rod.h has the law.
layout(constant_id = kRodSetConstant) const bool kSets = false;

// Bending and twisting of a rod between two frames that coincide at rest: the discrete elastica of
// Bobenko and Suris 1999, Discrete time Lagrangian mechanics on Lie groups, with the energy
//     -(4 / n^2) K ln cos(n b / 2) + fade K' t^2 / 2
// for a bend by b between the third axes and a twist by t round the axis between them. n is 1. At
// the follicle it is 2, where half of a joint and its mirror image bend twice as much. Where n b
// exceeds 120 degrees, the torque of the bend continues linearly; where b does, the twist fades.
// Accurate parts avoid trigonometry, because Vulkan guarantees only 11 bits of it.
//
// For an elliptic section, K is K(p) = K (e cos^2 p + sin^2 p / e). p is the direction of the
// bend's axis in the frame halfway between the two, and e is the ellipse's ratio of axes.
struct RodJoint {
    vec3 torque;     // on the second frame, in world axes; the first gets the opposite
    mat3 stiffness;  // torque per small rotation of the second frame
};

// 2 atan2(z, w) from the tangent of an eighth of it; c = length of (z, w), w >= 0. The series is
// off by less than 1e-5 at half a turn, and only by rounding at small angles.
float twistAngle(float z, float w, float c) {
    float quarter = z / (c + w);
    float t = quarter / (1.0 + sqrt(1.0 + quarter * quarter));
    float s = t * t;
    float series =
        1.0 - s * (1.0 / 3.0 - s * (1.0 / 5.0 - s * (1.0 / 7.0 - s * (1.0 / 9.0 - s / 11.0))));
    return 8.0 * t * series;
}

// -ln(1 - x) / x, 0 <= x <= 3/4, by the series of 2 artanh(q) with q = x / (2 - x). It is off by
// less than 5e-5, and only by rounding at small x.
float logarithmOver(float x) {
    float q = x / (2.0 - x);
    float s = q * q;
    float series = 1.0 + s * (1.0 / 3.0 + s * (1.0 / 5.0 + s * (1.0 / 7.0 + s * (1.0 / 9.0 + s * (
        1.0 / 11.0 + s * (1.0 / 13.0 + s / 15.0))))));
    return 2.0 / (2.0 - x) * series;
}

// Half of the strain at which the yielding share of a joint has no torque, after a substep's
// relaxation towards the strain from `first` to `second`: the tangent of a quarter of the angle
// between the two falls to `kept` of itself, round the same axis. Strains are small, so their
// vectors keep changes of a millionth that a rotation of the whole joint would lose.
vec4 relaxed(vec4 set, vec4 first, vec4 second, float kept) {
    vec4 now = multiply(conjugate(first), second);
    vec4 apart = multiply(conjugate(now), multiply(set, set));
    if (apart.w < 0.0) apart = -apart;
    vec3 tangent = kept / (1.0 + apart.w) * apart.xyz;
    float square = dot(tangent, tangent);
    vec4 rotation = multiply(now, vec4(2.0 * tangent, 1.0 - square) / (1.0 + square));
    if (rotation.w < 0.0) rotation = -rotation;
    return normalize(rotation + kNoRotation);
}

// The energy of a joint, in units of the stiffness. The first axes coincide at rest.
float jointEnergy(
    vec4 first, vec4 second, float bend_stiffness, float twist_stiffness, float ellipticity,
    bool at_follicle) {
    vec4 r = multiply(conjugate(first), second);
    if (r.w < 0.0) r = -r;
    float cosine2 = max(r.w * r.w + r.z * r.z, 1.0e-12);  // of half the bend, squared
    float sine2 = r.x * r.x + r.y * r.y;
    float n = at_follicle ? 2.0 : 1.0;
    float bend = 2.0 * sine2 * logarithmOver(min(at_follicle ? 2.0 * sine2 : sine2, 0.75));
    if (at_follicle ? cosine2 - sine2 < 0.5 : cosine2 < 0.25) {
        float beyond = 2.0 * atan(sqrt(sine2), sqrt(cosine2)) - 2.0943951 / n;
        bend = 2.7725887 / (n * n) + beyond * (3.4641016 / n + 2.0 * beyond);
    }
    if (kEllipticSection)
        bend *= (ellipticity * r.x * r.x + r.y * r.y / ellipticity) / max(sine2, 1.0e-30);
    float twist = twistAngle(r.z, r.w, sqrt(cosine2));
    float fade = cosine2 < 0.25 ? 16.0 * cosine2 * cosine2 : 1.0;
    return bend_stiffness * bend + 0.5 * twist_stiffness * fade * twist * twist;
}

RodJoint bendAndTwist(
    vec4 first, vec4 second, float bend_stiffness, float twist_stiffness, float ellipticity,
    bool at_follicle) {
    vec4 r = multiply(conjugate(first), second);
    if (r.w < 0.0) r = -r;
    float cosine2 = r.w * r.w + r.z * r.z;  // of half the bend, squared
    if (cosine2 < 1.0e-12) {  // opposite axes: the twist is arbitrary
        r.zw = vec2(0.0, 1.0e-6);
        cosine2 = 1.0e-12;
    }
    float sine2 = r.x * r.x + r.y * r.y;
    // The axis round which the bend grows and the axis perpendicular to it, both of length sine *
    // cosine.
    vec3 across = vec3(r.w * r.x - r.z * r.y, r.w * r.y + r.z * r.x, 0.0);
    vec3 beside = vec3(across.y, -across.x, 0.0);

    float torque;  // divided by K and `across`
    float more;    // excess of the stiffness round `across` over K, divided by K and the square of
                   // `across`
    float energy = 0.0;  // divided by K and `sine2`; ellipses only
    float cosine = cosine2 - sine2;  // of the bend
    bool along_line = at_follicle ? cosine < 0.5 : cosine2 < 0.25;
    if (along_line) {
        float n = at_follicle ? 2.0 : 1.0;
        float product = sqrt(sine2 * cosine2);
        float beyond = 2.0 * atan(sqrt(sine2), sqrt(cosine2)) - 2.0943951 / n;
        torque = (3.4641016 / n + 4.0 * beyond) / product;
        more = 3.0 / (product * product);
        if (kEllipticSection)
            energy = (2.7725887 / (n * n) + beyond * (3.4641016 / n + 2.0 * beyond)) / sine2;
    } else if (at_follicle) {
        torque = 2.0 / cosine;
        more = 4.0 / (cosine * cosine);
        if (kEllipticSection) energy = 2.0 * logarithmOver(2.0 * sine2);
    } else {
        torque = 2.0 / cosine2;
        more = 1.0 / (cosine2 * cosine2);
        if (kEllipticSection) energy = 2.0 * logarithmOver(sine2);
    }

    float twist = twistAngle(r.z, r.w, sqrt(cosine2));
    bool fades = cosine2 < 0.25;
    float fade = fades ? 16.0 * cosine2 * cosine2 : 1.0;
    float fade_slope = fades ? 32.0 * cosine2 : 0.0;
    vec3 axis = vec3(0.0, 0.0, 1.0);
    float directed = bend_stiffness;  // K(p)
    if (kEllipticSection)
        directed *= (ellipticity * r.x * r.x + r.y * r.y / ellipticity) / max(sine2, 1.0e-30);
    vec3 gradient = directed * torque * across +
                    twist_stiffness * (twist * fade * (axis + beside / cosine2) -
                                       0.5 * twist * twist * fade_slope * across);

    if (kEllipticSection) {
        // The energy's derivative by p, which grows by half of axis - beside / sine2.
        gradient += bend_stiffness * (1.0 / ellipticity - ellipticity) * energy * r.x * r.y *
                    (axis - beside / max(sine2, 1.0e-30));
        // The part of the bend along the longer axis grows along `stiff`. The bend along the
        // shorter axis resists twists accordingly.
        vec3 stiff = rotate(
            first, vec3(r.w, r.z, 0.0) * inversesqrt(cosine2) - r.y * sqrt(0.5 * energy) * axis);
        axis = rotate(first, axis);
        across = rotate(first, across);
        mat3 along_tangent = outerProduct(axis, axis);
        return RodJoint(
            -rotate(first, gradient),
            bend_stiffness * ((mat3(1.0) - along_tangent) / ellipticity +
                              (ellipticity - 1.0 / ellipticity) * outerProduct(stiff, stiff)) +
                directed * more * outerProduct(across, across) + twist_stiffness * along_tangent);
    }

    axis = rotate(first, axis);
    across = rotate(first, across);
    mat3 along = outerProduct(axis, axis);
    return RodJoint(
        -rotate(first, gradient),
        bend_stiffness * (mat3(1.0) - along + more * outerProduct(across, across)) +
            twist_stiffness * along);
}

#endif
