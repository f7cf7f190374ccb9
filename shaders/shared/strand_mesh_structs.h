#ifndef HAIRBENCH_STRAND_MESH_STRUCTS_H
#define HAIRBENCH_STRAND_MESH_STRUCTS_H

// What hair/rendering/mesh_backend.h shares with the shaders of the back end `mesh`.

// Vertices and triangles that a mesh workgroup may make: what every device has. A point of a strand
// is two vertices, a piece two triangles.
const uint kMeshVertices = 256u;

// Push constants of all stages.
struct StrandMeshPush {
    Address picture;  // PictureParameters
    uint blocks;  // of all strands
    float reach;  // m, how far offsets move points
    float greatest_width;  // m, at level 0 of detail
};

#endif
