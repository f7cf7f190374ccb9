#version 460
// Adds a strand's fragment to the list of its pixel: Yang et al. 2010, Real-time concurrent linked
// list construction on the GPU. With several samples, alpha is scaled by the covered part of them.
#extension GL_GOOGLE_include_directive : require
#include "strands/fragment.glsl"
#include "strands/pixel_margin.glsl"

layout(early_fragment_tests) in;

layout(buffer_reference, scalar) readonly buffer Lists { FragmentLists lists; };
layout(buffer_reference, scalar) buffer Heads { uint heads[]; };
layout(buffer_reference, scalar) writeonly buffer Nodes { FragmentNode nodes[]; };
layout(buffer_reference, scalar) buffer Counter { uint wanted; };

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    vec4 strand = transparentStrand(picture);
    strand.a *= float(bitCount(gl_SampleMaskIn[0])) / float(kSamples);
    FragmentLists lists = Lists(picture.fragments).lists;
    uint index = atomicAdd(Counter(lists.counters).wanted, 1u);
    if (index >= lists.capacity) return;
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    FragmentNode node;
    node.red_green = packHalf2x16(strand.rg);
    node.blue_alpha = packHalf2x16(strand.ba);
    node.depth = gl_FragCoord.z;
    node.next = atomicExchange(Heads(lists.heads).heads[pixel.y * lists.width + pixel.x], index);
    Nodes(lists.nodes).nodes[index] = node;
}
