// What a file that /shading/model names sees, and what it defines: docs/extending.md. A unit
// of its own is compiled of this and that file, so this includes nothing.
#ifndef HAIRBENCH_EXTENSION_SHADING_GLSL
#define HAIRBENCH_EXTENSION_SHADING_GLSL

// A point of a strand as a pixel sees it. Directions are unit vectors that point away from it.
struct HairPoint {
    vec3 position;  // m, world
    vec3 tangent;  // towards the tip
    vec3 normal;  // of a round strand's surface
    vec3 to_eye;
    float across;  // -1 at one edge of the strand as it is seen, 1 at the other
    float along;  // 0 at the root, 1 at the tip
    float width;  // m
    vec3 color;  // of the hair there, working colour: /shading/color, variation, texture
};

// A light as it is at a point.
struct HairLight {
    vec3 to_light;  // unit length
    vec3 color;  // working colour, with the strength and what distance takes
    float visible;  // part that shadows let through, 0 to 1
};

// Fields of the scene that bear on every model.
struct HairShading {
    float ambient;  // /shading/ambient; 0 where an environment lights the hair
    float diffuse;  // /shading/diffuse
    float specular;  // /shading/specular
    float exponent;  // /shading/exponent
};

// ---- Defined by the file ----

// The light that the point sends to the eye: a working colour.
vec3 shadeHair(HairPoint point);

// ---- Defined by the program ----

uint lightCount();
HairLight hairLight(HairPoint point, uint light);  // light < lightCount()
HairShading hairShading();
// A display colour, as scenes have them, as a working colour: linear where there is a tone map.
vec3 workingColor(vec3 display);

#endif
