// Level of detail, thesis 2.3.8.1. With growing level, there are fewer strands and drawn segments,
// and strands are wider. Everything is continuous in the level. A root triangle's level is that of
// its roots, or one that keeps an error in pixels, and applies to all segments of a strand, so
// strands never break between patches. Coarser levels keep the first strands of the list.
#ifndef HAIRBENCH_LOD_GLSL
#define HAIRBENCH_LOD_GLSL

#include "common/picture.glsl"
#include "strands/options.glsl"

struct StrandLod {
    float level;        // 0: full detail
    float density;      // strands per root triangle, >= 1; the last strand has the fraction's width
    float width_scale;  // of all strands
    uint pieces;        // drawn segments per guide segment
    uint step;          // every step-th of their ends also exists at coarser levels
    float morph;        // position of the other ends: 1 on the curve, 0 on the line between those
};

// Level 0 up to lod_near. Beyond, the level grows with the logarithm of the distance, to
// lod_maximum_level at lod_far.
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

// The place of `wanted` between two counts of pieces: 0 at the smaller, 1 at the greater. For levels
// by cluster the error, which falls with the square of the count, is linear in it.
float placeBetween(float wanted, float fewer, float more) {
    if (kLodMode != kLodCluster) return (wanted - fewer) / (more - fewer);
    precise float most = 1.0 / (fewer * fewer);
    precise float place = (most - 1.0 / (wanted * wanted)) / (most - 1.0 / (more * more));
    return place;
}

// Chooses the coarsest of the nested sets of pieces that has at least `wanted` pieces, 1 or more.
// Each set's count is that of the set before divided by its smallest factor, down to 1. Just above
// the next set's count, the ends that the next set lacks have almost reached its lines, so they are
// dropped without a jump.
void choosePieces(uint finest, float wanted, inout StrandLod lod) {
    lod.pieces = finest;
    lod.step = 1u;
    lod.morph = 1.0;
    while (lod.pieces > 1u) {
        uint factor = smallestFactor(lod.pieces);
        uint fewer = lod.pieces / factor;
        if (wanted > float(fewer)) {
            lod.step = factor;
            lod.morph = placeBetween(wanted, float(fewer), float(lod.pieces));
            return;
        }
        lod.pieces = fewer;
    }
}

float scaledCount(uint finest, float scale) { return max(float(finest) * scale, 1.0); }

void chooseStrands(uint finest, float strands, inout StrandLod lod) {
    lod.density = strands;
    lod.width_scale = float(finest) / lod.density;
}

StrandLod lodAtDistance(PictureParameters picture, float distance_to_eye) {
    StrandLod lod;
    lod.level = lodLevel(picture, distance_to_eye);
    float scale = lod.level > 0.0 ? exp2(-lod.level) : 1.0;
    float least = max(scale, picture.least_density_scale);
    chooseStrands(picture.density, scaledCount(picture.density, least), lod);
    choosePieces(picture.tessellation, scaledCount(picture.tessellation, scale), lod);
    return lod;
}

StrandLod forcedLod(PictureParameters picture) {
    StrandLod lod;
    lod.level = picture.forced_level;
    float scale = picture.forced_scale;
    chooseStrands(picture.density, scaledCount(picture.density, scale), lod);
    if (kLodMorph != 0) {
        choosePieces(picture.tessellation, scaledCount(picture.tessellation, scale), lod);
    } else {
        lod.pieces = picture.forced_tessellation;
        lod.step = 1u;
        lod.morph = 1.0;
    }
    return lod;
}

StrandLod lodOfCluster(PictureParameters picture, ClusterLevel level) {
    StrandLod lod;
    chooseStrands(picture.density, level.strands, lod);
    lod.level = log2(lod.width_scale);
    choosePieces(picture.tessellation, level.pieces, lod);
    return lod;
}

uint drawnStrands(StrandLod lod) { return uint(ceil(lod.density)); }

// The share of a strand's width that is drawn. It is 1 except for the last strand, which fades in.
float strandShare(StrandLod lod, uint strand) {
    return clamp(lod.density - float(strand), 0.0, 1.0);
}

// The position of a piece's end along the guide segment. It is exactly 0 and 1 at the segment's
// ends, which a division does not guarantee (in Vulkan it is accurate to 2.5 ULP).
float pieceEnd(StrandLod lod, uint index) {
    return index == lod.pieces ? 1.0 : float(index) / float(lod.pieces);
}

#endif
