#ifndef HAIRBENCH_MESH_STRUCTS_H
#define HAIRBENCH_MESH_STRUCTS_H

// Push constants of scene/mesh*.
struct MeshPush {
    Address picture;  // PictureParameters
    Address positions;  // vec3, m
    Address normals;  // vec3, unit length
    Address texture_coordinates;  // vec2, v down; read if there are textures
    vec3 base_color;  // in working colours
    float opacity;
    float metallic;
    float roughness;
    float normal_scale;
    float cutoff;  // of opacity; read if the material is a mask
    uint is_moving;  // 1: moves with the head
};

#endif
