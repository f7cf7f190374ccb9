// The part of a pixel that the hairs of a coarser level's strand cover.
#ifndef HAIRBENCH_MERGED_COVERAGE_GLSL
#define HAIRBENCH_MERGED_COVERAGE_GLSL

#include "strands/coverage.glsl"
#include "strands/merged_fragment.glsl"

// Returns the part of a pixel that the hairs cover, with a filter in metres, and finds the
// representative hair and the position across it. Hairs that are wider than the filter are covered
// one by one. If many hairs fall into a pixel, the pixel sees the strip with their mean coverage,
// and any one of them is shaded.
// offset: of the pixel from the strip's middle; half_width: of the strip without gaps; m.
float coverMerged(uint word, PixelFilter pixel, float offset, float half_width,
                  inout StrandFragment fragment) {
    if (mergedCount(word) == 1.0) {
        fragment.across = pixelAcross(pixel, offset, half_width);
        return pixelCoverage(pixel, offset, half_width);
    }
    float half_strip = max(half_width * mergedSpread(word), 1e-12);
    float cell = 2.0 * half_strip / mergedCount(word);  // m
    float many = smoothstep(0.5, 1.5, pixel.reach / cell);
    float across_strip = pixelAcross(pixel, offset, half_strip);
    float place = mergedPlace(word, many < 0.5 ? clamp(offset / half_strip, -1.0, 1.0)
                                               : across_strip);
    float nearest = floor(place);
    MergedHair hair = mergedHair(word, nearest, fragment.along);
    float from_middle = offset - (hair.middle - 0.5) * cell;
    fragment.across = many < 0.5 ? pixelAcross(pixel, from_middle, hair.half_width * cell)
                                 : 2.0 * (place - nearest) - 1.0;
    tilt(hair, fragment);
    float covered = 0.0;
    if (many < 1.0) {
        for (float k = nearest - 1.0; k <= nearest + 1.0; k += 1.0) {
            MergedHair other = mergedHair(word, k, fragment.along);
            vec2 edges = other.middle - 0.5 + vec2(-1.0, 1.0) * other.half_width;
            edges = clamp(edges * cell, -half_strip, half_strip);
            if (other.there)
                covered += filterBelow(pixel, offset - edges.x) -
                           filterBelow(pixel, offset - edges.y);
        }
    }
    if (many > 0.0) {
        float part = 1.0 / mergedSpread(word);
        covered = mix(covered, part * pixelCoverage(pixel, offset, half_strip), many);
    }
    return covered;
}

#endif
