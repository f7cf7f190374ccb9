// What a file that /strands/offset_function names sees, and what it defines:
// docs/extending.md. A unit of its own is compiled of this and that file, so this includes
// nothing.
#ifndef HAIRBENCH_EXTENSION_OFFSET_GLSL
#define HAIRBENCH_EXTENSION_OFFSET_GLSL

// A place on a drawn strand.
struct HairPlace {
    float along;  // 0 at the root, 1 at the tip
    uint strand;  // the strand's own number, a random one
};

// ---- Defined by the file ----

// How far the strand is off its smooth shape there, m: along the normal, the binormal and the
// tangent of a frame that does not turn about the strand. What is longer than the parameter `reach`
// is cut to it.
vec3 offsetHair(HairPlace place);

// ---- Defined by the program ----

// A random number in [0, 1) of the strand, for each `which` another.
float hairRandom(HairPlace place, uint which);

#endif
