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

#endif
