// Light that comes from a direction. The picture's columns go round +y. The middle column is +z, a
// quarter +x, three quarters -x, and both ends -z. The top row is +y. Mitsuba's `envmap` has the
// same layout. A viewer inside sees the left half of the picture to the left of +z.
#ifndef HAIRBENCH_ENVIRONMENT_RADIANCE_GLSL
#define HAIRBENCH_ENVIRONMENT_RADIANCE_GLSL

#include "environment/parameters.glsl"

layout(buffer_reference, scalar) readonly buffer EnvironmentTexels { vec3 texels[]; };

const float kTurn = 6.28318531;  // rad

// `direction` has unit length. The lookup is bilinear between texel centres; it wraps round the
// horizon and clamps at the poles.
vec3 environmentRadiance(Address environment, vec3 direction) {
    EnvironmentParameters map = EnvironmentReference(environment).parameters;
    EnvironmentTexels data = EnvironmentTexels(map.texels);
    float azimuth = atan(direction.x, direction.z) - map.turn;  // from +z towards +x
    float polar = acos(clamp(direction.y, -1.0, 1.0));
    vec2 place = vec2(fract(0.5 - azimuth / kTurn), 2.0 * polar / kTurn) *
                     vec2(map.width, map.height) - 0.5;
    vec2 weight = fract(place);
    ivec2 low = ivec2(floor(place));
    int width = int(map.width);
    int left = (low.x + width) % width;
    int right = (low.x + 1) % width;
    int top = clamp(low.y, 0, int(map.height) - 1) * width;
    int bottom = clamp(low.y + 1, 0, int(map.height) - 1) * width;
    return mix(
        mix(data.texels[top + left], data.texels[top + right], weight.x),
        mix(data.texels[bottom + left], data.texels[bottom + right], weight.x), weight.y);
}

#endif
