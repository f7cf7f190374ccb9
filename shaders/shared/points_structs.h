#ifndef HAIRBENCH_POINTS_STRUCTS_H
#define HAIRBENCH_POINTS_STRUCTS_H

// What hair/rendering/points_pass.h and the back ends that draw its points share with shaders.

// Invocations in a workgroup, of some strands each.
const uint kPointsGroup = 32u;

// Strands of a draw of the back end `expanded`: those of them that are seen.
const uint kExpandedStrands = 128u;

// The rectangle of pixels that hair may touch, as distances from the picture's opposite sides:
// each grows with the hair, from 0 where there is none.
struct HairBounds {
    uint from_right;  // of the left edge, px
    uint from_bottom;  // of the upper edge, px
    uint right;  // px
    uint bottom;  // px
};

// Push constants of strands/points/evaluate.comp.
struct PointsPush {
    Address picture;  // PictureParameters
    Address points;  // vec4 [strand][point], root first: strands/points/points.glsl
    Address pieces;  // uint [strand]: pieces of a guide segment that are drawn; 0: none of it
    Address bounds;  // HairBounds
    uint width;  // of the rendered picture, px
    uint height;  // px
    uint strands;
    float reach;  // m, how far offsets move points
    float greatest_width;  // m, at level 0 of detail
    uint culls;  // 1: strands that the picture can't show need no points
};

// VkDrawIndexedIndirectCommand
struct IndexedCommand {
    uint indices;
    uint instances;
    uint first_index;
    uint vertex_offset;
    uint first_instance;
};

// Push constants of what draws strands from their points, and of strands/points/list.comp.
struct ExpandedPush {
    Address picture;  // PictureParameters
    Address points;  // PointsPush::points
    Address pieces;  // PointsPush::pieces
    Address seen;  // uint [draw][kExpandedStrands]: strands; 0: all of them, in their order
    Address arguments;  // IndexedCommand [draw]
    uint strands;
};

#endif
