#version 460
// Writes the depth of a mesh where its alpha mask is opaque.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "scene/options.glsl"
#include "shared/mesh_structs.h"

layout(push_constant, scalar) uniform Push { MeshPush push; };
layout(binding = 0) uniform sampler2D base_color_texture;

layout(location = 2) in vec2 coordinates;

void main() {
    float opacity = push.opacity;
    if (kBaseColorTexture == 1u) opacity *= texture(base_color_texture, coordinates).a;
    if (opacity < push.cutoff) discard;
}
