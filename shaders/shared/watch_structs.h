#ifndef HAIRBENCH_WATCH_STRUCTS_H
#define HAIRBENCH_WATCH_STRUCTS_H

// What a watched stage does: strands/watch.glsl.
struct StageWatch {
    uint mask;  // an invocation is seen where (what it made & mask) == wanted
    uint wanted;
    uint sum;  // of what seen invocations made, modulo 2^32
    uint count;  // of seen invocations
};

// Push constants of strands whose stages are watched; begins as StrandPush.
struct WatchedPush {
    Address picture;  // PictureParameters
    Address watch;  // StageWatch
};

#endif
