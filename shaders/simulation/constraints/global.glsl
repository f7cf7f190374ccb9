#ifndef HAIRBENCH_CONSTRAINT_GLOBAL_GLSL
#define HAIRBENCH_CONSTRAINT_GLOBAL_GLSL

// Pull toward the rest position, thesis eq. 10.
vec3 pullToRest(vec3 position, vec3 rest, float stiffness) {
    return position + stiffness * (rest - position);
}

#endif
