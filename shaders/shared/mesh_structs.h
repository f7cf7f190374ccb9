#ifndef HAIRBENCH_MESH_STRUCTS_H
#define HAIRBENCH_MESH_STRUCTS_H

// Push constants of scene/mesh*.
struct MeshPush {
    Address picture;  // PictureParameters
    Address positions;  // vec3, m
    Address normals;  // vec3, unit length
    Address texture_coordinates;  // vec2, v down; read if there are textures
    Address indirect;  // vec3 [vertex], as IndirectPush has it; read if there is indirect light
    vec3 base_color;  // in working colours
    float opacity;
    float metallic;
    float roughness;
    float normal_scale;
    float cutoff;  // of opacity; read if the material is a mask
    uint is_moving;  // 1: moves with the head
    // Read if light scatters in skin:
    float scattering;  // factor of the profile's lengths
    Address curvatures;  // float [vertex], 1/m; 0: the mesh scatters no light
    Address responses;  // vec3 [curvature][cosine], as scatteringResponses() has it
};

// The table of responses of spheres that scatter light: cosines of the light go from -1 to 1, and
// curvatures from 0 on, as multiples of kScatteringStep over the factor of the profile's lengths.
const uint kScatteringCosines = 129u;
const uint kScatteringCurvatures = 32u;
const float kScatteringStep = 8.0;  // 1/m

// A part of a lit surface that lights other surfaces.
struct IndirectSource {
    vec3 position;  // m
    float area;  // m^2; 0: lights nothing
    vec3 normal;  // unit length, to the lit side; 0: it shines evenly to all sides
    vec3 color;  // radiance, as working colour
};

// Indirect light on meshes is gathered from this many sources at most, of all lights together.
const uint kMostIndirectSources = 8192u;
const uint kIndirectGroupSize = 64u;

// Push constants of shading/indirect.comp.
struct IndirectPush {
    Address picture;  // PictureParameters
    Address sources;  // IndirectSource
    Address positions;  // vec3 [vertex], m
    Address normals;  // vec3 [vertex], unit length
    Address light;  // vec3 [vertex]: irradiance / pi, as working colour
    uint side;  // each light has side^2 sources of hair, and as many of meshes
    uint sources_count;
    uint vertices;
    uint is_moving;  // 1: the mesh moves with the head
};

#endif
