#ifndef HAIRBENCH_DIFFERENCE_STRUCTS_H
#define HAIRBENCH_DIFFERENCE_STRUCTS_H

// How much two pictures differ; 0 at first.
struct DifferenceCounts {
    uint pixels;  // that differ
    uint most;  // of one channel, in steps of 1/255
    uint sum;  // of all channels of all pixels, in steps: the low 32 bits
    uint carry;  // and the high ones
};

// Push constants of post/difference.comp.
struct DifferencePush {
    uint64_t counts;  // DifferenceCounts
    uint gain;  // of the picture of the difference
};

#endif
