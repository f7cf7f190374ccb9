#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// Writes the difference of two pictures of one size: |a - b| of their display colours, brightened.
// It also counts the differences exactly in integers, since pictures have 8 bits per channel.
#include "common/extensions.glsl"
#include "shared/difference_structs.h"

layout(local_size_x = kDifferenceGroupSide, local_size_y = kDifferenceGroupSide) in;
layout(binding = 0) uniform texture2D picture_a;
layout(binding = 1) uniform texture2D picture_b;
layout(binding = 2, rgba8) uniform writeonly image2D difference;

layout(push_constant, scalar) uniform Push { DifferencePush push; };

layout(buffer_reference, scalar) buffer CountsReference { DifferenceCounts counts; };

const uint kMost = 255;  // largest step of a channel

shared DifferenceCounts group;  // its sum stays below kDifferenceGroupSide^2 x 3 x kMost

uvec3 stepsOf(vec4 color) { return uvec3(round(color.rgb * float(kMost))); }

void addToGroup(uvec3 steps) {
    uint sum = steps.r + steps.g + steps.b;
    if (sum == 0) return;
    atomicAdd(group.pixels, 1);
    atomicMax(group.most, max(steps.r, max(steps.g, steps.b)));
    atomicAdd(group.sum, sum);
}

void addToAll(CountsReference all) {
    atomicAdd(all.counts.pixels, group.pixels);
    atomicMax(all.counts.most, group.most);
    uint before = atomicAdd(all.counts.sum, group.sum);
    if (before + group.sum < before) atomicAdd(all.counts.carry, 1);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    bool first = gl_LocalInvocationIndex == 0;
    if (first) group = DifferenceCounts(0, 0, 0, 0);
    barrier();
    if (all(lessThan(pixel, imageSize(difference)))) {
        uvec3 a = stepsOf(texelFetch(picture_a, pixel, 0));
        uvec3 b = stepsOf(texelFetch(picture_b, pixel, 0));
        uvec3 steps = max(a, b) - min(a, b);
        addToGroup(steps);
        vec3 shown = vec3(min(steps * push.gain, uvec3(kMost))) / float(kMost);
        imageStore(difference, pixel, vec4(shown, 1.0));
    }
    barrier();
    if (first && group.pixels > 0) addToAll(CountsReference(push.counts));
}
