#ifndef HAIRBENCH_SOFTWARE_STRUCTS_H
#define HAIRBENCH_SOFTWARE_STRUCTS_H

// Data that the strand back ends `software` and `rays` share with their shaders, strands/software
// and strands/rays.

// Pieces with more estimated samples than kLargePieceSamples are rasterised by whole work groups.
// kMostLargePieces is the capacity of their list. Mesa's lavapipe silently ends an invocation's
// loops after 65,535 iterations in total, so no single invocation may rasterise a large piece, and
// a picture of more than kLargeGroupSamples samples has as many times kLargeGroups groups.
const uint kLargePieceSamples = 128u;
const uint kMostLargePieces = 65536u;
const uint kLargeGroups = 256u;
const uint kLargeGroupSamples = 1u << 22;

// One strand, or block of strands, in every kFirstStrands is rasterised first. Pieces of the
// others are culled by a depth pyramid of these: if they are farther than everything in a square of
// kFineLevel or kCoarseLevel tiles along each side around them. A tile is a square of kTile pixels
// along each side. Pieces larger than the coarse level's squares are not culled.
const uint kFirstStrands = 16u;
const uint kTile = 4u;
const uint kFineLevel = 2u;
const uint kCoarseLevel = 4u;

const uint kFirstPart = 0u;
const uint kOtherPart = 1u;

// Pieces are numbered by their first point. This number marks a sample that shows no piece.
const uint kNoPiece = 0xffffffffu;

// Numbers of listed pieces.
struct PieceCounts {
    uint visible[2];  // potentially visible pieces of each part of the strands
    uint large;  // may exceed kMostLargePieces
};

// Push constants of all shaders in strands/software, and of strands/rays/trace.comp.
struct SoftwarePush {
    Address picture;  // PictureParameters
    Address points;  // PointsPush::points
    Address pieces;  // PointsPush::pieces
    // uvec2 [pixel][sample]. x: the visible piece, or kNoPiece; after shading, its colour. y: its
    // nearness, or that of the scene.
    Address visibility;
    Address colors;  // uvec2 [pixel][sample], half floats; used if light is linear
    Address bounds;  // HairBounds
    Address counts;  // PieceCounts
    Address list;  // uint: potentially visible pieces
    Address large;  // uint: large pieces
    Address tile_depths;  // uint [row][column]: nearness of the farthest sample within the bounds
    Address pyramid;  // uvec2 [row][column]: the same for the squares of kFineLevel and of
                      // kCoarseLevel tiles that begin at a tile
    uint width;  // of the rendered picture, px
    uint height;  // px
    uint strands;
    uint choice;  // raster.comp: 0: finds the nearness, 1: finds the piece; blit.frag: the sample
    uint part;  // cull.comp, raster.comp: part of the strands
    uint list_begin;  // first of the part's pieces in the list
    Address structure;  // trace.comp: the acceleration structure of the strands
    Address boxes;  // trace.comp: StrandBox, if the structure has boxes
};

// A box round a piece of a strand, as StrandStructure has them with /strands/rays/geometry `boxes`.
struct StrandBox {
    vec3 low;  // m: VkAabbPositionsKHR
    vec3 high;
    uint piece;  // number of the piece; kNoPiece if it is not drawn
    float covered;  // part of the width that is not gaps between merged hairs
};

// Push constants of strands/rays/corners.comp and strands/rays/boxes.comp.
struct PrimitivesPush {
    Address picture;  // PictureParameters
    Address points;  // PointsPush::points
    Address pieces;  // PointsPush::pieces
    // corners.comp: vec3 [strand][point][2], m: the corners of its quads beside a point. Points are
    // numbered for the finest level of detail; those past the last drawn one of a segment lie on
    // it. boxes.comp: StrandBox [strand][segment][piece], numbered for the finest level of detail.
    Address primitives;
    uint invocations;  // points, or boxes, of all strands
    uint strands;  // SoftwarePush::strands; those after them are not drawn
    // 1: corners and boxes of strands that are not drawn are NaN, so that the building of an
    // acceleration structure leaves them out. 0: they are at the origin, where triangles are not
    // hit because they have no area. A structure that is fitted to moved strands must always have
    // the same ones.
    uint leaves_out;
};

#endif
