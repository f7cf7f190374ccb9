// The interface for a file that /shading/model names: docs/extending.md. This header and
// that file are compiled as one unit, so this header includes nothing.
#ifndef HAIRBENCH_EXTENSION_SHADING_GLSL
#define HAIRBENCH_EXTENSION_SHADING_GLSL

// A point of a strand as a pixel sees it. Directions are unit vectors that point away from the
// point.
struct HairPoint {
    vec3 position;  // m, world
    vec3 tangent;  // towards the tip
    vec3 normal;  // of a round strand's surface
    vec3 to_eye;
    float across;  // -1 at one edge of the strand as it is seen, 1 at the other
    float along;  // 0 at the root, 1 at the tip
    float width;  // m
    vec3 color;  // of the hair here, working colour, from /shading/color, variation and texture
};

// A light as it reaches a point.
struct HairLight {
    vec3 to_light;  // unit length
    vec3 color;  // working colour, including the strength and the fall-off with distance
    float visible;  // the part that shadows let through, 0 to 1
};

// Scene fields that apply to every model.
struct HairShading {
    float ambient;  // /shading/ambient; 0 if an environment lights the hair
    float diffuse;  // /shading/diffuse
    float specular;  // /shading/specular
    float exponent;  // /shading/exponent
};

// ---- Defined by the file ----

// Returns the light that the point sends to the eye, as a working colour.
vec3 shadeHair(HairPoint point);

// ---- Defined by the program ----

uint lightCount();
HairLight hairLight(HairPoint point, uint light);  // light < lightCount()
HairShading hairShading();
// Converts a display colour, as scenes have them, to a working colour, which is linear if there is
// a tone map.
vec3 workingColor(vec3 display);

#endif
