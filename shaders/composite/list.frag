#version 460
// Blends a pixel's list of fragments into one fragment over the picture. All fragments are blended
// in order, however long the list is. Each pass selects and sorts the kChunk nearest remaining
// fragments. It ends with the list, or when nothing behind is visible.
#extension GL_GOOGLE_include_directive : require
#include "common/depth.glsl"
#include "common/extensions.glsl"
#include "shared/fragment_structs.h"

layout(push_constant, scalar) uniform Push { CompositePush push; };
layout(buffer_reference, scalar) readonly buffer Lists { FragmentLists lists; };
layout(buffer_reference, scalar) readonly buffer Heads { uint heads[]; };
layout(buffer_reference, scalar) readonly buffer Nodes { FragmentNode nodes[]; };

layout(location = 0) out vec4 color;

const uint kChunk = 16;
const float kUnseen = 1.0 / 4096.0;  // of the background: a sixteenth of a step of 8-bit colours

// The order in which fragments are blended: by depth, then by colour, then by index. Depth and
// colour do not depend on how the list was built. The index decides between fragments that look the
// same.
bool isBefore(Nodes list, float depth_a, uint a, float depth_b, uint b) {
    if (depth_a != depth_b) return isNearer(depth_a, depth_b);
    FragmentNode node_a = list.nodes[a];
    FragmentNode node_b = list.nodes[b];
    if (node_a.blue_alpha != node_b.blue_alpha) return node_a.blue_alpha < node_b.blue_alpha;
    if (node_a.red_green != node_b.red_green) return node_a.red_green < node_b.red_green;
    return a < b;
}

void main() {
    FragmentLists lists = Lists(push.fragments).lists;
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    // A helper invocation may lie outside the picture, past the end of the heads.
    if (pixel.x >= lists.width || pixel.y >= lists.height) return;
    uint head = Heads(lists.heads).heads[pixel.y * lists.width + pixel.x];
    if (head == kNoFragment) discard;
    Nodes list = Nodes(lists.nodes);

    vec3 light = vec3(0.0);
    float revealed = 1.0;
    float last_depth = -1.0;  // of the farthest blended fragment; negative before the first
    uint last = 0u;
    uint found = kChunk;
    while (found == kChunk && revealed > kUnseen) {
        float depths[kChunk];
        uint indices[kChunk];
        found = 0u;
        for (uint at = head; at != kNoFragment;) {
            FragmentNode node = list.nodes[at];
            bool behind = last_depth < 0.0 || isBefore(list, last_depth, last, node.depth, at);
            bool fits = found < kChunk || isBefore(list, node.depth, at, depths[kChunk - 1u],
                                                   indices[kChunk - 1u]);
            if (behind && fits) {
                uint place = min(found, kChunk - 1u);
                for (; place > 0u; --place) {
                    uint before = place - 1u;
                    if (isBefore(list, depths[before], indices[before], node.depth, at)) break;
                    depths[place] = depths[before];
                    indices[place] = indices[before];
                }
                depths[place] = node.depth;
                indices[place] = at;
                found = min(found + 1u, kChunk);
            }
            at = node.next;
        }
        for (uint i = 0u; i < found; ++i) {
            FragmentNode node = list.nodes[indices[i]];
            vec2 blue_alpha = unpackHalf2x16(node.blue_alpha);
            light += revealed * blue_alpha.y * vec3(unpackHalf2x16(node.red_green), blue_alpha.x);
            revealed *= 1.0 - blue_alpha.y;
        }
        if (found > 0u) {
            last_depth = depths[found - 1u];
            last = indices[found - 1u];
        }
    }
    if (revealed >= 1.0) discard;
    color = vec4(light / (1.0 - revealed), 1.0 - revealed);
}
