#ifndef HAIRBENCH_LIMIT_STRUCTS_H
#define HAIRBENCH_LIMIT_STRUCTS_H

const uint kLimitGroup = 64u;  // invocations of a work group of limits/arithmetic.comp
// Floating-point operations of a round of limits/arithmetic.glsl: 4 times 8 products and sums.
const uint kRoundOperations = 64u;

// Push constants of limits/.
struct LimitPush {
    Address results;  // float; written if a result equals `never`
    uint rounds;
    float factor;  // below 1, so that no chain grows
    float addend;
    float never;  // NaN, which equals nothing
};

#endif
