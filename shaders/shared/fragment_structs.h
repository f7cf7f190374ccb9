#ifndef HAIRBENCH_FRAGMENT_STRUCTS_H
#define HAIRBENCH_FRAGMENT_STRUCTS_H

// Lists of a picture's transparent fragments, per rendered pixel.
struct FragmentLists {
    uint64_t heads;  // uint [pixel], index of the newest fragment
    uint64_t nodes;
    uint64_t counters;  // uint: fragments asked for; may be over the capacity
    uint capacity;  // nodes
    uint width;  // rendered pixels in a row
};

#endif
