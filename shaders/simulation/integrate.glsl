#ifndef HAIRBENCH_SIMULATION_INTEGRATE_GLSL
#define HAIRBENCH_SIMULATION_INTEGRATE_GLSL

// Verlet integration without velocities, thesis eq. 9, with damping.
vec3 integrate(
    vec3 position, vec3 previous, vec3 acceleration, float velocity_kept, float substep_squared) {
    return position + velocity_kept * (position - previous) + acceleration * substep_squared;
}

#endif
