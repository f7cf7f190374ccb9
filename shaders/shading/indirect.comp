#version 460
// Light that lit surfaces of hair and meshes send to the vertices of meshes: reflective shadow maps
// (Dachsbacher and Stamminger 2005), whose texels are small lights. The first part makes lights of
// texels of each light's shadow map, and HAIRBENCH_GATHER sums them up for each vertex. Nothing is
// between a source and a vertex.
#extension GL_GOOGLE_include_directive : require
#define HAIRBENCH_SHADOW_BINDING 0
#include "common/picture.glsl"
#include "shared/mesh_structs.h"

layout(local_size_x = kIndirectGroupSize) in;

layout(push_constant, scalar) uniform Push { IndirectPush push; };
layout(buffer_reference, scalar) buffer Sources { IndirectSource at[]; };

#ifdef HAIRBENCH_GATHER

layout(buffer_reference, scalar) buffer Vectors { vec3 at[]; };

void main() {
    uint vertex = gl_GlobalInvocationID.x;
    if (vertex >= push.vertices) return;
    vec3 position = Vectors(push.positions).at[vertex];
    vec3 normal = Vectors(push.normals).at[vertex];
    if (push.is_moving == 1u) {
        mat4 head = PictureReference(push.picture).parameters.head;
        position = (head * vec4(position, 1.0)).xyz;
        normal = mat3(head) * normal;
    }
    normal *= inversesqrt(max(dot(normal, normal), 1e-18));
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < push.sources_count; ++i) {
        IndirectSource source = Sources(push.sources).at[i];
        if (source.area == 0.0) continue;  // its texel shows nothing
        vec3 offset = source.position - position;
        float squared = dot(offset, offset);
        float here = max(dot(normal, offset), 0.0);
        float there = max(-dot(source.normal, offset), 0.0);
        if (source.normal == vec3(0.0)) there = 0.25 * sqrt(squared);  // its mean over all sides
        // The form factor of a disc, which stays below 1 near it: Wallace, Elmquist and Haines
        // 1989, A ray tracing algorithm for progressive radiosity, equation (2).
        float factor = source.area / (3.14159265 * squared + source.area);
        sum += here * there * factor / max(squared, 1e-12) * source.color;
    }
    Vectors(push.light).at[vertex] = sum;
}

#else

#include "shading/lights.glsl"
#include "shading/shadows.glsl"
#include "shading/surface_brdf.glsl"

// A surface that is steeper to the light counts as this steep (cosine).
const float kLeastCosine = 0.1;

struct MapOfSources {
    ShadowMap map;
    mat4 to_world;
    float step;  // texels between sources
    float side;  // texels
};

vec3 worldPosition(MapOfSources from, vec2 texel, float depth) {
    vec4 position = from.to_world * vec4(2.0 * texel / from.side - 1.0, depth, 1.0);
    return position.xyz / position.w;
}

float depthOf(MapOfSources from, sampler2D depths, vec2 texel) {
    ivec2 place = ivec2(clamp(texel, vec2(0.0), vec2(from.side - 1.0)));
    return texelFetch(depths, ivec2(from.map.corner) + place, 0).r;
}

// The mean number of strands that light meets in front of the first mesh.
float strandsBeforeMeshes(MapOfSources from, vec2 texel) {
    if ((from.map.casters & kHairCasts) == 0u) return 0.0;
    vec4 layers = texelFetch(hair_layers, ivec2(from.map.corner) + ivec2(texel), 0);
    bool has_meshes = (from.map.casters & kMeshesCast) != 0u;
    float surface = has_meshes ? depthOf(from, mesh_depths, texel) : float(kFarDepth);
    if (from.map.ends_at_meshes != 0u || !isNearer(surface, float(kFarDepth))) return layers.w;
    float behind = viewDepth(from.map.depth_terms, surface) -
                   viewDepth(from.map.depth_terms, depthOf(from, hair_depths, texel));
    return strandsBefore(layers, max(behind, 0.0), from.map.layer_depth);
}

// The vector to a neighbouring point of the surface, along one axis of the map: to the side on
// which depth changes less.
vec3 tangentAlong(MapOfSources from, sampler2D depths, vec2 texel, float depth, vec2 axis) {
    vec2 after = texel + 0.5 * from.step * axis;
    vec2 before = texel - 0.5 * from.step * axis;
    float depth_after = depthOf(from, depths, after);
    float depth_before = depthOf(from, depths, before);
    vec3 here = worldPosition(from, texel, depth);
    if (abs(depth_after - depth) <= abs(depth_before - depth))
        return worldPosition(from, after, depth_after) - here;
    return here - worldPosition(from, before, depth_before);
}

// The part of the surface round a texel, as a source that sends back all light.
IndirectSource sourceAt(PictureParameters picture, uint light, MapOfSources from, sampler2D depths,
                        vec2 texel) {
    IndirectSource source = IndirectSource(vec3(0.0), 0.0, vec3(0.0), vec3(0.0));
    float depth = depthOf(from, depths, texel);
    if (!isNearer(depth, float(kFarDepth))) return source;
    source.position = worldPosition(from, texel, depth);
    LightSample sampled = lightAt(pictureLight(picture, light), source.position);
    vec3 normal = cross(tangentAlong(from, depths, texel, depth, vec2(1.0, 0.0)),
                        tangentAlong(from, depths, texel, depth, vec2(0.0, 1.0)));
    normal *= inversesqrt(max(dot(normal, normal), 1e-30));
    source.normal = dot(normal, sampled.to_light) < 0.0 ? -normal : normal;
    float size =
        from.step * (from.map.texel_near +
                     from.map.texel_slope * viewDepth(from.map.depth_terms, depth));
    float cosine = max(dot(source.normal, sampled.to_light), kLeastCosine);
    source.area = size * size / cosine;
    source.color = mattResponse(sampled, source.normal) * sampled.color;
    return source;
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= push.sources_count) return;
    uint light = number / (2u * push.side * push.side);
    uint in_light = number % (2u * push.side * push.side);
    uint texel_number = in_light / 2u;
    bool is_hair = in_light % 2u == 0u;
    PictureParameters picture = PictureReference(push.picture).parameters;
    ShadowReference shadows = ShadowReference(picture.shadows);
    IndirectSource source = IndirectSource(vec3(0.0), 0.0, vec3(0.0), vec3(0.0));
    MapOfSources from;
    from.map = shadows.parameters.maps[light];
    uint caster = is_hair ? kHairCasts : kMeshesCast;
    if ((from.map.casters & caster) != 0u) {
        from.to_world = inverse(from.map.view_projection);
        from.side = shadows.parameters.side;
        from.step = from.side / float(push.side);
        vec2 texel =
            floor((vec2(texel_number % push.side, texel_number / push.side) + 0.5) * from.step) +
            0.5;
        float strands = strandsBeforeMeshes(from, texel);
        vec3 through = exp(-strands * (1.0 - shadows.parameters.transmittance));
        if (is_hair) {
            // Strands scatter the light that they do not absorb evenly to all sides.
            source = sourceAt(picture, light, from, hair_depths, texel);
            source.color *= shadows.parameters.transmittance * (1.0 - exp(-strands));
            source.normal = vec3(0.0);
        } else {
            source = sourceAt(picture, light, from, mesh_depths, texel);
            source.color *= (1.0 - kDielectric) * shadows.parameters.mesh_color * through;
        }
    }
    Sources(push.sources).at[number] = source;
}

#endif
