// The sRGB transfer function, IEC 61966-2-1:1999.
#ifndef HAIRBENCH_DISPLAY_COLOR_GLSL
#define HAIRBENCH_DISPLAY_COLOR_GLSL

// Linear RGB in [0, 1] -> display RGB.
vec3 toDisplay(vec3 linear) {
    vec3 curved = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(curved, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

#endif
