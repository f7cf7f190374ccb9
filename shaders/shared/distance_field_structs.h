#ifndef HAIRBENCH_DISTANCE_FIELD_STRUCTS_H
#define HAIRBENCH_DISTANCE_FIELD_STRUCTS_H

// What the host and the shaders share about distance fields. Scalar layout; addresses are device
// addresses.

// Nodes from the root of a triangle tree to a leaf, at most.
const uint kTreeDepth = 32u;

// Grid points along each side of the blocks that they are baked in.
const uint kBakeBlock = 4u;

// Signed distances to the surface of a body at the points of a grid with cubic cells.
struct DistanceField {
    Address distances;  // float [z][y][x], m; negative inside
    vec3 origin;  // where point (0, 0, 0) is, m
    float cell;  // m
    uvec3 points;  // along each axis, at least 2
    float cells_per_metre;  // 1 / cell
};

// A node of a triangle tree; the root is node 0.
struct TreeNode {
    vec3 lower;  // of the box round all triangles below, m
    uint first;  // a leaf's first triangle; else the first of two children that lie side by side
    vec3 upper;
    uint count;  // of a leaf's triangles; 0: not a leaf
};

struct TreeTriangle {
    vec3 corners[3];  // m, counter-clockwise seen from outside
    vec3 normal;  // unit length
};

// Pseudonormals, pointing out; only their directions matter. (hair/groom/mesh/surface.h)
struct TriangleNormals {
    vec3 face;
    vec3 edges[3];  // from corner i to the next
    vec3 corners[3];
};

// What is nearest to the middle of a block of points.
struct BlockMiddle {
    float distance;  // m, signed where normals tell
    uint triangle;  // of the tree's leaves
};

// A node of a tree of triangles and their moments over 4 pi (groom::Multipole in
// hair/groom/mesh/winding_number.h); the root is node 0.
struct WindingNode {
    vec3 centre;  // m
    float reach;  // farther from there the moments are all that counts, m
    uint first;  // a leaf's first triangle; else the first of two children that lie side by side
    uint count;  // of a leaf's triangles; 0: not a leaf
    vec3 dipole;
    float quadrupole[5];
    float octupole[10];
};

struct WindingTriangle {
    vec3 corners[3];  // m, counter-clockwise seen from outside
};

// Push constants of simulation/bake_winding.comp.
struct BakeWindingPush {
    vec3 origin;  // of the grid, m
    float cell;  // m
    uvec3 points;  // along each axis
    uint first_block;
    uvec3 blocks;  // along each axis
    uint block_count;  // of this dispatch
    Address nodes;  // WindingNode
    Address triangles;  // WindingTriangle, in the order of the leaves
    Address windings;  // float [z][y][x]; written
};

// Push constants of simulation/bake_distance.comp.
struct BakeDistancePush {
    DistanceField field;  // its distances are written
    Address nodes;  // TreeNode
    Address triangles;  // TreeTriangle, in the order of the leaves
    Address normals;  // TriangleNormals, in the same order; not read where there are sides
    Address middles;  // BlockMiddle [block]
    Address sides;  // float [z][y][x]: -1 inside, 1 outside; 0: the normals tell
    uvec3 blocks;  // along each axis
    uint first_block;
    uint block_count;  // of this dispatch
    uint finds_middles;  // 1: those are written; 0: they are there, and the field is written
    float band;  // m: farther outside no distance need be exact
};

#endif
