#ifndef HAIRBENCH_SOFTWARE_STRUCTS_H
#define HAIRBENCH_SOFTWARE_STRUCTS_H

// Data that the strand back end `software` shares with its shaders, strands/software.

// Invocations in a work group of passes with one strand, or a few pieces, per invocation.
const uint kSoftwareStrandGroup = 32u;

// Pieces with more estimated samples than kManySamples are covered by whole work groups.
// kMostLargePieces is the capacity for them. Mesa's lavapipe silently ends an invocation's loops
// after 65,535 iterations in total, so no single invocation may cover a large piece.
const uint kManySamples = 128u;
const uint kMostLargePieces = 65536u;
const uint kLargeGroups = 256u;

// One strand, or block of strands, in every kFirstStrands is covered first. Pieces of the others
// are culled if they are behind everything that a window of the picture around them shows by then.
// A window is a square of kSmallWindow or kLargeWindow tiles along each side; a tile is a square of
// kTile pixels along each side. Pieces larger than a large window are not culled.
const uint kFirstStrands = 16u;
const uint kTile = 4u;
const uint kSmallWindow = 2u;
const uint kLargeWindow = 4u;

const uint kCoverFirst = 0u;
const uint kCoverOthers = 1u;

// Pieces are numbered by their first point. This number marks a sample that shows no piece.
const uint kNoPiece = 0xffffffffu;

// Numbers of listed pieces.
struct PieceCounts {
    uint seen[2];  // potentially visible pieces of each part of the strands
    uint large;  // may exceed kMostLargePieces
};

// Push constants of all shaders in strands/software.
struct SoftwarePush {
    Address picture;  // PictureParameters
    Address points;  // PointsPush::points
    Address pieces;  // PointsPush::pieces
    // uvec2 [pixel][sample]. x: the visible piece, or kNoPiece; after shading, its colour. y: its
    // nearness, or that of the scene.
    Address samples;
    Address colors;  // uvec2 [pixel][sample], half floats; used if light is linear
    Address bounds;  // HairBounds
    Address counts;  // PieceCounts
    Address list;  // uint: potentially visible pieces
    Address large;  // uint: large pieces
    Address tiles;  // uint [row][column]: nearness of the farthest sample within the bounds
    Address windows;  // uvec2 [row][column]: the same for the small and the large window that begin
                      // at a tile
    uint width;  // of the rendered picture, px
    uint height;  // px
    uint strands;
    uint choice;  // cover.comp: 0: finds the nearness, 1: finds the piece; show.frag: the sample
    uint part;  // find.comp, cover.comp: part of the strands
    uint list_begin;  // first of the part's pieces in the list
};

#endif
