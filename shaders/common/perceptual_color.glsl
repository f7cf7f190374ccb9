// Oklab: Ottosson 2020, A perceptual color space for image processing. Equal steps look equal.
#ifndef HAIRBENCH_PERCEPTUAL_COLOR_GLSL
#define HAIRBENCH_PERCEPTUAL_COLOR_GLSL

// Returns linear RGB with sRGB's primaries, clipped to [0, 1]. lightness: 0 to 1; hue: radians,
// where 0.5 is red and 4.5 blue.
vec3 perceptualColor(float lightness, float chroma, float hue) {
    float a = chroma * cos(hue);
    float b = chroma * sin(hue);
    vec3 roots = lightness + vec3(0.3963377774 * a + 0.2158037573 * b,
                                  -0.1055613458 * a - 0.0638541728 * b,
                                  -0.0894841775 * a - 1.2914855480 * b);
    vec3 cones = roots * roots * roots;
    vec3 rgb = vec3(dot(cones, vec3(4.0767416621, -3.3077115913, 0.2309699292)),
                    dot(cones, vec3(-1.2684380046, 2.6097574011, -0.3413193965)),
                    dot(cones, vec3(-0.0041960863, -0.7034186147, 1.7076147010)));
    return clamp(rgb, 0.0, 1.0);
}

#endif
