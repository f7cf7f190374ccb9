#ifndef HAIRBENCH_MESH_STRUCTS_H
#define HAIRBENCH_MESH_STRUCTS_H

// Push constants of scene/mesh*.
struct MeshPush {
    uint64_t picture;  // PictureParameters
    uint64_t positions;  // vec3, m
    uint64_t normals;  // vec3, unit length
    uint64_t texture_coordinates;  // vec2, v down; read where there are textures
    vec3 base_color;  // in working colours
    float opacity;
    float metallic;
    float roughness;
    float normal_scale;
    float cutoff;  // of opacity; read where the material is a mask
    uint is_moving;  // 1: with the head
};

// What shading/probe_surface.comp is asked and what it answers.
struct SurfaceProbe {
    vec3 base_color;
    float metallic;
    float roughness;
    vec3 normal;
    vec3 to_eye;
    vec3 to_light;
    vec3 f;  // 1/sr, written
};

struct SurfaceProbePush {
    uint64_t probes;  // SurfaceProbe [probe]
    uint count;
};

#endif
