#ifndef HAIRBENCH_COMMON_RANDOM_GLSL
#define HAIRBENCH_COMMON_RANDOM_GLSL

// Random numbers without state: a hash of (seed, index, purpose). hair/random.h has the same
// functions.

// PCG hash: Jarzynski and Olano 2020, Hash Functions for GPU Rendering.
uint pcg(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// `index` counts the objects of one kind; `purpose` distinguishes the numbers that one object
// needs.
uint hash(uint seed, uint index, uint purpose) {
    return pcg(purpose + pcg(index + pcg(seed)));
}

// Returns a number in [0, 1) from the top 24 bits, which a float holds exactly.
float unitFloat(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }

float random01(uint seed, uint index, uint purpose) {
    return unitFloat(hash(seed, index, purpose));
}

#endif
