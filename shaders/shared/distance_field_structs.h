#ifndef HAIRBENCH_DISTANCE_FIELD_STRUCTS_H
#define HAIRBENCH_DISTANCE_FIELD_STRUCTS_H

// Data about distance fields that the host and the shaders share. Scalar layout; addresses are
// device addresses.

// Maximum number of nodes from the root of a triangle tree to a leaf.
const uint kBvhDepth = 32u;

// Grid points along each side of a block for baking.
const uint kBakeBlock = 4u;

// Signed distances to the surface of a body at the points of a grid with cubic cells.
struct DistanceField {
    Address distances;  // float [z][y][x], m; negative inside
    vec3 origin;  // position of grid point (0, 0, 0), m
    float cell;  // m
    uvec3 points;  // along each axis, at least 2
    float cells_per_metre;  // 1 / cell
};

// A node of a triangle tree; the root is node 0.
struct BvhNode {
    vec3 lower;  // of the bounding box of all triangles below, m
    uint first;  // first triangle of a leaf, or the first of two adjacent children
    vec3 upper;
    uint count;  // number of a leaf's triangles; 0: not a leaf
};

struct BvhTriangle {
    vec3 corners[3];  // m, counter-clockwise seen from outside
    vec3 normal;  // unit length
};

// Outward pseudonormals (hair/groom/mesh/surface.h). Only their directions matter.
struct TriangleNormals {
    vec3 face;
    vec3 edges[3];  // from corner i to the next
    vec3 corners[3];
};

// The nearest triangle to the middle of a block of points.
struct BlockMiddle {
    float distance;  // m, signed if normals give the sign
    uint triangle;  // index in leaf order
};

// A node of a triangle tree, with the moments of its triangles over 4 pi (groom::Multipole in
// hair/groom/mesh/winding_number.h). The root is node 0.
struct WindingNode {
    vec3 centre;  // m
    float reach;  // beyond this distance from the centre only the moments are used, m
    uint first;  // first triangle of a leaf, or the first of two adjacent children
    uint count;  // number of a leaf's triangles; 0: not a leaf
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
    Address nodes;  // BvhNode
    Address triangles;  // BvhTriangle, in the order of the leaves
    Address normals;  // TriangleNormals, in the same order; not read if there are sides
    Address middles;  // BlockMiddle [block]
    Address sides;  // float [z][y][x]: -1 inside, 1 outside; 0: the normals give the sign
    uvec3 blocks;  // along each axis
    uint first_block;
    uint block_count;  // of this dispatch
    uint finds_middles;  // 1: writes the middles; 0: reads the middles and writes the field
    float band;  // m: farther outside, distances need not be exact
};

#endif
