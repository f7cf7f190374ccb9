// The interface for a file that /strands/offset_function names: docs/extending.md. This
// header and that file are compiled as one unit, so this header includes nothing.
#ifndef HAIRBENCH_EXTENSION_OFFSET_GLSL
#define HAIRBENCH_EXTENSION_OFFSET_GLSL

// A place on a drawn strand.
struct HairPlace {
    float along;  // 0 at the root, 1 at the tip
    uint strand;  // a random number of the strand's own
};

// ---- Defined by the file ----

// The strand's offset from its smooth shape there, m: along the normal, the binormal and the
// tangent of a frame that does not twist about the strand. Longer offsets are cut to the parameter
// `reach`.
vec3 offsetHair(HairPlace place);

// ---- Defined by the program ----

// A random number in [0, 1) for the strand; every `which` gives a different one.
float hairRandom(HairPlace place, uint which);

#endif
