// Shadows of hair by rays: the strands that light meets on its way to a point, and behind it, each
// counted as a whole. Lokovic and Veach 2000, Deep shadow maps, have the same for the ray through
// each texel of a map.
#ifndef HAIRBENCH_TRACED_SHADOWS_GLSL
#define HAIRBENCH_TRACED_SHADOWS_GLSL

#extension GL_EXT_ray_query : require

#include "strands/rays/round_cone.glsl"

// The pieces of the strand that is shaded, which throws no shadow on itself: the first, and the
// first of the next strand. Equal for meshes.
uint own_begin = 0u;
uint own_end = 0u;

// A ray of light with a direction of length 1. Parameters are in m.
struct LightRay {
    vec3 origin;  // the light, or a point outside the hair
    vec3 direction;
    float place;  // of the point that is lit
};

// `source` and `reach` are as in ShadowParameters.
LightRay rayOfLight(vec4 source, float reach, vec3 position) {
    LightRay ray = LightRay(position, -source.xyz, reach);
    if (source.w != 0.0) {
        vec3 from_light = position - source.xyz;
        float distance = max(length(from_light), 1e-18);
        ray.direction = from_light / distance;
        ray.place = min(distance, reach);
    }
    ray.origin -= ray.place * ray.direction;
    return ray;
}

// The strands that a ray meets before the point and, up to its end, behind it. Strands of merged
// hairs count by the part of their width that these cover.
struct MetStrands {
    float before;
    float behind;
    float first;  // m: parameter of the first, the point's own strand included; kNowhere if there
                  // is none
};

// The place on a ray that is nearest to a piece's axis.
struct NearestPlace {
    float t;  // m: parameter of the ray
    bool meets;  // between the piece's ends, no farther from it than its radius there
};

// A ray meets a straight strand of several pieces once, because it is nearest to its axis at one
// place, and one that runs along it not at all. Quads that face the light are met there, too.
NearestPlace nearestPlace(LightRay ray, RoundCone cone) {
    float offset = dot(0.5 * (cone.from + cone.to) - ray.origin, ray.direction);
    vec3 start = (ray.origin - cone.from) + offset * ray.direction;
    vec3 axis = cone.to - cone.from;
    vec3 normal = cross(axis, ray.direction);
    float squared = dot(normal, normal);
    float rate = dot(axis, ray.direction);
    float along = dot(start, ray.direction);
    float place = (dot(start, axis) - rate * along) / squared;
    float radius = mix(cone.from_radius, cone.to_radius, place);
    float apart = dot(normal, start);  // times the length of `normal`
    bool is_between = place >= 0.0 && place < 1.0;
    return NearestPlace(offset + place * rate - along,
                        is_between && apart * apart <= radius * radius * squared);
}

MetStrands strandsOnRay(ShadowReference shadows, LightRay ray, float end) {
    Address points = shadows.parameters.points;
    StrandBoxes boxes = StrandBoxes(shadows.parameters.boxes);
    MetStrands met = MetStrands(0.0, 0.0, kNowhere);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(shadows.parameters.structure),
                          gl_RayFlagsNoneEXT, 0xffu, ray.origin, 0.0, ray.direction, end);
    while (rayQueryProceedEXT(query)) {
        StrandBox box = boxes.at[rayQueryGetIntersectionPrimitiveIndexEXT(query, false)];
        if (box.piece == kNoPiece) continue;
        NearestPlace nearest = nearestPlace(ray, coneOfPiece(points, box.piece));
        float t = nearest.t;
        if (!nearest.meets || t < 0.0 || t > end) continue;
        met.first = min(met.first, t);
        if (box.piece >= own_begin && box.piece < own_end) continue;
        if (t < ray.place)
            met.before += box.covered;
        else
            met.behind += box.covered;
    }
    return met;
}

// Returns the parameter of the first strand that a ray meets; kNowhere if it meets none.
float firstOnRay(ShadowReference shadows, LightRay ray, float end) {
    Address points = shadows.parameters.points;
    StrandBoxes boxes = StrandBoxes(shadows.parameters.boxes);
    float first = kNowhere;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(shadows.parameters.structure),
                          gl_RayFlagsNoneEXT, 0xffu, ray.origin, 0.0, ray.direction, end);
    while (rayQueryProceedEXT(query)) {
        uint piece = boxes.at[rayQueryGetIntersectionPrimitiveIndexEXT(query, false)].piece;
        if (piece == kNoPiece) continue;
        NearestPlace nearest = nearestPlace(ray, coneOfPiece(points, piece));
        float t = nearest.t;
        if (!nearest.meets || t < 0.0 || t > min(end, first)) continue;
        rayQueryGenerateIntersectionEXT(query, t);
        first = t;
    }
    return first;
}

#endif
