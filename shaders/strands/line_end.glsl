// An end of a line of a strand; quads are made from two ends.
#ifndef HAIRBENCH_LINE_END_GLSL
#define HAIRBENCH_LINE_END_GLSL

struct LineEnd {
    vec3 position;  // m
    vec3 tangent;  // of any length
    float width;  // m
    float along;
    uint merged;  // strands/merged_word.glsl; set if kTellsHairs
};

#endif
