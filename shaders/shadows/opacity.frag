#version 460
// Adds a strand that a light sees to the opacity layers.
#extension GL_GOOGLE_include_directive : require
#include "common/depth.glsl"
#include "common/picture.glsl"
#include "shadows/layers.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ShadowMapReference { ShadowMap map; };
layout(push_constant, scalar) uniform Push { StrandPush push; };
layout(binding = 0) uniform sampler2D mesh_depths;
layout(binding = 1) uniform sampler2D hair_depths;

layout(location = 0) in float coverage;
layout(location = 0) out vec4 layers;

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    ShadowMap map = ShadowMapReference(picture.shadows).map;
    float nearest = texelFetch(hair_depths, ivec2(gl_FragCoord.xy), 0).r;
    float behind =
        viewDepth(map.depth_terms, gl_FragCoord.z) - viewDepth(map.depth_terms, nearest);
    // For deep_shadow, light ends at a mesh.
    if (map.ends_at_meshes != 0u &&
        isNearer(texelFetch(mesh_depths, ivec2(gl_FragCoord.xy), 0).r, gl_FragCoord.z))
        discard;
    layers = coverage * layersOf(behind, map.layer_depth);
}
