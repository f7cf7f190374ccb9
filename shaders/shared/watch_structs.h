#ifndef HAIRBENCH_WATCH_STRUCTS_H
#define HAIRBENCH_WATCH_STRUCTS_H

// Parameters and results of a watched stage: strands/watch.glsl.
struct StageWatch {
    uint mask;  // an invocation counts as seen if (its result & mask) == wanted
    uint wanted;
    uint sum;  // of the seen invocations' results, modulo 2^32
    uint count;  // of seen invocations
};

// Push constants of strands with watched stages; begins like StrandPush.
struct WatchedPush {
    Address picture;  // PictureParameters
    Address watch;  // StageWatch
};

#endif
