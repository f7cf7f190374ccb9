#ifndef HAIRBENCH_FRAGMENT_STRUCTS_H
#define HAIRBENCH_FRAGMENT_STRUCTS_H

// Data for a picture's transparent fragments. PictureParameters::fragments is the address of the
// struct that the picture's transparency mode needs.

// Purpose of the random numbers that choose the samples of alpha_to_coverage.
const uint kSamplesPurpose = 0x53414d50u;
// The index that ends a list of fragments.
const uint kNoFragment = 0xffffffffu;

// Data for weighted_blended: a sphere that strands cannot leave, before the head's motion.
struct BlendRange {
    vec3 centre;  // m
    float radius;  // m
};

// Data for fragment_list: a linked list of fragments for each rendered pixel.
struct FragmentLists {
    Address heads;  // uint [pixel], index of the newest fragment or kNoFragment
    Address nodes;  // FragmentNode
    Address counters;  // uint: number of requested fragments; may exceed the capacity
    uint capacity;  // nodes
    uint width;  // rendered pixels in a row
    uint height;  // rendered pixels in a column
};

struct FragmentNode {
    uint red_green;  // half floats of the colour, low half first
    uint blue_alpha;
    float depth;  // common/depth.glsl
    uint next;
};

// Push constants of composite/*.
struct CompositePush {
    Address fragments;
    uint sample_index;  // the sample of a multisampled target that is blended
};

#endif
