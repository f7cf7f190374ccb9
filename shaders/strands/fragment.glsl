// Common code of the strands' fragment shaders: the point of the quad that they shade.
#ifndef HAIRBENCH_STRAND_FRAGMENT_GLSL
#define HAIRBENCH_STRAND_FRAGMENT_GLSL

#include "common/picture.glsl"
#include "shading/strand_shading.glsl"
#include "strands/coverage.glsl"
#include "strands/merged_coverage.glsl"

layout(push_constant, scalar) uniform Push { StrandPush push; };

// The texture on strands, thesis 2.2.
layout(binding = 0) uniform sampler2D strand_texture;

// Factors on colour and opacity. across: -1 to 1; along: 0 at the root, 1 at the tip.
vec4 strandTexel(float across, float along) {
    if (kStrandTexture == 0u) return vec4(1.0);
    return texture(strand_texture, vec2(0.5 + 0.5 * across, along));
}

// With several samples per pixel, a pixel's centre may lie outside the quad that covers some of its
// samples. `across` would be beyond -1 or 1 there, and shading too dark. HAIRBENCH_CENTROID takes a
// place inside the quad. Analytic coverage needs the centre.
#ifdef HAIRBENCH_CENTROID
#define PLACE centroid
#else
#define PLACE
#endif
layout(location = 0) PLACE in vec4 position_and_across;
layout(location = 1) PLACE in vec4 tangent_and_along;
layout(location = 2) PLACE in float half_width;  // m, if quads pass it; for lines, their coverage
layout(location = 3) flat in uint merged_hairs;  // set if kTellsHairs

// 1: strands are lines one pixel wide
layout(constant_id = kLinesConstant) const uint kLines = 0;

// A point of a strand as a pixel sees it.
struct VisibleStrand {
    StrandFragment fragment;
    vec4 factors;  // on colour and opacity
    float coverage;  // part of the pixel that the strand covers; with sampling 1, or 0 in a gap
};

VisibleStrand visibleStrand(PictureParameters picture) {
    VisibleStrand visible;
    visible.fragment.position = position_and_across.xyz;
    // Tangents of a quad's two ends may cancel between them.
    visible.fragment.tangent = unitOr(tangent_and_along.xyz, vec3(0.0, 1.0, 0.0));
    visible.fragment.to_eye = normalize(picture.eye - visible.fragment.position);
    visible.fragment.across = position_and_across.w;
    visible.fragment.along = tangent_and_along.w;
    visible.fragment.width = kNeedsWidth && kLines == 0 ? 2.0 * half_width : picture.root_width;
    visible.fragment.fiber_width = visible.fragment.width;
    if (kMergedHairs != 0) visible.fragment.fiber_width /= mergedCount(merged_hairs);
    visible.coverage = 1.0;
    if (kLines != 0) {
        visible.coverage = half_width;
    } else if (kAnalyticCoverage != 0) {
        float offset = position_and_across.w;
        PixelFilter pixel = pixelFilter(offset);
        if (kMergedHairs != 0) {
            visible.coverage =
                coverMerged(merged_hairs, pixel, offset, half_width, visible.fragment);
        } else {
            visible.coverage = pixelCoverage(pixel, offset, half_width);
            visible.fragment.across = pixelAcross(pixel, offset, half_width);
        }
    } else if (kMergedHairs != 0 && mergedCount(merged_hairs) > 1.0) {
        float half_strip = max(half_width * mergedSpread(merged_hairs), 1e-12);
        visible.fragment.across = clamp(position_and_across.w / half_strip, -1.0, 1.0);
        if (!toMergedHair(merged_hairs, visible.fragment)) visible.coverage = 0.0;
    }
    visible.factors = strandTexel(visible.fragment.across, visible.fragment.along);
    visible.fragment.power =
        ownPower(picture, kTellsHairs ? merged_hairs : 0u, visible.fragment.along);
    return visible;
}

vec3 strandColor(PictureParameters picture, VisibleStrand visible) {
    return shadeStrand(picture, visible.fragment, visible.factors.rgb);
}

// Returns colour and opacity; discards invisible fragments.
vec4 transparentStrand(PictureParameters picture) {
    VisibleStrand visible = visibleStrand(picture);
    float alpha = visible.coverage * picture.opacity * visible.factors.a;
    if (alpha <= 0.0) discard;
    return vec4(strandColor(picture, visible), alpha);
}

#endif
