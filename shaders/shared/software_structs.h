#ifndef HAIRBENCH_SOFTWARE_STRUCTS_H
#define HAIRBENCH_SOFTWARE_STRUCTS_H

// What the strand back end `software` shares with its shaders, strands/software.

// Invocations in a workgroup of one a strand, or a few pieces.
const uint kSoftwareStrandGroup = 32u;

// Pieces that are estimated to cover more samples than this are covered by whole workgroups; those
// have places for so many. Mesa's lavapipe ends an invocation's loops after 65,535 turns in all, in
// silence: no invocation may have a large piece for itself.
const uint kManySamples = 128u;
const uint kMostLargePieces = 65536u;
const uint kLargeGroups = 256u;

// One strand, or block of strands, of so many is covered first. Of others the pieces are left out
// that are behind all that a window of the picture around them shows by then: a square of so many
// tiles, which are squares of so many pixels. Those larger than a large window aren't left out.
const uint kFirstStrands = 16u;
const uint kTile = 4u;
const uint kSmallWindow = 2u;
const uint kLargeWindow = 4u;

const uint kCoverFirst = 0u;
const uint kCoverOthers = 1u;

// Pieces are numbered by their first point. What a sample shows that shows none.
const uint kNoPiece = 0xffffffffu;

// How many pieces are listed.
struct PieceCounts {
    uint seen[2];  // of a part of the strands, that may be seen
    uint large;  // may be over kMostLargePieces
};

// Push constants of everything in strands/software.
struct SoftwarePush {
    Address picture;  // PictureParameters
    Address points;  // PointsPush::points
    Address pieces;  // PointsPush::pieces
    // uvec2 [pixel][sample]. x: the piece that is seen, or kNoPiece; shaded: its color. y: how near
    // it is, or what the scene has there.
    Address samples;
    Address colors;  // uvec2 [pixel][sample], half floats; where light is linear
    Address bounds;  // HairBounds
    Address counts;  // PieceCounts
    Address list;  // uint: pieces that may be seen
    Address large;  // uint: large pieces
    Address tiles;  // uint [row][column]: how near the farthest sample within the bounds is
    Address windows;  // uvec2 [row][column]: the same of a small and a large window from a tile on
    uint width;  // of the rendered picture, px
    uint height;  // px
    uint strands;
    uint choice;  // cover.comp: 0 how near, 1 which; show.frag: the sample
    uint part;  // find.comp, cover.comp: of the strands
    uint list_begin;  // of the part's pieces in the list
};

#endif
