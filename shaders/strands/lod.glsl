// Level of detail, thesis 2.3.8.1: both tessellation levels fall and the width rises, so that the
// covered area is kept. A triangle's level is that of its roots, the same for all segments of a
// strand: strands never break between patches, and lower levels keep the first strands of the list.
#ifndef HAIRBENCH_LOD_GLSL
#define HAIRBENCH_LOD_GLSL

#include "common/picture.glsl"

struct StrandLod {
    uint density;       // strands drawn per root triangle, >= 1
    uint tessellation;  // drawn segments per guide segment, >= 1
    float width_scale;
};

// Level 0 up to lod_near, then growing with the logarithm of the distance to lod_maximum_level at
// lod_far.
float lodLevel(PictureParameters picture, float distance_to_eye) {
    float octaves = log2(distance_to_eye / picture.lod_near);
    float fraction = octaves / log2(picture.lod_far / picture.lod_near);
    return picture.lod_maximum_level * clamp(fraction, 0.0, 1.0);
}

uint scaledCount(uint count, float scale) { return max(1u, uint(float(count) * scale + 0.5)); }

StrandLod lodAtDistance(PictureParameters picture, float distance_to_eye) {
    float scale = exp2(-lodLevel(picture, distance_to_eye));
    StrandLod lod;
    lod.density = scaledCount(picture.density, scale);
    lod.tessellation = scaledCount(picture.tessellation, scale);
    lod.width_scale = float(picture.density) / float(lod.density);
    return lod;
}

StrandLod forcedLod(PictureParameters picture) {
    StrandLod lod;
    lod.density = picture.forced_density;
    lod.tessellation = picture.forced_tessellation;
    lod.width_scale = float(picture.density) / float(lod.density);
    return lod;
}

#endif
