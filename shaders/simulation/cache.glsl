// Places of guides in a cache of their motion.
#ifndef HAIRBENCH_SIMULATION_CACHE_GLSL
#define HAIRBENCH_SIMULATION_CACHE_GLSL

#extension GL_GOOGLE_include_directive : require

#include "simulation/guides.glsl"

// At a sample, its position is returned to the last bit.
vec3 cachedAt(CachePlace place, uint vertex) {
    vec3 before = Vectors(place.before).at[vertex].xyz;
    return before + place.fraction * (Vectors(place.after).at[vertex].xyz - before);
}

#endif
