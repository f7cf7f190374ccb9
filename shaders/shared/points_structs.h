#ifndef HAIRBENCH_POINTS_STRUCTS_H
#define HAIRBENCH_POINTS_STRUCTS_H

// Data that hair/rendering/points_pass.h and the back ends that draw its points share with shaders.

// Maximum number of visible strands in a draw of the back end `expanded`.
const uint kExpandedStrands = 128u;

// The rectangle of pixels that hair may touch. Each edge is its distance from the opposite side of
// the picture, so it grows with the hair from 0.
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
    Address pieces;  // uint [strand]: drawn pieces of a guide segment; 0: the strand is not drawn
    Address bounds;  // HairBounds
    uint width;  // of the rendered picture, px
    uint height;  // px
    uint strands;
    float reach;  // m: how far offsets move points at most
    float greatest_width;  // m, at level 0 of detail
    uint culls;  // 1: strands outside the picture get no points
};

// VkDrawIndexedIndirectCommand
struct IndexedCommand {
    uint indices;
    uint instances;
    uint first_index;
    uint vertex_offset;
    uint first_instance;
};

// Push constants of draws of strands from their points, and of strands/points/list.comp.
struct ExpandedPush {
    Address picture;  // PictureParameters
    Address points;  // PointsPush::points
    Address pieces;  // PointsPush::pieces
    Address
        visible;  // uint [draw][kExpandedStrands]: strands; address 0: all strands in their order
    Address arguments;  // IndexedCommand [draw]
    uint strands;
};

#endif
