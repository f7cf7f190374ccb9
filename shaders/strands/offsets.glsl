// Offsets of strands from their smooth shape: curls and disorder, thesis 2.3.8.2 and 2.3.8.3. They
// come from a table (hair/rendering/strand_offsets.h). Their axes are the normal, the binormal and
// the tangent of a frame that follows a guide (strands/frames.comp) without twist about it.
#ifndef HAIRBENCH_STRAND_OFFSETS_GLSL
#define HAIRBENCH_STRAND_OFFSETS_GLSL

#include "common/picture.glsl"
#include "common/random.glsl"
#include "strands/curve.glsl"

layout(buffer_reference, scalar) readonly buffer GuideNormals { vec3 normals[]; };
layout(buffer_reference, scalar) readonly buffer OffsetTable { vec3 offsets[]; };

// An offset and its derivative by the position along the strand, 0 to 1.
struct StrandOffset {
    vec3 value;
    vec3 slope;
};

StrandOffset strandOffset(PictureParameters picture, uint profile, float along) {
    OffsetTable table = OffsetTable(picture.offsets);
    float intervals = float(picture.offset_samples - 1u);
    float place = along * intervals;
    uint interval = min(uint(place), picture.offset_samples - 2u);
    precise float part = place - float(interval);
    vec4 weights = interpolationWeights(part);
    vec4 slopes = interpolationSlopes(part);
    // The sample before an interval's start has the interval's index, because the table begins with
    // one sample outside.
    uint first = profile * (picture.offset_samples + 2u) + interval;
    vec3 a = table.offsets[first];
    vec3 b = table.offsets[first + 1u];
    vec3 c = table.offsets[first + 2u];
    vec3 d = table.offsets[first + 3u];
    return StrandOffset(blend(weights, a, b, c, d), intervals * blend(slopes, a, b, c, d));
}

vec3 guideNormal(PictureParameters picture, uint guide, int index) {
    int inside = clamp(index, 0, int(picture.vertices_per_guide) - 1);
    uint first = guide * picture.vertices_per_guide;
    return GuideNormals(picture.guide_normals).normals[first + uint(inside)];
}

vec3 unitOrZero(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }

// Normal, binormal and unit tangent at t of a segment. The guide's normals are blended like its
// points, so the frame is as smooth as the curve, even at joints.
mat3 strandFrame(PictureParameters picture, uint guide, uint segment, float t, vec3 tangent) {
    int first = int(segment) - 1;
    vec3 blended = blend(splineWeights(t), guideNormal(picture, guide, first),
                         guideNormal(picture, guide, first + 1),
                         guideNormal(picture, guide, first + 2),
                         guideNormal(picture, guide, first + 3));
    vec3 along = unitOrZero(tangent);
    precise vec3 across = blended - dot(blended, along) * along;
    vec3 normal = unitOrZero(across);
    return mat3(normal, cross(along, normal), along);
}

#endif
