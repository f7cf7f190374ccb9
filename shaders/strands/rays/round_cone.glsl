// A ray through a round piece of a strand.
#ifndef HAIRBENCH_ROUND_CONE_GLSL
#define HAIRBENCH_ROUND_CONE_GLSL

#include "strands/points/points.glsl"

#include "shared/software_structs.h"

layout(buffer_reference, scalar) buffer StrandBoxes { StrandBox at[]; };

// The convex hull of two balls: all balls between them, with radii in between. NVIDIA's linear
// swept spheres are the same (VK_NV_ray_tracing_linear_swept_spheres).
struct RoundCone {
    vec3 from;  // m: middles of the balls
    vec3 to;
    float from_radius;  // m
    float to_radius;
};

RoundCone coneOfPiece(Address points, uint piece) {
    PackedPoint from = loadPoint(points, piece);
    PackedPoint to = loadPoint(points, piece + 1u);
    return RoundCone(from.position, to.position, 0.5 * from.width, 0.5 * to.width);
}

// The parameters of a ray between which it is in a body. No ray is in a body without points.
struct RayChord {
    float enters;
    float leaves;
};

const float kNowhere = 3e38;

bool isChord(RayChord chord) { return chord.enters <= chord.leaves; }

// The middle of the chord: where the ray is nearest to the axis of a cylinder or the middle of a
// ball. The quads that the other back ends draw lie there.
float chordMiddle(RayChord chord) { return 0.5 * (chord.enters + chord.leaves); }

void extend(inout RayChord chord, float t) {
    chord.enters = min(chord.enters, t);
    chord.leaves = max(chord.leaves, t);
}

// The chord of a ball, from the middle of the ball to the ray's origin. The distance of the ray
// from the middle is found before its square is subtracted, so that thin strands lose no digits
// (Haines et al. 2019, Precision improvements for ray/sphere intersection, Ray Tracing Gems).
void extendByBall(inout RayChord chord, vec3 origin, vec3 direction, float radius) {
    float along = dot(origin, direction);
    vec3 beside = origin - along * direction;
    float squared = radius * radius - dot(beside, beside);
    if (squared < 0.0) return;
    float reach = sqrt(squared);
    extend(chord, -along - reach);
    extend(chord, -along + reach);
}

// The chord of a ray, origin + t direction, with a direction of length 1. The body is convex, so
// the chord reaches from the first to the last point of the ray on the surface of one of its parts:
// the balls, and the cone that touches both, between the circles where it touches them. The quadric
// of the cone is that of Quilez (iquilezles.org/articles/intersectors, rounded cone). It is
// evaluated from the middle of the piece, with cross products for differences of squares of
// lengths, because strands are thousands of times as long as wide.
RayChord chordOf(vec3 origin, vec3 direction, RoundCone cone) {
    float offset = dot(0.5 * (cone.from + cone.to) - origin, direction);
    vec3 start = (origin - cone.from) + offset * direction;  // from the first ball
    vec3 axis = cone.to - cone.from;
    RayChord chord = RayChord(kNowhere, -kNowhere);
    extendByBall(chord, start, direction, cone.from_radius);
    extendByBall(chord, start - axis, direction, cone.to_radius);

    float narrowing = cone.from_radius - cone.to_radius;
    float squared_axis = dot(axis, axis);
    float between = squared_axis - narrowing * narrowing;  // not above 0: one ball is in the other
    vec3 normal = cross(axis, direction);
    vec3 moment = cross(axis, start);
    float rate = dot(axis, direction);
    float along = dot(axis, start);
    float square = cone.from_radius * cone.from_radius;
    // a t^2 + 2 b t + c = 0; without narrowing it is a cylinder's.
    float normals = dot(normal, normal);
    float both = dot(normal, moment);
    float b_taper =
        narrowing * (cone.from_radius * rate - narrowing * dot(direction, start));
    float c_taper =
        narrowing * (2.0 * along * cone.from_radius - narrowing * dot(start, start));
    float a = normals - narrowing * narrowing;
    float b = both + b_taper;
    float c = dot(moment, moment) - squared_axis * square + c_taper;
    float distance = dot(normal, start);  // of the lines, times the length of `normal`
    float discriminant =
        squared_axis * (square * normals - distance * distance) + (2.0 * both + b_taper) * b_taper +
        narrowing * narrowing * (dot(moment, moment) - squared_axis * square) - c_taper * a;
    if (between > 0.0 && discriminant >= 0.0) {
        float root = sqrt(discriminant);
        float sum = -(b + (b < 0.0 ? -root : root));
        for (int i = 0; i < 2; ++i) {
            float t = i == 0 ? sum / a : c / sum;
            float place = along - cone.from_radius * narrowing + t * rate;  // times `between`
            if (place > 0.0 && place < between) extend(chord, t);
        }
    }
    chord.enters += offset;
    chord.leaves += offset;
    return chord;
}

#endif
