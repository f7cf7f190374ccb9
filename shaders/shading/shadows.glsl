// What is between a light and a point: shadow maps of meshes, deep opacity maps of hair.
#ifndef HAIRBENCH_SHADOWS_GLSL
#define HAIRBENCH_SHADOWS_GLSL

#include "common/depth.glsl"
#include "common/picture.glsl"
#include "shading/options.glsl"
#include "shadows/layers.glsl"

// ShadowPass::images() are at this binding and the next two.
#ifndef HAIRBENCH_SHADOW_BINDING
#define HAIRBENCH_SHADOW_BINDING 1
#endif

layout(buffer_reference, scalar) readonly buffer ShadowReference { ShadowParameters parameters; };
layout(binding = HAIRBENCH_SHADOW_BINDING) uniform sampler2D mesh_depths;
layout(binding = HAIRBENCH_SHADOW_BINDING + 1) uniform sampler2D hair_depths;
layout(binding = HAIRBENCH_SHADOW_BINDING + 2) uniform sampler2D hair_layers;

struct LightPath {
    float meshes;  // part of the light that meshes let through, 0 to 1
    float strands;  // mean number of strands that it meets
};

// A point in a map. Depths of texels round it are taken to lie on a plane through it.
struct ShadowPoint {
    vec2 texel;  // within the light's part of the atlas
    float depth;
    vec2 slope;  // of depth, per texel
    float most_slope;  // of each part of it
    float bias;  // of depth: what is in front of the point by less than this doesn't shade it
};

// Surfaces steeper than this (tangent of the angle to the light) are taken to be as steep: light
// that comes in at less than 6 degrees shows little.
const float kSteepest = 10.0;
// Surfaces: half a texel for rounding, and what a neighbouring triangle that is turned by this
// more (5 degrees, in rad) rises in the filter: (1 + tan^2) times the angle per texel.
const float kSurfaceBias = 0.5;
const float kTurned = 0.0873;
// Strands lie on surfaces whose slope they don't know: one of 63 degrees may rise this much within
// the filter, times its half width and half a texel.
const float kStrandBias = 2.0;

vec2 planeSlope(ShadowMap map, vec3 clip, vec3 normal, float side) {
    vec3 a = abs(normal.x) > 0.5 ? vec3(-normal.y, normal.x, 0.0) : vec3(0.0, -normal.z, normal.y);
    vec3 b = cross(normal, a);
    vec4 along_a = map.view_projection * vec4(a, 0.0);
    vec4 along_b = map.view_projection * vec4(b, 0.0);
    vec3 d_a = along_a.xyz - clip * along_a.w;
    vec3 d_b = along_b.xyz - clip * along_b.w;
    float area = d_a.x * d_b.y - d_a.y * d_b.x;
    vec2 slope = vec2(d_a.z * d_b.y - d_a.y * d_b.z, d_a.x * d_b.z - d_a.z * d_b.x);
    return slope / (abs(area) < 1e-20 ? 1e-20 : area) * 2.0 / side;  // clip space is 2 wide
}

// The mean over a square of `half_width` texels to each side, texels in part by what is in it: 0.5
// is bilinear interpolation of what each texel says.
LightPath filteredPath(ShadowMap map, ShadowPoint point, float half_width) {
    vec2 whole = floor(point.texel);
    vec2 centre = point.texel - whole;  // small, for weights without rounding
    ivec2 first = ivec2(floor(centre - half_width));
    ivec2 last = ivec2(ceil(centre + half_width)) - 1;
    LightPath path = LightPath(0.0, 0.0);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            vec2 low = vec2(x, y);
            vec2 inside = min(low + 1.0, centre + half_width) - max(low, centre - half_width);
            float weight = inside.x * inside.y / (4.0 * half_width * half_width);
            vec2 rise = point.slope * (low + 0.5 - centre);
            vec2 most = point.most_slope * abs(low + 0.5 - centre);
            vec2 limited = clamp(rise, -most, most);
            float depth = notBeyondFar(point.depth + limited.x + limited.y);
            ivec2 at = ivec2(map.corner) + ivec2(whole) + ivec2(x, y);
            if (kMeshShadows != 0 && (map.casters & kMeshesCast) != 0u) {
                float drawn = texelFetch(mesh_depths, at, 0).r;
                bool lit = isNearerOrEqual(nearer(depth, point.bias), drawn);
                path.meshes += lit ? weight : 0.0;
            }
            if (kHairShadows != 0 && (map.casters & kHairCasts) != 0u) {
                float nearest = texelFetch(hair_depths, at, 0).r;
                float behind =
                    viewDepth(map.depth_terms, depth) - viewDepth(map.depth_terms, nearest);
                vec4 layers = texelFetch(hair_layers, at, 0);
                path.strands += weight * strandsBefore(layers, behind, map.layer_depth);
            }
        }
    }
    if (kMeshShadows == 0 || (map.casters & kMeshesCast) == 0u) path.meshes = 1.0;
    return path;
}

// The path of light to a point of a surface. `normal` is that of the triangle (its sign doesn't
// matter); 0 for a point of a strand.
LightPath lightPath(PictureParameters picture, uint light, vec3 position, vec3 normal) {
    LightPath free = LightPath(1.0, 0.0);
    if (kMeshShadows == 0 && kHairShadows == 0) return free;
    ShadowReference shadows = ShadowReference(picture.shadows);
    ShadowMap map = shadows.parameters.maps[light];
    if (map.casters == 0u) return free;
    vec4 clip = map.view_projection * vec4(position, 1.0);
    if (clip.w <= 0.0) return free;  // behind the light's view
    clip.xyz /= clip.w;

    float side = shadows.parameters.side;
    float half_width = max(shadows.parameters.softness, 0.5);
    // All of the filter lies in the map.
    if (any(greaterThan(abs(clip.xy), vec2(1.0 - 2.0 * half_width / side)))) return free;
    if (isNearer(clip.z, float(kNearDepth))) return free;
    float z = viewDepth(map.depth_terms, clip.z);
    float depth_per_texel =
        depthPerMetre(map.depth_terms, z) * (map.texel_near + map.texel_slope * z);
    ShadowPoint point;
    point.texel = (0.5 * clip.xy + 0.5) * side;
    point.depth = clip.z;
    point.slope = vec2(0.0);
    point.most_slope = kSteepest * depth_per_texel;
    point.bias = kStrandBias * (half_width + 0.5) * depth_per_texel;
    if (normal != vec3(0.0)) {
        point.slope = planeSlope(map, clip.xyz, normal, side);
        vec2 steepness = min(abs(point.slope) / depth_per_texel, vec2(kSteepest));
        float rise = kTurned * (half_width + 0.5) * (1.0 + dot(steepness, steepness));
        point.bias = (kSurfaceBias + rise) * depth_per_texel;
    }
    return filteredPath(map, point, half_width);
}

// The path of light to a point of a strand.
LightPath lightPath(PictureParameters picture, uint light, vec3 position) {
    return lightPath(picture, light, position, vec3(0.0));
}

// Part of the light that opaque shading models get: thesis's and meshes'. The number of strands is
// random, of Poisson's distribution, where they lie at random; the mean of (1 - stopped)^number is
// this.
float visibility(PictureParameters picture, LightPath path) {
    if (kHairShadows == 0) return path.meshes;
    float stopped = ShadowReference(picture.shadows).parameters.stopped;
    return path.meshes * exp(-stopped * path.strands);
}

#endif
