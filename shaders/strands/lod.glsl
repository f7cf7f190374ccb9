// Level of detail, thesis 2.3.8.1: strands and drawn segments become fewer and strands wider, all
// of it continuous in the level. A root triangle's level is that of its roots, the same for all
// segments of a strand: strands never break between patches, and lower levels keep the first
// strands of the list.
#ifndef HAIRBENCH_LOD_GLSL
#define HAIRBENCH_LOD_GLSL

#include "common/picture.glsl"
#include "strands/options.glsl"

struct StrandLod {
    float level;        // 0: full detail
    float density;      // strands per root triangle, >= 1; the last has the fraction's width
    float width_scale;  // of all of them
    uint pieces;        // drawn segments per guide segment
    uint step;          // every step-th of their ends is one at coarser levels too
    float morph;        // where the other ends are: 1 on the curve, 0 on the line between those
};

// Level 0 up to lod_near, then growing with the logarithm of the distance to lod_maximum_level at
// lod_far.
float lodLevel(PictureParameters picture, float distance_to_eye) {
    float octaves = log2(distance_to_eye / picture.lod_near);
    float fraction = octaves / log2(picture.lod_far / picture.lod_near);
    return picture.lod_maximum_level * clamp(fraction, 0.0, 1.0);
}

uint smallestFactor(uint number) {
    for (uint factor = 2u; factor * factor <= number; ++factor)
        if (number % factor == 0u) return factor;
    return number;
}

// The coarsest of the nested sets of pieces that has at least finest * scale: each has as many
// times fewer than the one before as that number's smallest factor, down to 1. Just above the next set's number
// the ends that it lacks have all but reached its lines: they are dropped without a jump.
void choosePieces(uint finest, float scale, inout StrandLod lod) {
    float wanted = max(float(finest) * scale, 1.0);
    lod.pieces = finest;
    lod.step = 1u;
    lod.morph = 1.0;
    while (lod.pieces > 1u) {
        uint factor = smallestFactor(lod.pieces);
        uint fewer = lod.pieces / factor;
        if (wanted > float(fewer)) {
            lod.step = factor;
            lod.morph = (wanted - float(fewer)) / float(lod.pieces - fewer);
            return;
        }
        lod.pieces = fewer;
    }
}

void chooseStrands(uint finest, float scale, inout StrandLod lod) {
    lod.density = max(float(finest) * scale, 1.0);
    lod.width_scale = float(finest) / lod.density;
}

StrandLod lodAtDistance(PictureParameters picture, float distance_to_eye) {
    StrandLod lod;
    lod.level = lodLevel(picture, distance_to_eye);
    float scale = lod.level > 0.0 ? exp2(-lod.level) : 1.0;
    chooseStrands(picture.density, max(scale, picture.least_density_scale), lod);
    choosePieces(picture.tessellation, scale, lod);
    return lod;
}

StrandLod forcedLod(PictureParameters picture) {
    StrandLod lod;
    lod.level = picture.forced_level;
    chooseStrands(picture.density, picture.forced_scale, lod);
    if (kLodMorph != 0) {
        choosePieces(picture.tessellation, picture.forced_scale, lod);
    } else {
        lod.pieces = picture.forced_tessellation;
        lod.step = 1u;
        lod.morph = 1.0;
    }
    return lod;
}

uint drawnStrands(StrandLod lod) { return uint(ceil(lod.density)); }

// The part of a strand's width that it is drawn with: 1, but for the last strand, which fades in.
float strandShare(StrandLod lod, uint strand) {
    return clamp(lod.density - float(strand), 0.0, 1.0);
}

// Where an end of a piece lies along the guide segment: 0 and 1 themselves at its ends, which a
// division is not sure to give (Vulkan: to 2.5 roundings).
float pieceEnd(StrandLod lod, uint index) {
    return index == lod.pieces ? 1.0 : float(index) / float(lod.pieces);
}

#endif
