#ifndef HAIRBENCH_DIFFERENCE_STRUCTS_H
#define HAIRBENCH_DIFFERENCE_STRUCTS_H

// Invocations along each side of a workgroup of post/difference.comp.
const uint kDifferenceGroupSide = 8u;

// The differences of two pictures; initially 0.
struct DifferenceCounts {
    uint pixels;  // pixels that differ
    uint most;  // largest difference of a channel, in steps of 1/255
    uint sum;  // low 32 bits of the sum over all channels of all pixels, in steps of 1/255
    uint carry;  // high 32 bits of the same sum
};

// Push constants of post/difference.comp.
struct DifferencePush {
    Address counts;  // DifferenceCounts
    uint gain;  // factor on the difference in the picture
};

#endif
