#ifndef HAIRBENCH_DIFFERENCE_STRUCTS_H
#define HAIRBENCH_DIFFERENCE_STRUCTS_H

// Invocations along each side of a workgroup of post/difference.comp.
const uint kDifferenceGroupSide = 8u;

// How much two pictures differ; 0 at first.
struct DifferenceCounts {
    uint pixels;  // pixels that differ
    uint most;  // largest difference of a channel, in steps of 1/255
    uint sum;  // low 32 bits of the sum over all channels of all pixels, in steps of 1/255
    uint carry;  // high 32 bits of the same sum
};

// Push constants of post/difference.comp.
struct DifferencePush {
    Address counts;  // DifferenceCounts
    uint gain;  // of the picture of the difference
};

#endif
