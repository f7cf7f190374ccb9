#ifndef HAIRBENCH_STRAND_MESH_STRUCTS_H
#define HAIRBENCH_STRAND_MESH_STRUCTS_H

// Data that hair/rendering/mesh_backend.h shares with the shaders of the back end `mesh`.

// Most vertices and triangles of a mesh work group; every device supports it. A point of a strand
// is two vertices, a piece two triangles.
const uint kMeshVertices = 256u;

// Push constants of all stages.
struct StrandMeshPush {
    Address picture;  // PictureParameters
    uint blocks;  // of all strands
    float reach;  // m: how far offsets move points at most
    float greatest_width;  // m, at level 0 of detail
};

#endif
