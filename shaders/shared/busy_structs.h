#ifndef HAIRBENCH_BUSY_STRUCTS_H
#define HAIRBENCH_BUSY_STRUCTS_H

const uint kBusyRounds = 16;  // numbers per invocation in a step

// Push constants of busy/busy.comp.
struct BusyPush {
    Address results;  // uint: the number of steps, then one result per work group
    uint steps;
};

#endif
