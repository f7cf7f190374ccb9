#ifndef HAIRBENCH_CONSTRAINT_GLOBAL_GLSL
#define HAIRBENCH_CONSTRAINT_GLOBAL_GLSL

// Pull toward the rest position, thesis eq. 10.
vec3 pullToRest(vec3 position, vec3 rest, float stiffness) {
    return position + stiffness * (rest - position);
}

// The stiffness of the equivalent implicit spring, as acceleration times substep^2 per distance.
float pullPerMass(float stiffness) { return stiffness / max(1.0 - stiffness, 1.0e-6); }

#endif
